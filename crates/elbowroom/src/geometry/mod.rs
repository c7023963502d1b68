//! Points, segments, shapes and angles of the plane.

mod angle;
mod point;
mod polygon;
mod segment;
mod shape;

pub use angle::{angle_difference, wrap_angle};
pub use point::{Point, Vector};
pub use segment::Segment;
pub use shape::{MAX_VERTICES, Shape, ShapeError};
