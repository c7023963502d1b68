/// One position per joint (rad), base first; each joint is measured from the link before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Configuration<const DOF: usize>(pub [f64; DOF]);

impl<const DOF: usize> Configuration<DOF> {
    /// Euclidean distance in configuration space (rad), with no turn taken off.
    pub fn distance(&self, other: &Self) -> f64 {
        joint_distance(&self.0, &other.0)
    }

    /// The configuration at `fraction` of the straight way to `other`.
    pub fn lerp(&self, other: &Self, fraction: f64) -> Self {
        Self(std::array::from_fn(|j| self.0[j] + (other.0[j] - self.0[j]) * fraction))
    }
}

impl<const DOF: usize> AsRef<[f64]> for Configuration<DOF> {
    fn as_ref(&self) -> &[f64] {
        &self.0
    }
}

/// Euclidean distance between two configurations, a position per joint each (rad), with no turn taken off.
pub fn joint_distance(a: &[f64], b: &[f64]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum();
    squares.sqrt()
}
