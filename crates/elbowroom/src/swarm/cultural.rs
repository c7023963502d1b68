//! A particle swarm with a culture: what the best have in common leads all.

use rand_chacha::ChaCha8Rng;
use rand_core::Rng;
use thiserror::Error;

use super::particles::{clamped, units};
use super::{Bounds, Swarm, SwarmError, SwarmSettings, Value};
use crate::random::unit;

/// Least of the greatest speeds, as a share of the box's width: a culture that agrees on one place would stop all.
const LEAST_SPEED: f64 = 1e-3;

/// How a cultural swarm moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CulturalSettings {
    /// Of the particles; its neighbourhood plays no part, and its `v_max` until the culture knows better.
    pub swarm: SwarmSettings,
    /// Share of the particles that shape the culture in each iteration, the best.
    pub accepted: f64,
    /// Share of the particles that are led by the culture alone, the worst.
    pub influenced: f64,
    /// Size of the culture's own steps, as a share of the interval it holds good.
    pub step: f64,
    /// Greatest speed as a share of that interval (1/iteration).
    pub speed: f64,
}

impl Default for CulturalSettings {
    fn default() -> Self {
        let swarm = SwarmSettings { particles: 40, ..SwarmSettings::default() };
        Self { swarm, accepted: 0.2, influenced: 0.15, step: 0.9, speed: 0.5 }
    }
}

/// Why there is no cultural swarm of these settings.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CulturalError {
    /// Those of the particles.
    #[error(transparent)]
    Swarm(#[from] SwarmError),
    /// A share is not between 0 and 1, or a size not finite and positive.
    #[error("{name} is {value}, it must be {allowed}")]
    Setting {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
}

/// What is held good of one coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Norm<V> {
    low: f64,
    high: f64,
    at_low: V,
    at_high: V,
}

/// Particles led by situational knowledge, the best place so far, and normative knowledge, an interval held good for
/// each coordinate.
///
/// In each iteration the best of the particles widen the intervals, or move an end to where they do better. A particle
/// moves by eq. (5) with the best place in the neighbours' stead, no faster than a share of the interval; a coordinate
/// that would leave its interval takes a random step back towards it instead, and the worst particles take random
/// steps towards the best place alone. This is our reconstruction of the coupling; the cited planner's own equations are
/// not known.
///
/// # Reference
/// Reynolds, *An introduction to cultural algorithms* (1994), for the belief space; Guo et al., cited by the paper as
/// its sixth reference, for the idea of joining it to a swarm.
#[derive(Debug, Clone)]
pub struct CulturalSwarm<V: Value = f64> {
    swarm: Swarm<V>,
    settings: CulturalSettings,
    norms: Vec<Norm<V>>,
    /// The objective where each particle is.
    here: Vec<V>,
    /// The particles, best first.
    order: Vec<usize>,
}

impl<V: Value> CulturalSwarm<V> {
    /// A swarm whose first particles stand at `positions` and the others anywhere in the box; not yet evaluated.
    ///
    /// # Errors
    /// [`CulturalError`] if a setting makes no sense, or a position has another number of coordinates than the box.
    pub fn starting_at(
        bounds: &Bounds,
        settings: &CulturalSettings,
        positions: &[Vec<f64>],
        seed: u64,
    ) -> Result<Self, CulturalError> {
        settings.check()?;
        let swarm = Swarm::starting_at(bounds, &settings.swarm, positions, seed)?;
        let unknown =
            Norm { low: f64::INFINITY, high: f64::NEG_INFINITY, at_low: V::WORST, at_high: V::WORST };
        let particles = settings.swarm.particles;
        Ok(Self {
            swarm,
            settings: *settings,
            norms: vec![unknown; bounds.dimensions()],
            here: vec![V::WORST; particles],
            order: (0..particles).collect(),
        })
    }

    /// One iteration: every particle moves, but for the first one, and is evaluated; the culture learns from the best.
    pub fn step(&mut self, objective: &mut impl FnMut(&[f64]) -> V) {
        if self.swarm.iteration > 0 {
            self.advance();
        }
        let here = &mut self.here;
        let mut particle = 0;
        self.swarm.evaluate(&mut |position: &[f64]| {
            let value = objective(position);
            here[particle] = value;
            particle += 1;
            value
        });
        self.swarm.swarm_best = super::neighbours::best(&self.swarm.values);
        self.swarm.iteration += 1;
        // Not a total order where values are not numbers: insertion keeps what it finds.
        self.order.sort_by(|&a, &b| rank(self.here[a], self.here[b]).then(a.cmp(&b)));
        let accepted = share_of(self.order.len(), self.settings.accepted).max(1);
        let dimensions = self.norms.len();
        for &particle in &self.order[..accepted] {
            let row = &self.swarm.positions[particle * dimensions..][..dimensions];
            for (norm, &x) in self.norms.iter_mut().zip(row) {
                norm.learn(x, self.here[particle]);
            }
        }
    }

