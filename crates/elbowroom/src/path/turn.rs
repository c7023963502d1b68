//! Whether an arm of any number of links may turn straight from one configuration to another: certified, not sampled.

use super::CERTIFIED_CLEARANCE;
use crate::arm::{Arm, joint_distance};
use crate::geometry::Segment;
use crate::scene::Scene;

/// Configurations looked at before a turn is given up as not free.
const MOST_LOOKS: u32 = 1 << 15;

/// Clearance of each link at `q` (rad) from the nearest obstacle (m), base first; 0 or less in contact, infinite
/// without obstacles.
pub fn clearances<A: Arm>(scene: &Scene<A>, q: &[f64]) -> Vec<f64> {
    scene.arm.link_segments(q).map(|link| from_obstacles(scene, link)).collect()
}

/// Least clearance at `q` (rad) between links that have to keep clear of each other (m); 0 or less in contact, infinite
/// where there are none.
pub fn self_clearance<A: Arm>(scene: &Scene<A>, q: &[f64]) -> f64 {
    let links: Vec<Segment> = scene.arm.link_segments(q).collect();
    let pairs = self_pairs(&scene.arm).map(|(a, b)| between_links(scene, links[a], links[b]));
    pairs.fold(f64::INFINITY, f64::min)
}

/// Whether all links stay clear of all that they must not touch while each joint turns evenly from `from` to `to` (rad),
/// stops left out of account: between two configurations within them there is no other.
///
/// By bisection with a bound on the motion: over a stretch whose points move by no more than `b`, links that are clear
/// by `c0` at one end and `c1` at the other are clear all the way if `c0 + c1 > b`. `false` also when a clearance comes
/// down to [`CERTIFIED_CLEARANCE`], or cannot be told from it in bounded work.
///
/// # Reference
/// Schwarzer, Saha and Latombe, *Adaptive dynamic collision checking*, IEEE T-RO 21(3), 2005.
pub fn turn_is_free<A: Arm>(scene: &Scene<A>, from: &[f64], to: &[f64]) -> bool {
    let links = scene.arm.lengths().len();
    let watched: Vec<Watched> = (0..links)
        .map(Watched::Link)
        .chain(self_pairs(&scene.arm).map(|(a, b)| Watched::Pair(a, b)))
        .collect();
    let ways = watched.iter().map(|watched| watched.way(scene.arm.lengths(), from, to)).collect();
    let open: Vec<usize> = (0..watched.len()).collect();
    let mut turn = Turn { scene, watched, ways, looks_left: MOST_LOOKS };
    let ends = [turn.look(from, &open), turn.look(to, &open)];
    let [Some(at_from), Some(at_to)] = ends else { return false };
    joint_distance(from, to) == 0.0 || turn.between_is_free((from, &at_from), (to, &at_to), &open, 1.0)
}

/// Links that are no neighbours, each pair once, where they have to keep clear.
fn self_pairs(arm: &impl Arm) -> impl Iterator<Item = (usize, usize)> {
    let links = if arm.self_collision() { arm.lengths().len() } else { 0 };
    (0..links).flat_map(move |a| (a + 2..links).map(move |b| (a, b)))
}

fn from_obstacles<A: Arm>(scene: &Scene<A>, link: Segment) -> f64 {
    let distances = scene.obstacles.iter().map(|obstacle| obstacle.distance_to_segment(link));
    distances.fold(f64::INFINITY, f64::min) - scene.arm.half_width()
}

fn between_links<A: Arm>(scene: &Scene<A>, a: Segment, b: Segment) -> f64 {
    a.distance_to_segment(b) - 2.0 * scene.arm.half_width()
}

/// What has to stay clear.
#[derive(Clone, Copy)]
enum Watched {
    /// A link, of the obstacles.
    Link(usize),
    /// Two links, of each other.
    Pair(usize, usize),
}

impl Watched {
    /// How far a point of the link can move (m) on the whole turn; of a pair, as seen from the first.
    fn way(self, lengths: &[f64], from: &[f64], to: &[f64]) -> f64 {
        let (first, last) = match self {
            Self::Link(link) => (0, link),
            Self::Pair(a, b) => (a + 1, b),
        };
        let mut turn = 0.0;
        (first..=last)
            .map(|j| {
                turn += to[j] - from[j];
                lengths[j] * f64::abs(turn)
            })
            .sum()
    }
}

/// A straight turn that is looked at.
struct Turn<'a, A> {
    scene: &'a Scene<A>,
    watched: Vec<Watched>,
    /// For each, how far it can move on the whole turn (m).
    ways: Vec<f64>,
    looks_left: u32,
}

impl<A: Arm> Turn<'_, A> {
    /// Clearance beyond what is to be kept (m) of those watched that are `open`; `None` when one has none left.
    fn look(&self, q: &[f64], open: &[usize]) -> Option<Vec<f64>> {
        let links: Vec<Segment> = self.scene.arm.link_segments(q).collect();
        let clear = |&i: &usize| {
            let clearance = match self.watched[i] {
                Watched::Link(link) => from_obstacles(self.scene, links[link]),
                Watched::Pair(a, b) => between_links(self.scene, links[a], links[b]),
            };
            Some(clearance - CERTIFIED_CLEARANCE).filter(|left| *left > 0.0)
        };
        open.iter().map(clear).collect()
    }

    /// `share` is how much of the whole turn lies between the two; their clearances are those of `open`.
    fn between_is_free(
        &mut self,
        from: (&[f64], &[f64]),
        to: (&[f64], &[f64]),
        open: &[usize],
        share: f64,
    ) -> bool {
        let undecided = |k: usize| from.1[k] + to.1[k] <= self.ways[open[k]] * share;
        let kept: Vec<usize> = (0..open.len()).filter(|&k| undecided(k)).collect();
        if kept.is_empty() {
            return true;
        }
        if self.looks_left == 0 {
            return false;
        }
        self.looks_left -= 1;
        let of = |clearances: &[f64]| -> Vec<f64> { kept.iter().map(|&k| clearances[k]).collect() };
        let (at_from, at_to) = (of(from.1), of(to.1));
        let open: Vec<usize> = kept.iter().map(|&k| open[k]).collect();
        let middle: Vec<f64> = from.0.iter().zip(to.0).map(|(a, b)| a + (b - a) * 0.5).collect();
        let Some(at_middle) = self.look(&middle, &open) else { return false };
        self.between_is_free((from.0, &at_from), (&middle, &at_middle), &open, share / 2.0)
            && self.between_is_free((&middle, &at_middle), (to.0, &at_to), &open, share / 2.0)
    }
}
