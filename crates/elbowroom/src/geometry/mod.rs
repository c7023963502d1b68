//! Points, segments, circles, polygons and angles of the plane.

mod angle;
mod circle;
mod point;
mod polygon;
mod segment;

pub use angle::{angle_difference, wrap_angle};
pub use circle::{Circle, CircleError};
pub use point::{Point, Vector};
pub use polygon::{MAX_VERTICES, Polygon, PolygonError};
pub use segment::Segment;
