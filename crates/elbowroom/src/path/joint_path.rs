use crate::arm::{Arm, Configuration, joint_distance};
use crate::path::TipPath;

/// The configurations the arm is led through, start and goal included; between two of them every joint
/// turns by their plain difference, so a continuous joint counts its turns.
#[derive(Debug, Clone, PartialEq)]
pub struct JointPath<Q = Configuration<2>>(pub Vec<Q>);

impl<Q: AsRef<[f64]>> JointPath<Q> {
    /// Euclidean length in configuration space (rad).
    pub fn length(&self) -> f64 {
        self.0.windows(2).map(|pair| joint_distance(pair[0].as_ref(), pair[1].as_ref())).sum()
    }

    /// Length of the tip's way with `arm` while the joints turn straight from place to place (m).
    pub fn tip_travel(&self, arm: &impl Arm) -> f64 {
        // Short enough turns that an arc and its chord differ by a millionth.
        const MOST_TURN: f64 = 0.005;
        let mut q = Vec::new();
        let mut tip_between = |from: &[f64], to: &[f64], fraction: f64| {
            q.clear();
            q.extend(from.iter().zip(to).map(|(a, b)| a + (b - a) * fraction));
            arm.tip_at(&q)
        };
        let mut travel = 0.0;
        for pair in self.0.windows(2) {
            let (from, to) = (pair[0].as_ref(), pair[1].as_ref());
            let count = (joint_distance(from, to) / MOST_TURN).ceil().max(1.0) as usize;
            let mut tip = |i: usize| tip_between(from, to, i as f64 / count as f64);
            travel += (0..count).map(|i| tip(i).distance(tip(i + 1))).sum::<f64>();
        }
        travel
    }

    /// Where `arm` has its tip at each configuration.
    pub fn tips(&self, arm: &impl Arm) -> TipPath {
        TipPath(self.0.iter().map(|q| arm.tip_at(q.as_ref())).collect())
    }

    /// The same path with as many joints as there are.
    pub fn any(&self) -> JointPath<Vec<f64>> {
        JointPath(self.0.iter().map(|q| q.as_ref().to_vec()).collect())
    }
}
