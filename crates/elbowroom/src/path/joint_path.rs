use super::TipPath;
use crate::arm::{Arm, Configuration, joint_distance};

/// The configurations the arm is led through, start and goal included; between two of them every joint
/// turns by their plain difference, so a continuous joint counts its turns.
#[derive(Debug, Clone, PartialEq)]
pub struct JointPath(pub Vec<Configuration>);

impl JointPath {
    /// Euclidean length in configuration space (rad).
    pub fn length(&self) -> f64 {
        self.0.windows(2).map(|pair| joint_distance(&pair[0], &pair[1])).sum()
    }

    /// Length of the tip's way with `arm` while the joints turn straight from place to place (m).
    pub fn tip_travel(&self, arm: &Arm) -> f64 {
        // Short enough turns that an arc and its chord differ by a millionth.
        const MOST_TURN: f64 = 0.005;
        let mut travel = 0.0;
        for pair in self.0.windows(2) {
            let (from, to) = (&pair[0], &pair[1]);
            let count = (joint_distance(from, to) / MOST_TURN).ceil().max(1.0) as usize;
            let mut here = arm.tip(from);
            let steps = (1..=count).map(|i| {
                let next = arm.tip(&from.lerp(to, i as f64 / count as f64));
                std::mem::replace(&mut here, next).distance(next)
            });
            travel += steps.sum::<f64>();
        }
        travel
    }

    /// Where `arm` has its tip at each configuration.
    pub fn tips(&self, arm: &Arm) -> TipPath {
        TipPath(self.0.iter().map(|q| arm.tip(q)).collect())
    }
}
