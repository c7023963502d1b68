use smallvec::SmallVec;
use thiserror::Error;

use super::{Point, Segment, Vector, polygon};
use crate::units::{Told, Units};

/// The most vertices one polygon may have: its check for crossings takes quadratic time.
pub const MAX_VERTICES: usize = 10_000;

/// Greatest radius and coordinate (m) of what is round: beyond it the last digits are no longer nanometres.
const GREATEST: f64 = 1e6;

/// Why numbers make no shape.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// No disc.
    #[error("{}", self.told(Units::SI))]
    Circle {
        /// Of the centre (m).
        x: f64,
        /// Of the centre (m).
        y: f64,
        /// As given (m).
        radius: f64,
    },
    /// No segment.
    #[error("{}", self.told(Units::SI))]
    Segment {
        /// Of the end that is none, else of the first (m).
        x: f64,
        /// Of the same (m).
        y: f64,
        /// As given (m).
        radius: f64,
    },
    /// A segment whose ends are one.
    #[error("{}", self.told(Units::SI))]
    SegmentEnds {
        /// Where both are (m).
        x: f64,
        /// Where both are (m).
        y: f64,
    },
    /// Fewer than three points, or more than [`MAX_VERTICES`].
    #[error("{found} corners, 3 to {MAX_VERTICES} are allowed")]
    VertexCount {
        /// How many were given.
        found: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("corner {} is not finite", vertex + 1)]
    NotFinite {
        /// Its place in the list, from 0.
        vertex: usize,
    },
    /// Two edges have more in common than a shared end.
    #[error("the edge from corner {} crosses or touches the edge from corner {}", first + 1, second + 1)]
    EdgesMeet {
        /// The first edge, named by the vertex where it begins, from 0.
        first: usize,
        /// The second edge.
        second: usize,
    },
    /// No radius for the corners of a polygon, or corners too far out for one.
    #[error("{}", self.told(Units::SI))]
    Rounding {
        /// As given (m).
        radius: f64,
    },
}

impl Told for ShapeError {
    fn told(&self, units: Units) -> String {
        let length = |metres| units.stated_length(metres);
        let most = length(GREATEST);
        match *self {
            Self::Circle { x, y, radius } => format!(
                "center {}, radius {}: a circle is finite, within {most}, and its radius is greater than 0",
                units.place(x, y),
                length(radius)
            ),
            Self::Segment { x, y, radius } => format!(
                "end {}, radius {}: a segment is finite, within {most}, and its radius is 0 or greater",
                units.place(x, y),
                length(radius)
            ),
            Self::SegmentEnds { x, y } => {
                format!("both ends are at {}; what has one place and a radius is a circle", units.place(x, y))
            }
            Self::Rounding { radius } => format!(
                "radius {}: a polygon is rounded by 0 or more, and one that is rounded at all lies within {most}",
                length(radius)
            ),
            Self::VertexCount { .. } | Self::NotFinite { .. } | Self::EdgesMeet { .. } => self.to_string(),
        }
    }
}

/// All places within a radius of a core: of a point, of the straight line between two, or of a simple polygon with its
/// inside. So one vertex makes a disc, two a capsule or, without a radius, a wall as thin as a line; three and more make a
/// polygon, with a radius one that is rounded. Sound by construction.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    vertices: SmallVec<[Point; 2]>,
    radius: f64,
}

impl Shape {
    /// The disc of `radius` (m) around `center`.
    ///
    /// # Errors
    /// [`ShapeError`] unless the radius is greater than 0 and everything finite.
    pub fn circle(center: Point, radius: f64) -> Result<Self, ShapeError> {
        if radius > 0.0 && radius <= GREATEST && is_near(center) {
            Ok(Self { vertices: SmallVec::from_slice(&[center]), radius })
        } else {
            Err(ShapeError::Circle { x: center.x, y: center.y, radius })
        }
    }

    /// The straight line between two points, as thick as its `radius` (m) says: a capsule, or a wall without thickness.
    ///
    /// # Errors
    /// [`ShapeError`] unless the ends differ, the radius is 0 or greater and everything finite.
    pub fn segment(from: Point, to: Point, radius: f64) -> Result<Self, ShapeError> {
        if !((0.0..=GREATEST).contains(&radius) && is_near(from) && is_near(to)) {
            let Point { x, y } = if is_near(from) && !is_near(to) { to } else { from };
            return Err(ShapeError::Segment { x, y, radius });
        }
        if from == to {
            return Err(ShapeError::SegmentEnds { x: from.x, y: from.y });
        }
        Ok(Self { vertices: SmallVec::from_buf([from, to]), radius })
    }

