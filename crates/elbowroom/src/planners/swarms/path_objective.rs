//! How long a polyline of configurations is, and how far from free.

use super::settings::SETTINGS;
use crate::arm::Configuration;
use crate::path::Penetration;
use crate::planning::{Objective, motion_limits};
use crate::scene::Scene;
use crate::trajectory::SpeedLimits;

/// The measure of candidates. It orders them; what is handed out is certified.
pub(in crate::planners) struct PathObjective<'a> {
    pub(in crate::planners) scene: &'a Scene,
    objective: Objective,
    limits: Vec<SpeedLimits>,
    look_every: f64,
    contacts: Penetration<'a>,
    /// Whether the second of two joints must not change its sign.
    keeps_posture: bool,
}

impl<'a> PathObjective<'a> {
    pub(in crate::planners) fn new(scene: &'a Scene, objective: Objective, keeps_posture: bool) -> Self {
        let (limits, _) = motion_limits(scene.arm());
        let [_, reach] = scene.arm().reach();
        let contacts = Penetration::new(scene, SETTINGS.kept * reach);
        Self { scene, objective, limits, look_every: SETTINGS.look_every * reach, contacts, keeps_posture }
    }

    pub(in crate::planners) fn limits(&self) -> &[SpeedLimits] {
        &self.limits
    }

    /// What straight joint motions from place to place cost.
    pub(in crate::planners) fn cost(&self, places: &[Configuration]) -> f64 {
        let cost = |pair: &[Configuration]| {
            let (from, to) = (&*pair[0], &*pair[1]);
            self.objective.of_move(self.scene.arm(), &self.limits, (from, to), || self.looks(from, to))
        };
        places.windows(2).map(cost).sum()
    }

    /// How deep in contact the arm is along straight joint motions, and how far beyond its limits: summed over the way of its
    /// points (m²); 0 where it keeps some clearance wherever it is examined.
    pub(in crate::planners) fn violation(&self, places: &[Configuration]) -> f64 {
        let mut watch = self.watch(&places[0]);
        places.windows(2).map(|pair| self.turn(&pair[0], &pair[1], &mut watch)).sum()
    }

    /// Looks at configurations on a way from `start`, whose posture is the one to be kept.
    pub(in crate::planners) fn watch<'t>(&'t self, start: &'t [f64]) -> Watch<'t> {
        Watch { path_objective: self, start, gap: 0.0 }
    }

    fn turn(&self, from: &[f64], to: &[f64], watch: &mut Watch<'_>) -> f64 {
        let looks = self.looks(from, to);
        let moved = self.way(from, to) / looks as f64;
        let mut q = from.to_vec();
        let sum: f64 = (1..=looks)
            .map(|i| {
                let share = i as f64 / looks as f64;
                q.iter_mut().zip(from.iter().zip(to)).for_each(|(q, (a, b))| *q = a + (b - a) * share);
                watch.at(&q, moved)
            })
            .sum();
        sum * moved.max(self.look_every * 1e-3)
    }

    fn looks(&self, from: &[f64], to: &[f64]) -> usize {
        ((self.way(from, to) / self.look_every).ceil() as usize).clamp(1, SETTINGS.most_looks)
    }

    /// How far `q` is beyond the limits and, where the posture at `start` is to be kept, beyond the full stretch (m).
    fn beyond(&self, q: &[f64], start: &[f64]) -> f64 {
        let beyond: f64 = self
            .scene
            .arm()
            .joints()
            .iter()
            .zip(q)
            .map(|(joint, &q)| match joint.limits {
                crate::arm::JointLimits::Range { min, max } => (min - q).max(q - max).max(0.0),
                crate::arm::JointLimits::Continuous => 0.0,
            })
            .sum();
        let flipped = match (self.keeps_posture, q, start) {
            (true, [_, bend], [_, before]) if libm::sin(*bend) * libm::sin(*before) < 0.0 => {
                libm::sin(*bend).abs()
            }
            _ => 0.0,
        };
        let [_, reach] = self.scene.arm().reach();
        (beyond + flipped) * reach
    }

    /// How far a point of the arm may move (m) while the joints turn evenly.
    pub(in crate::planners) fn way(&self, from: &[f64], to: &[f64]) -> f64 {
        let mut turn = 0.0;
        let links = self.scene.arm().lengths().iter().zip(from.iter().zip(to));
        links
            .map(|(length, (a, b))| {
                turn += b - a;
                length * f64::abs(turn)
            })
            .sum()
    }
}

/// Looks at one configuration after the other, and not at those that are too near to the last to be in contact.
pub(in crate::planners) struct Watch<'t> {
    path_objective: &'t PathObjective<'t>,
    start: &'t [f64],
    /// How far the arm may still move (m).
    gap: f64,
}

impl Watch<'_> {
    /// How far from free the arm is at `q` (m), where no point of it is farther than `moved` (m) from where it was at the
    /// last look.
    pub(in crate::planners) fn at(&mut self, q: &[f64], moved: f64) -> f64 {
        self.gap -= moved;
        let mut violation = self.path_objective.beyond(q, self.start);
        if self.gap <= 0.0 {
            let look = self.path_objective.contacts.look(q);
            self.gap = look.gap;
            violation += look.violation;
        }
        violation
    }
}
