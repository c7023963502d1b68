//! Which start and which goal a particle stands for, and the box it may fly in.

use super::settings::SETTINGS;
use crate::arm::{Arm, Configuration, JointLimits};
use crate::planning::Endpoints;
use crate::swarm::{Bounds, BoundsError};

/// Pairs of a start and a goal; a particle's last coordinate, in [0, 1], says which.
pub(in crate::planners) struct EndpointChoice {
    pairs: Vec<[Configuration; 2]>,
    ranges: Vec<[f64; 2]>,
}

impl EndpointChoice {
    pub(in crate::planners) fn new(arm: &Arm, ends: &Endpoints) -> Self {
        let goals_of = |start: &Configuration| -> Vec<[Configuration; 2]> {
            ends.goals.iter().map(|goal| [start.clone(), arm.nearest_turn(start, goal)]).collect()
        };
        let pairs: Vec<[Configuration; 2]> = ends.starts.iter().flat_map(goals_of).collect();
        let range = |(j, limits): (usize, JointLimits)| match limits {
            JointLimits::Range { min, max } => [min, max],
            JointLimits::Continuous => {
                let places = || pairs.iter().flatten().map(|q| q[j]);
                [
                    places().fold(f64::INFINITY, f64::min) - SETTINGS.beyond,
                    places().fold(f64::NEG_INFINITY, f64::max) + SETTINGS.beyond,
                ]
            }
        };
        let ranges = arm.joints().iter().map(|joint| joint.limits).enumerate().map(range).collect();
        Self { pairs, ranges }
    }

    /// Where each joint may go (rad).
    pub(in crate::planners) fn ranges(&self) -> &[[f64; 2]] {
        &self.ranges
    }

    /// Start and goal that `coordinate` stands for.
    pub(in crate::planners) fn pair(&self, coordinate: f64) -> &[Configuration; 2] {
        let index = (coordinate * self.pairs.len() as f64) as usize;
        &self.pairs[index.min(self.pairs.len() - 1)]
    }

    /// The coordinate of each pair.
    pub(in crate::planners) fn coordinates(&self) -> impl Iterator<Item = f64> + Clone {
        let count = self.pairs.len();
        (0..count).map(move |i| (i as f64 + 0.5) / count as f64)
    }

    /// The box of `places` configurations, then of `more` ranges, then of the choice.
    pub(in crate::planners) fn bounds(
        &self,
        places: usize,
        more: &[[f64; 2]],
    ) -> Result<Bounds, BoundsError> {
        let joints = (0..places).flat_map(|_| self.ranges.iter().copied());
        Bounds::new(&joints.chain(more.iter().copied()).chain([[0.0, 1.0]]).collect::<Vec<_>>())
    }
}