    /// The polygon with these corners, in either direction, without repeating the first; convex or not.
    ///
    /// # Errors
    /// [`ShapeError`] unless the boundary is a closed line of non-zero length edges that nowhere
    /// crosses or touches itself; decided exactly.
    pub fn polygon(vertices: Vec<Point>) -> Result<Self, ShapeError> {
        if !(3..=MAX_VERTICES).contains(&vertices.len()) {
            return Err(ShapeError::VertexCount { found: vertices.len() });
        }
        if let Some(vertex) = vertices.iter().position(|v| !v.is_finite()) {
            return Err(ShapeError::NotFinite { vertex });
        }
        match polygon::first_meeting_edges(&vertices) {
            Some((first, second)) => Err(ShapeError::EdgesMeet { first, second }),
            None => Ok(Self { vertices: vertices.into(), radius: 0.0 }),
        }
    }

    /// All that is within `radius` (m) of the polygon with these corners.
    ///
    /// # Errors
    /// As [`polygon`](Self::polygon); [`ShapeError::Rounding`] unless the radius is 0 or greater.
    pub fn rounded_polygon(vertices: Vec<Point>, radius: f64) -> Result<Self, ShapeError> {
        let polygon = Self::polygon(vertices)?;
        let sound = radius == 0.0
            || (radius > 0.0 && radius <= GREATEST && polygon.vertices.iter().copied().all(is_near));
        if sound { Ok(Self { radius, ..polygon }) } else { Err(ShapeError::Rounding { radius }) }
    }

    /// The same shape moved by so much; rounding is taken not to let edges meet.
    #[must_use]
    pub fn shifted(&self, by: Vector) -> Self {
        Self { vertices: self.vertices.iter().map(|vertex| *vertex + by).collect(), radius: self.radius }
    }

    /// All that is within `by` (m) of the shape; `None` if that is not 0 or greater, or too great.
    pub fn grown(&self, by: f64) -> Option<Self> {
        let radius = self.radius + by;
        let sound = by >= 0.0 && radius <= GREATEST && self.vertices.iter().copied().all(is_near);
        sound.then(|| Self { vertices: self.vertices.clone(), radius })
    }

    /// Of the core, in the order given: a disc's centre, a segment's ends, a polygon's corners.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// How far from the core the shape ends (m).
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether the core is a polygon, which has an inside.
    pub fn has_inside(&self) -> bool {
        self.vertices.len() > 2
    }

    /// The lines of the core, each once; the one that closes a polygon comes last. That of a disc has no length.
    pub fn edges(&self) -> impl Iterator<Item = Segment> + '_ {
        let n = self.vertices.len();
        let lines = if n == 2 { 1 } else { n };
        (0..lines).map(move |i| Segment::new(self.vertices[i], self.vertices[(i + 1) % n]))
    }

    /// Distance from the shape to `segment` (m): 0 or less when they touch.
    pub fn distance_to_segment(&self, segment: Segment) -> f64 {
        self.core_to_segment(segment) - self.radius
    }

    /// Distance from the shape to `segment` (m), negative by the depth: how far the segment's innermost point lies from the
    /// boundary, to a millionth of the segment's length. Where a rounded polygon is not convex it may be deeper.
    ///
    /// Slower than [`distance_to_segment`](Self::distance_to_segment) for polygons.
    pub fn signed_distance_to_segment(&self, segment: Segment) -> f64 {
        self.signed_distance_within(segment, 1e-6 * segment.a.distance(segment.b))
    }

    /// [`signed_distance_to_segment`](Self::signed_distance_to_segment), to `tolerance` (m).
    pub fn signed_distance_within(&self, segment: Segment, tolerance: f64) -> f64 {
        let distance = self.core_to_segment(segment);
        if distance > 0.0 || !self.has_inside() {
            return distance - self.radius;
        }
        -polygon::depth_of_segment(&self.vertices, segment, tolerance) - self.radius
    }

    /// A circle around the shape: its centre, and its radius (m).
    pub fn bounding_circle(&self) -> (Point, f64) {
        let (center, radius) = self.circle_around_core();
        (center, radius + self.radius)
    }

    /// A circle around the core: the middle of the bounding box, and the farthest vertex (m).
    pub(crate) fn circle_around_core(&self) -> (Point, f64) {
        let (mut least, mut most) = (self.vertices[0], self.vertices[0]);
        for v in &self.vertices {
            least = Point::new(least.x.min(v.x), least.y.min(v.y));
            most = Point::new(most.x.max(v.x), most.y.max(v.y));
        }
        let center = Point::new((least.x + most.x) / 2.0, (least.y + most.y) / 2.0);
        (center, self.vertices.iter().map(|v| v.distance(center)).fold(0.0, f64::max))
    }

    /// Distance from the core to `segment` (m); 0 when they meet or the segment lies inside.
    fn core_to_segment(&self, segment: Segment) -> f64 {
        match *self.vertices.as_slice() {
            [center] => segment.distance_to_point(center),
            [from, to] => Segment::new(from, to).distance_to_segment(segment),
            ref vertices => polygon::distance_to_segment(vertices, segment),
        }
    }
}

fn is_near(point: Point) -> bool {
    point.x.abs() <= GREATEST && point.y.abs() <= GREATEST
}
