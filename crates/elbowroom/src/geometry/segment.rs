use robust::{Coord, orient2d};

use super::Point;

/// The straight line between two points, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// One end.
    pub a: Point,
    /// The other end; may equal `a`.
    pub b: Point,
}

impl Segment {
    /// The segment from `a` to `b`.
    pub const fn new(a: Point, b: Point) -> Self {
        Self { a, b }
    }

    /// The point of the segment nearest to `point`.
    pub fn nearest(self, point: Point) -> Point {
        let along = self.b - self.a;
        let length_squared = along.length_squared();
        if length_squared == 0.0 {
            return self.a;
        }
        self.a + along * ((point - self.a).dot(along) / length_squared).clamp(0.0, 1.0)
    }

    /// Distance from the segment to `point` (m).
    pub fn distance_to_point(self, point: Point) -> f64 {
        // No hypot: scenes are far from where squares overflow, and one that underflows is a touch.
        (self.nearest(point) - point).length_squared().sqrt()
    }

    /// Whether the two segments have a point in common; exact for the coordinates given.
    pub fn meets(self, other: Self) -> bool {
        let d1 = side(other, self.a);
        let d2 = side(other, self.b);
        let d3 = side(self, other.a);
        let d4 = side(self, other.b);
        if d1 * d2 < 0.0 && d3 * d4 < 0.0 {
            return true;
        }
        (d1 == 0.0 && other.bounds(self.a))
            || (d2 == 0.0 && other.bounds(self.b))
            || (d3 == 0.0 && self.bounds(other.a))
            || (d4 == 0.0 && self.bounds(other.b))
    }

    /// Distance between the two segments (m); 0 when they meet.
    pub fn distance_to_segment(self, other: Self) -> f64 {
        if self.meets(other) {
            return 0.0;
        }
        self.distance_to_point(other.a)
            .min(self.distance_to_point(other.b))
            .min(other.distance_to_point(self.a))
            .min(other.distance_to_point(self.b))
    }

    /// Whether `point` lies in the segment's bounding box.
    fn bounds(self, point: Point) -> bool {
        let within = |a: f64, b: f64, v: f64| v >= a.min(b) && v <= a.max(b);
        within(self.a.x, self.b.x, point.x) && within(self.a.y, self.b.y, point.y)
    }
}

/// 1 when `point` lies to the left of `line`, -1 to the right, 0 on it; exact.
fn side(line: Segment, point: Point) -> f64 {
    let coord = |p: Point| Coord { x: p.x, y: p.y };
    let determinant = orient2d(coord(line.a), coord(line.b), coord(point));
    if determinant > 0.0 {
        1.0
    } else if determinant < 0.0 {
        -1.0
    } else {
        0.0
    }
}
