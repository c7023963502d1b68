use crate::arm::{Configuration, TwoLinkArm};
use crate::path::TipPath;

/// The configurations the arm is led through, start and goal included; between two of them every joint
/// turns by their plain difference, so a continuous joint counts its turns.
#[derive(Debug, Clone, PartialEq)]
pub struct JointPath(pub Vec<Configuration<2>>);

impl JointPath {
    /// Euclidean length in configuration space (rad).
    pub fn length(&self) -> f64 {
        self.0.windows(2).map(|pair| pair[0].distance(&pair[1])).sum()
    }

    /// Length of the tip's way with `arm` while the joints turn straight from place to place (m).
    pub fn tip_travel(&self, arm: &TwoLinkArm) -> f64 {
        // Short enough turns that an arc and its chord differ by a millionth.
        const MOST_TURN: f64 = 0.005;
        let turns =
            |pair: &[Configuration<2>]| (pair[0].distance(&pair[1]) / MOST_TURN).ceil().max(1.0) as usize;
        self.0
            .windows(2)
            .map(|pair| {
                let count = turns(pair);
                let tip = |i: usize| arm.tip(&pair[0].lerp(&pair[1], i as f64 / count as f64));
                (0..count).map(|i| tip(i).distance(tip(i + 1))).sum::<f64>()
            })
            .sum()
    }

    /// Where `arm` has its tip at each configuration.
    pub fn tips(&self, arm: &TwoLinkArm) -> TipPath {
        TipPath(self.0.iter().map(|q| arm.tip(q)).collect())
    }
}
