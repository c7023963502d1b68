//! Leads the arm from a configuration to where its tip shall be next: inverse kinematics, then a certified turn.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::inverse_swarm::{InverseSwarmSettings, Previous, inverse_by_swarm};
use super::settings::SETTINGS;
use crate::arm::{Configuration, Posture, joint_distance};
use crate::geometry::Point;
use crate::path::{Penetration, straight_move_is_free};
use crate::planning::{Budget, Exhausted};
use crate::random::{below, unit};
use crate::scene::Scene;

/// Leads an arm, and keeps account.
pub(in crate::planners) struct LocalPlanner<'a> {
    pub(in crate::planners) scene: &'a Scene,
    pub(in crate::planners) budget: Budget<'a>,
    contacts: Penetration<'a>,
    rng: ChaCha8Rng,
    /// The posture of an arm of two links that must not change.
    pub(in crate::planners) kept: Option<Posture>,
}

impl<'a> LocalPlanner<'a> {
    pub(in crate::planners) fn new(scene: &'a Scene, budget: Budget<'a>, seed: u64) -> Self {
        let [_, reach] = scene.arm().reach();
        let contacts = Penetration::new(scene, SETTINGS.margin * reach);
        Self { scene, budget, contacts, rng: ChaCha8Rng::seed_from_u64(seed), kept: None }
    }

    /// Where the tip is at `q`.
    pub(in crate::planners) fn tip(&self, q: &[f64]) -> Point {
        self.scene.arm().tip(q)
    }

    /// Whether the straight joint motion is certified, within the limits, and keeps the posture that has to be kept.
    pub(in crate::planners) fn connects(&mut self, from: &[f64], to: &[f64]) -> Result<bool, Exhausted> {
        self.budget.spend(1)?;
        let keeps = self.kept.is_none_or(|kept| Posture::at(to).is_none_or(|posture| posture == kept))
            && (self.kept.is_none() || (to[1] - from[1]).abs() < std::f64::consts::PI);
        Ok(keeps && self.scene.arm().within_limits(to) && straight_move_is_free(self.scene, from, to))
    }

    /// The nearest configuration with its tip at `tip` that damped least squares reach from `near`, if the turn from
    /// `from` is certified.
    pub(in crate::planners) fn by_least_squares(
        &mut self,
        from: &[f64],
        near: &[f64],
        tip: Point,
    ) -> Result<Option<Configuration>, Exhausted> {
        self.budget.spend(1)?;
        match self.scene.arm().inverse_near(tip, near) {
            Some(q) if self.connects(from, &q)? => Ok(Some(q)),
            _ => Ok(None),
        }
    }

    /// The configuration that a swarm around `around` finds for `tip`, if the turn from `from` is certified.
    pub(in crate::planners) fn by_swarm(
        &mut self,
        from: &[f64],
        around: &[f64],
        tip: Point,
        radius: f64,
        [particles, iterations]: [usize; 2],
    ) -> Result<Option<Configuration>, Exhausted> {
        let [_, reach] = self.scene.arm().reach();
        let most = particles * iterations;
        self.budget.spend(most)?;
        let settings =
            InverseSwarmSettings { particles, iterations, tolerance: SETTINGS.near_enough * reach };
        let previous = Previous { q: around, radius, weight: SETTINGS.nearness * reach * reach };
        let seed = self.rng.next_u64();
        let contacts = &self.contacts;
        let mut in_contact = |q: &[f64]| contacts.violation(q);
        let found = inverse_by_swarm(self.scene.arm(), tip, Some(previous), &settings, seed, &mut in_contact);
        let Ok(found) = found else {
            self.budget.give_back(most);
            return Ok(None);
        };
        self.budget.give_back(most - found.evaluations);
        self.by_least_squares(from, &found.q, tip)
    }

    /// `q` with every joint moved by up to `most` (rad), evenly drawn, and put within its limits.
    pub(in crate::planners) fn perturbed(&mut self, q: &[f64], most: f64) -> Configuration {
        let moved = q.iter().map(|angle| angle + most * (2.0 * unit(&mut self.rng) - 1.0)).collect();
        self.scene.arm().clamped(moved)
    }

    /// A number in [0, 1).
    pub(in crate::planners) fn unit(&mut self) -> f64 {
        unit(&mut self.rng)
    }

    /// A whole number below `count`, which is not 0.
    pub(in crate::planners) fn below(&mut self, count: usize) -> usize {
        below(&mut self.rng, count)
    }

    /// Certified turns from `from`, left out, to `to`: straight, or else with the tip on its straight way between both.
    pub(in crate::planners) fn connect_by_steps(
        &mut self,
        from: &[f64],
        to: &[f64],
    ) -> Result<Option<Vec<Configuration>>, Exhausted> {
        if self.connects(from, to)? {
            return Ok(Some(vec![to.into()]));
        }
        let (start, end) = (self.tip(from), self.tip(to));
        let mut places: Vec<Configuration> = Vec::new();
        let mut at = Configuration::from(from);
        for _ in 0..SETTINGS.self_steps {
            let widest = at.iter().zip(to).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
            if widest <= SETTINGS.self_step {
                if self.connects(&at, to)? {
                    places.push(to.into());
                    return Ok(Some(places));
                }
                return Ok(None);
            }
            let share = SETTINGS.self_step / widest;
            let near = at.lerp(to, share);
            let tip = self.tip(&at).lerp(end, share);
            // Back onto the straight way, should the tip be off it.
            let tip = if start == end { end } else { tip };
            let Some(next) = self.by_least_squares(&at, &near, tip)? else { return Ok(None) };
            if joint_distance(&next, to) >= joint_distance(&at, to) {
                return Ok(None);
            }
            places.push(next.clone());
            at = next;
        }
        Ok(None)
    }
}
