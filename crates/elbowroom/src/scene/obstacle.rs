use crate::geometry::{Circle, Polygon, Segment};

/// The shape of an obstacle.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A disc.
    Circle(Circle),
    /// A simple polygon with its inside.
    Polygon(Polygon),
}

/// Something that the arm must not touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// What people call it, if they do.
    pub name: Option<String>,
    /// Where it is.
    pub shape: Shape,
}

impl Obstacle {
    /// Distance from the obstacle to `segment` (m): 0 or less when they touch. For circles the negative
    /// value is the depth.
    pub fn distance_to_segment(&self, segment: Segment) -> f64 {
        match &self.shape {
            Shape::Circle(circle) => circle.signed_distance_to_segment(segment),
            Shape::Polygon(polygon) => polygon.distance_to_segment(segment),
        }
    }
}
