use super::stances::{Lanes, Links, squared_distance};
use crate::geometry::{Point, Segment, Shape};

/// The edges of a shape's core, made ready for many looks; positions are seen from the base.
pub(super) struct Boundary {
    edges: Vec<Edge>,
    /// A cross product up to which rounding may decide on which side of a line a point lies (m²).
    rounding: f64,
}

struct Edge {
    /// Where it begins, and the way to its end (m).
    x: f64,
    y: f64,
    dx: f64,
    dy: f64,
    /// y of its end: the very number that the next edge begins with, so that both tell alike who is above it.
    end_y: f64,
    inverse_squared: f64,
    /// Its way in x by that in y.
    slope: f64,
}

impl Boundary {
    pub(super) fn new(shape: &Shape, base: Point, rounding: f64) -> Self {
        // Of each edge the first end is examined: a line between two points is one there and one back.
        let back = shape.edges().filter(|_| !shape.has_inside()).map(|edge| Segment::new(edge.b, edge.a));
        let edges = shape.edges().chain(back).map(|edge| {
            let (from, to, way) = (edge.a - base, edge.b - base, edge.b - edge.a);
            let squared = way.length_squared();
            // An edge too short for its square is as good as its first end.
            let inverse_squared = if squared > f64::MIN_POSITIVE { 1.0 / squared } else { 0.0 };
            let slope = way.x / (to.y - from.y);
            // A line alone has nothing inside: no one is at the height of an edge that ends as high as it begins.
            let end_y = if shape.has_inside() { to.y } else { from.y };
            Edge { x: from.x, y: from.y, dx: way.x, dy: way.y, end_y, inverse_squared, slope }
        });
        Self { edges: edges.collect(), rounding }
    }

    /// For each link the square of the least distance between an end of it, or of an edge, and the other (m²):
    /// negative where it crosses the boundary or lies inside, not a number where rounding decides on that.
    ///
    /// While nothing moves farther than its root, what is negative stays so.
    #[inline(always)]
    pub(super) fn measure<const N: usize>(&self, links: &Links<N>, measure: &mut Lanes<N>) {
        let (mut nearest, mut side, mut doubt) = ([f64::INFINITY; N], [f64::INFINITY; N], [f64::INFINITY; N]);
        // Negative inside: each edge to the right of a link's first end turns it.
        let mut inside = [1.0; N];
        for edge in &self.edges {
            for lane in 0..N {
                // From the edge's first end to the link's, and the link's way.
                let (x, y) = (links.x[lane] - edge.x, links.y[lane] - edge.y);
                let (dx, dy) = (links.dx[lane], links.dy[lane]);
                let corner = squared_distance(-x, -y, dx, dy, links.inverse_squared);
                let first = squared_distance(x, y, edge.dx, edge.dy, edge.inverse_squared);
                let second = squared_distance(x + dx, y + dy, edge.dx, edge.dy, edge.inverse_squared);
                nearest[lane] = least(nearest[lane], least(corner, least(first, second)));

                let turn = edge.dx * dy - edge.dy * dx;
                let beside_edge = edge.dx * y - edge.dy * x;
                let beside_link = x * dy - y * dx;
                let apart = most(
                    one_side(beside_edge, beside_edge + turn),
                    one_side(beside_link, beside_link - turn),
                );
                side[lane] = least(side[lane], apart);
                doubt[lane] = least(doubt[lane], apart.abs());

                let level = (links.y[lane] < edge.y) != (links.y[lane] < edge.end_y);
                inside[lane] = if level & (x < y * edge.slope) { -inside[lane] } else { inside[lane] };
            }
        }
        for lane in 0..N {
            let enters = (side[lane] < -self.rounding) | (inside[lane] < 0.0);
            let outside = if doubt[lane] > self.rounding { nearest[lane] } else { f64::NAN };
            measure[lane] = if enters { -nearest[lane] } else { outside };
        }
    }
}

/// Positive when `a` and `b` are of one sign: the smaller size of them; negative by that when they are not.
#[inline(always)]
fn one_side(a: f64, b: f64) -> f64 {
    most(least(a, b), -most(a, b))
}

#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
