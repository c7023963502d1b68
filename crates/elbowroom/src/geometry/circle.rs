use thiserror::Error;

use super::{Point, Segment};

/// Greatest radius and coordinate (m): beyond it the last digits are no longer nanometres.
const GREATEST: f64 = 1e6;

/// Why numbers make no disc.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "center ({x} m, {y} m), radius {radius} m: a circle is finite, within 1e6 m, and its radius is greater than 0"
)]
pub struct CircleError {
    /// Of the centre (m).
    pub x: f64,
    /// Of the centre (m).
    pub y: f64,
    /// As given (m).
    pub radius: f64,
}

/// A disc: the circle and its inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Its middle (m).
    pub center: Point,
    /// Its radius (m), not negative.
    pub radius: f64,
}

impl Circle {
    /// The disc of `radius` (m) around `center`.
    ///
    /// # Errors
    /// [`CircleError`] unless the radius is greater than 0 and everything finite.
    pub fn new(center: Point, radius: f64) -> Result<Self, CircleError> {
        let sound = radius > 0.0 && [radius, center.x.abs(), center.y.abs()].iter().all(|v| *v <= GREATEST);
        if sound {
            Ok(Self { center, radius })
        } else {
            Err(CircleError { x: center.x, y: center.y, radius })
        }
    }

    /// Distance from the disc to `segment` (m): negative by the depth when the segment enters the disc.
    pub fn signed_distance_to_segment(&self, segment: Segment) -> f64 {
        segment.distance_to_point(self.center) - self.radius
    }
}
