//! The paper's modified lbest swarm: it draws paths over a cost-to-go, one neighbour at a time.

use std::collections::HashSet;

use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;
use thiserror::Error;

use super::views::{Successor, Terrain, Views};
use crate::random::unit;
use crate::search::Graph;

/// Costs that differ by less than this share are the same: sums of the same steps in another order.
const EQUAL_COST: f64 = 1e-9;

/// The most candidate paths one plan may draw.
pub const MAX_CANDIDATES: usize = 1_000_000;

/// How the swarm draws its paths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuidedSwarmSettings {
    /// How many candidate paths are drawn; the paper's 300 iterations.
    pub candidates: usize,
    /// Inertia of the first candidate; it falls linearly, eq. (7).
    pub first_inertia: f64,
    /// Inertia that the last candidate comes near.
    pub last_inertia: f64,
    /// Pull towards the neighbour of least cost-to-go.
    ///
    /// The paper's text gives this role to `c1 = 3`, its eq. (5) to the other term; the text is followed.
    pub c_dstar: f64,
    /// Pull towards the straight distance to the goal.
    pub c_euclid: f64,
    /// Greatest speed (m), or none.
    pub v_max: Option<f64>,
    /// Paths that cost more than the best by no more than this share of it are kept too.
    pub keep_within: f64,
}

impl Default for GuidedSwarmSettings {
    fn default() -> Self {
        Self {
            candidates: 300,
            first_inertia: 0.9,
            last_inertia: 0.4,
            c_dstar: 3.0,
            c_euclid: 1.0,
            v_max: None,
            keep_within: 0.0,
        }
    }
}

/// A setting of the swarm that makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum GuidedSwarmError {
    /// No path would be drawn, or more than [`MAX_CANDIDATES`].
    #[error("{found} candidate paths, 1 to {MAX_CANDIDATES} are allowed")]
    Candidates {
        /// What was asked.
        found: usize,
    },
    /// A coefficient is negative, infinite or not a number.
    #[error("{name} is {value}, it must be finite and not negative")]
    Coefficient {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
    },
}

impl GuidedSwarmSettings {
    /// Nothing when every setting makes sense.
    ///
    /// # Errors
    /// [`GuidedSwarmError`] names the first that does not.
    pub fn check(&self) -> Result<(), GuidedSwarmError> {
        if self.candidates == 0 || self.candidates > MAX_CANDIDATES {
            return Err(GuidedSwarmError::Candidates { found: self.candidates });
        }
        let named = [
            ("first_inertia", self.first_inertia),
            ("last_inertia", self.last_inertia),
            ("c_dstar", self.c_dstar),
            ("c_euclid", self.c_euclid),
            ("v_max", self.v_max.unwrap_or(0.0)),
            ("keep_within", self.keep_within),
        ];
        match named.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0)) {
            Some((name, value)) => Err(GuidedSwarmError::Coefficient { name, value }),
            None => Ok(()),
        }
    }

    /// Inertia of candidate `index`: eq. (7).
    fn inertia(&self, index: usize) -> f64 {
        self.first_inertia
            - (self.first_inertia - self.last_inertia) * (index as f64 / self.candidates as f64)
    }
}

/// The candidate paths of least cost, and those that cost hardly more.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPaths {
    /// The least cost (m): eq. (10).
    pub cost: f64,
    /// All different paths that are kept, as nodes, in the order they were drawn.
    pub paths: Vec<Vec<usize>>,
    /// What each of them costs (m).
    pub costs: Vec<f64>,
    /// How many candidates were drawn.
    pub candidates: usize,
    /// How often a dead point made a candidate step back.
    pub dead_points: usize,
}

