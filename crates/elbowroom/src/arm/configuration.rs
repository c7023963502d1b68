/// One position per joint (rad), base first; each joint is measured from the link before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Configuration<const DOF: usize>(pub [f64; DOF]);

impl<const DOF: usize> Configuration<DOF> {
    /// Euclidean distance in configuration space (rad), with no turn taken off.
    pub fn distance(&self, other: &Self) -> f64 {
        let squares: f64 = self.0.iter().zip(other.0).map(|(a, b)| (b - a) * (b - a)).sum();
        squares.sqrt()
    }

    /// The configuration at `fraction` of the straight way to `other`.
    pub fn lerp(&self, other: &Self, fraction: f64) -> Self {
        Self(std::array::from_fn(|j| self.0[j] + (other.0[j] - self.0[j]) * fraction))
    }
}
