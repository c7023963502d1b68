use crate::geometry::Point;

/// The places the tip is led through, start and goal included (m).
#[derive(Debug, Clone, PartialEq)]
pub struct TipPath(pub Vec<Point>);

impl TipPath {
    /// Sum of the distances between consecutive places (m): eq. (10) of the paper.
    pub fn length(&self) -> f64 {
        self.0.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }
}
