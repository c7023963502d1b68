use thiserror::Error;

use super::{Point, Segment, Vector};

/// The most vertices one polygon may have: its check for crossings takes quadratic time.
pub const MAX_VERTICES: usize = 10_000;

/// Why a list of points is not a simple polygon.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PolygonError {
    /// Fewer than three points, or more than [`MAX_VERTICES`].
    #[error("{found} vertices, 3 to {MAX_VERTICES} are allowed")]
    VertexCount {
        /// How many were given.
        found: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// Its place in the list, from 0.
        vertex: usize,
    },
    /// Two edges have more in common than a shared end.
    #[error("edge {first} (from vertex {first}) crosses or touches edge {second} (from vertex {second})")]
    EdgesMeet {
        /// The first edge, named by the vertex where it begins, from 0.
        first: usize,
        /// The second edge.
        second: usize,
    },
}

/// A simple polygon and its inside; convex or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    vertices: Vec<Point>,
}

impl Polygon {
    /// The polygon with these corners, in either direction, without repeating the first.
    ///
    /// # Errors
    /// [`PolygonError`] unless the boundary is a closed line of non-zero length edges that nowhere
    /// crosses or touches itself; decided exactly.
    pub fn new(vertices: Vec<Point>) -> Result<Self, PolygonError> {
        if !(3..=MAX_VERTICES).contains(&vertices.len()) {
            return Err(PolygonError::VertexCount { found: vertices.len() });
        }
        if let Some(vertex) = vertices.iter().position(|v| !v.is_finite()) {
            return Err(PolygonError::NotFinite { vertex });
        }
        let polygon = Self { vertices };
        match polygon.first_meeting_edges() {
            Some((first, second)) => Err(PolygonError::EdgesMeet { first, second }),
            None => Ok(polygon),
        }
    }

    /// The same polygon moved by so much; rounding is taken not to let edges meet.
    #[must_use]
    pub fn shifted(&self, by: Vector) -> Self {
        Self { vertices: self.vertices.iter().map(|vertex| *vertex + by).collect() }
    }

    /// The corners in the order given.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// The edges, the one that closes the polygon last.
    pub fn edges(&self) -> impl Iterator<Item = Segment> + '_ {
        let n = self.vertices.len();
        (0..n).map(move |i| Segment::new(self.vertices[i], self.vertices[(i + 1) % n]))
    }

    /// Whether `point` lies inside; the boundary may count either way.
    pub fn contains(&self, point: Point) -> bool {
        let mut inside = false;
        for edge in self.edges() {
            if (edge.a.y > point.y) != (edge.b.y > point.y) {
                let x = edge.a.x + (point.y - edge.a.y) / (edge.b.y - edge.a.y) * (edge.b.x - edge.a.x);
                inside ^= point.x < x;
            }
        }
        inside
    }

    /// Distance from the polygon to `segment` (m); 0 when they meet or the segment lies inside.
    pub fn distance_to_segment(&self, segment: Segment) -> f64 {
        if self.contains(segment.a) {
            return 0.0;
        }
        self.edges().map(|edge| edge.distance_to_segment(segment)).fold(f64::INFINITY, f64::min)
    }

    /// Distance from the polygon to `segment` (m), negative by the depth: how far the segment's innermost point
    /// lies from the boundary, to a millionth of the segment's length.
    pub fn signed_distance_to_segment(&self, segment: Segment) -> f64 {
        let distance = self.distance_to_segment(segment);
        let length = segment.a.distance(segment.b);
        if distance > 0.0 { distance } else { -self.depth_of_segment(segment, 1e-6 * length) }
    }

    /// How far the innermost point of a segment that meets the polygon lies from the boundary (m), less by `tolerance` (m)
    /// at most.
    pub fn depth_of_segment(&self, segment: Segment, tolerance: f64) -> f64 {
        // By bisection: depth changes along the segment no faster than the place does.
        let length = segment.a.distance(segment.b);
        let depth = |fraction: f64| {
            let point = segment.a + (segment.b - segment.a) * fraction;
            let to_boundary =
                self.edges().map(|edge| edge.distance_to_point(point)).fold(f64::INFINITY, f64::min);
            if self.contains(point) { to_boundary } else { -to_boundary }
        };
        let mut deepest = depth(0.0).max(depth(1.0)).max(0.0);
        let mut stretches = vec![(0.0, 1.0)];
        while let Some((from, to)) = stretches.pop() {
            let middle = (from + to) / 2.0;
            let here = depth(middle);
            deepest = deepest.max(here);
            if here + length * (to - from) / 2.0 > deepest + tolerance && to - from > 1e-9 {
                stretches.push((from, middle));
                stretches.push((middle, to));
            }
        }
        deepest
    }

    /// The first two edges, in their order, that have more in common than they may.
    ///
    /// Only edges whose boxes meet are looked at closely; they are found in the order of their left ends.
    fn first_meeting_edges(&self) -> Option<(usize, usize)> {
        let edges: Vec<Segment> = self.edges().collect();
        let x = |i: usize| (edges[i].a.x.min(edges[i].b.x), edges[i].a.x.max(edges[i].b.x));
        let y = |i: usize| (edges[i].a.y.min(edges[i].b.y), edges[i].a.y.max(edges[i].b.y));
        let mut left_to_right: Vec<usize> = (0..edges.len()).collect();
        left_to_right.sort_by(|&i, &j| x(i).0.total_cmp(&x(j).0));
        let mut first = None;
        for (place, &i) in left_to_right.iter().enumerate() {
            let ((_, right), (bottom, top)) = (x(i), y(i));
            for &j in left_to_right[place + 1..].iter().take_while(|&&j| x(j).0 <= right) {
                let pair = (i.min(j), i.max(j));
                let boxes_meet = y(j).0 <= top && bottom <= y(j).1;
                if boxes_meet && first.is_none_or(|first| pair < first) && edges_meet(&edges, pair) {
                    first = Some(pair);
                }
            }
        }
        first
    }
}

/// Whether two edges of a closed line, the first given first, have more in common than neighbours' shared end.
fn edges_meet(edges: &[Segment], (i, j): (usize, usize)) -> bool {
    if j == i + 1 {
        folds_back(edges[i].a, edges[i].b, edges[j].b)
    } else if i == 0 && j == edges.len() - 1 {
        folds_back(edges[j].a, edges[j].b, edges[i].b)
    } else {
        edges[i].meets(edges[j])
    }
}

/// Whether the corner a-b-c has an edge of no length or turns straight back.
fn folds_back(a: Point, b: Point, c: Point) -> bool {
    let (first, second) = (Segment::new(a, b), Segment::new(b, c));
    a == b || b == c || first.meets(Segment::new(c, c)) || second.meets(Segment::new(a, a))
}
