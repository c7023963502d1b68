use super::{Point, Segment};

/// A disc: the circle and its inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Its middle (m).
    pub center: Point,
    /// Its radius (m), not negative.
    pub radius: f64,
}

impl Circle {
    /// Distance from the disc to `segment` (m): negative by the depth when the segment enters the disc.
    pub fn signed_distance_to_segment(&self, segment: Segment) -> f64 {
        segment.distance_to_point(self.center) - self.radius
    }
}