    fn advance(&mut self) {
        let inertia = self.swarm.settings.inertia(self.swarm.iteration);
        let (c_personal, c_best) = (self.settings.swarm.c_personal, self.settings.swarm.c_neighbour);
        let particles = self.order.len();
        let led = share_of(particles, self.settings.influenced);
        let dimensions = self.norms.len();
        let best: Vec<f64> = self.swarm.best().0.to_vec();
        let swarm = &mut self.swarm;
        for (place, &particle) in self.order.iter().enumerate() {
            let is_led = place >= particles - led;
            swarm.rng.fill_bytes(swarm.draws.as_flattened_mut());
            let row = particle * dimensions;
            for (d, norm) in self.norms.iter().enumerate() {
                let (min, max) = (swarm.bounds.min()[d], swarm.bounds.max()[d]);
                let width = (norm.high - norm.low).max(0.0);
                let x = swarm.positions[row + d];
                let v = if is_led {
                    let step = (self.settings.step * width * normal(&mut swarm.rng)).abs();
                    norm.towards(x, best[d]) * step
                } else {
                    let [r1, r2] = units(swarm.draws[d]);
                    let fastest = (self.settings.speed * width).max(LEAST_SPEED * (max - min));
                    let v = inertia * swarm.velocities[row + d]
                        + c_personal * r1 * (swarm.personal_bests[row + d] - x)
                        + c_best * r2 * (best[d] - x);
                    let v = clamped(v, -fastest, fastest);
                    if (norm.low..=norm.high).contains(&(x + v)) {
                        v
                    } else {
                        let step = (self.settings.step * width * normal(&mut swarm.rng)).abs();
                        norm.towards(x + v, best[d]) * step
                    }
                };
                let inside = clamped(x + v, min, max);
                swarm.velocities[row + d] = if inside == x + v { v } else { 0.0 };
                swarm.positions[row + d] = inside;
            }
        }
    }

    /// The best position evaluated so far and the objective there; the worst of values as long as nothing was better.
    #[must_use]
    pub fn best(&self) -> (&[f64], V) {
        self.swarm.best()
    }

    /// How many iterations were done.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.swarm.iterations()
    }

    /// How often the objective was asked.
    #[must_use]
    pub fn evaluations(&self) -> usize {
        self.swarm.evaluations()
    }

    /// The interval held good for each coordinate, lower end first; from above to below as long as nothing is known.
    pub fn norms(&self) -> impl ExactSizeIterator<Item = [f64; 2]> {
        self.norms.iter().map(|norm| [norm.low, norm.high])
    }

    /// Where the particles are.
    pub fn positions(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.swarm.positions()
    }
}

impl<V: Value> Norm<V> {
    /// A good particle at `x`: an end of the interval moves there if it is beyond, or does better.
    fn learn(&mut self, x: f64, value: V) {
        if x < self.low || value.is_better(self.at_low) {
            (self.low, self.at_low) = (x, value);
        }
        if x > self.high || value.is_better(self.at_high) {
            (self.high, self.at_high) = (x, value);
        }
    }

    /// The sign of a step from `x` towards the interval or, within it, towards `best`.
    fn towards(&self, x: f64, best: f64) -> f64 {
        if x < self.low || (x <= self.high && x < best) { 1.0 } else { -1.0 }
    }
}

impl CulturalSettings {
    /// Nothing when every setting makes sense.
    ///
    /// # Errors
    /// [`CulturalError`] names the first that does not.
    pub fn check(&self) -> Result<(), CulturalError> {
        self.swarm.check()?;
        for (name, value) in [("accepted", self.accepted), ("influenced", self.influenced)] {
            if !(0.0..=1.0).contains(&value) {
                return Err(CulturalError::Setting { name, value, allowed: "between 0 and 1" });
            }
        }
        for (name, value) in [("step", self.step), ("speed", self.speed)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(CulturalError::Setting { name, value, allowed: "finite and greater than 0" });
            }
        }
        Ok(())
    }
}

fn rank<V: Value>(a: V, b: V) -> std::cmp::Ordering {
    b.is_better(a).cmp(&a.is_better(b))
}

fn share_of(count: usize, share: f64) -> usize {
    ((count as f64 * share).round() as usize).min(count)
}

/// A number of the standard normal distribution, by Box and Muller.
fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let (radius, turn) = (1.0 - unit(rng), unit(rng));
    (-2.0 * libm::log(radius)).sqrt() * libm::cos(std::f64::consts::TAU * turn)
}
