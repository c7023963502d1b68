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

    /// Where `arm` has its tip at each configuration.
    pub fn tips(&self, arm: &TwoLinkArm) -> TipPath {
        TipPath(self.0.iter().map(|q| arm.tip(q)).collect())
    }
}
