use super::ObstacleMotion;
use crate::geometry::{Segment, Shape};

/// Something that the arm must not touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// What people call it, if they do.
    pub name: Option<String>,
    /// Where it is; where it moves, from where its motion counts.
    pub shape: Shape,
    /// How it moves, if it does.
    pub motion: Option<ObstacleMotion>,
}

impl Obstacle {
    /// One without a name that is static.
    pub fn still(shape: Shape) -> Self {
        Self { name: None, shape, motion: None }
    }

    /// Distance from the obstacle to `segment` (m): 0 or less when they touch.
    pub fn distance_to_segment(&self, segment: Segment) -> f64 {
        self.shape.distance_to_segment(segment)
    }

    /// Distance from the obstacle to `segment` (m), negative by the depth: see [`Shape::signed_distance_to_segment`].
    pub fn signed_distance_to_segment(&self, segment: Segment) -> f64 {
        self.shape.signed_distance_to_segment(segment)
    }
}

/// What texts call the obstacle at this place among the scene's, from 0: its number, from 1 as links and joints have it, and
/// its name if it has one.
pub fn obstacle_in_words(obstacle: usize, name: Option<&str>) -> String {
    let number = obstacle + 1;
    name.map_or_else(
        || format!("obstacle {number}"),
        |name| format!("obstacle {number} ({})", name.escape_debug()),
    )
}