/// Draws candidate paths from `start` and keeps the best; `None` when `keep_going`, asked before each, says
/// no, or when `start` has no way to the goal.
///
/// A candidate goes from node to node; eq. (5) gives each free neighbour a velocity, with its cost-to-go as
/// position, and the one with the least position minus velocity is next. Where none is left it steps back.
/// Each candidate has a random stream of its own, so the result depends on the seed alone.
pub fn draw_paths<G: Graph>(
    terrain: &Terrain<'_, G>,
    start: usize,
    settings: &GuidedSwarmSettings,
    seed: u64,
    keep_going: &dyn Fn() -> bool,
) -> Option<DrawnPaths> {
    let mut drawn = DrawnPaths {
        cost: f64::INFINITY,
        paths: Vec::new(),
        costs: Vec::new(),
        candidates: 0,
        dead_points: 0,
    };
    let mut known = HashSet::new();
    let mut views = Views::new(terrain);
    let within = |cost: f64, best: f64| cost <= best * (1.0 + settings.keep_within.max(EQUAL_COST));
    for index in 0..settings.candidates {
        if !keep_going() {
            return None;
        }
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(index as u64);
        let walk = Walk { settings, inertia: settings.inertia(index) };
        let candidate = walk.candidate(start, &mut views, &mut rng)?;
        drawn.candidates += 1;
        drawn.dead_points += candidate.dead_points;
        drawn.cost = drawn.cost.min(candidate.cost);
        if within(candidate.cost, drawn.cost) && known.insert(candidate.nodes.clone()) {
            drawn.costs.push(candidate.cost);
            drawn.paths.push(candidate.nodes);
        }
    }
    let best = drawn.cost;
    // What was kept beside an early best may be too long beside the last.
    (drawn.costs, drawn.paths) =
        drawn.costs.into_iter().zip(drawn.paths).filter(|&(cost, _)| within(cost, best)).unzip();
    Some(drawn)
}

/// One candidate in the making.
struct Walk<'a> {
    settings: &'a GuidedSwarmSettings,
    inertia: f64,
}

struct DrawnPath {
    nodes: Vec<usize>,
    cost: f64,
    dead_points: usize,
}

/// A place of the walk, the velocity it was chosen with, and the cost so far.
#[derive(Clone, Copy)]
struct Footprint {
    spot: usize,
    velocity: f64,
    cost: f64,
}

impl Walk<'_> {
    /// Walks to the goal, stepping back from dead points; `None` if every way is used up.
    fn candidate<G: Graph>(
        &self,
        start: usize,
        views: &mut Views<'_, '_, G>,
        rng: &mut ChaCha8Rng,
    ) -> Option<DrawnPath> {
        let mut trail = vec![Footprint { spot: views.begin(start), velocity: 0.0, cost: 0.0 }];
        let mut dead_points = 0;
        while let Some(&here) = trail.last() {
            if views.is_goal(here.spot) {
                let nodes = trail.iter().map(|footprint| views.node(footprint.spot)).collect();
                return Some(DrawnPath { nodes, cost: here.cost, dead_points });
            }
            match self.step(&here, views.unvisited(here.spot), rng) {
                Some(next) => {
                    views.visit(next.spot);
                    trail.push(next);
                }
                None => {
                    dead_points += 1;
                    trail.pop();
                }
            }
        }
        None
    }

    /// The neighbour that the velocities choose: eq. (5) for each, then the least `position - velocity`.
    fn step(&self, here: &Footprint, open: &[Successor], rng: &mut ChaCha8Rng) -> Option<Footprint> {
        let least = open.iter().map(|successor| successor.position).fold(f64::INFINITY, f64::min);
        let v_max = self.settings.v_max.unwrap_or(f64::INFINITY);
        let carried = self.inertia * here.velocity;
        let mut chosen: Option<(f64, f64, &Successor)> = None;
        for successor in open {
            let &Successor { position, distance, .. } = successor;
            let (r1, r2) = (unit(rng), unit(rng));
            let pull = self.settings.c_dstar * r1 * (least - position)
                + self.settings.c_euclid * r2 * (distance - position);
            let velocity = (carried + pull).clamp(-v_max, v_max);
            let rank = position - velocity;
            if chosen.is_none_or(|(best, ..)| rank < best) {
                chosen = Some((rank, velocity, successor));
            }
        }
        let (_, velocity, next) = chosen?;
        Some(Footprint { spot: next.spot, velocity, cost: here.cost + next.cost })
    }
}
