//! The verifier's own distances: from a link's centre line to discs, capsules and polygons, rounded or not.

use crate::geometry::{Point, Shape};

/// Rounding of a distance as a share of the greatest coordinate it comes from: some sixteen roundings at
/// most, sine and cosine included, and four times as many for safety.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Beyond this size (m) squares may overflow; nothing is certified there.
const LARGEST: f64 = 1e150;

/// Turns (rad) up to which the bound that knows the place on the link is used; a wider one is a case for
/// halving the time first.
const WIDEST_TURN: f64 = 0.5;

/// A link's centre line at one configuration: from `start` (m) in the unit direction `along`.
pub(super) struct Axis {
    pub(super) start: [f64; 2],
    pub(super) along: [f64; 2],
    pub(super) length: f64,
}

/// An obstacle prepared for looking at it many times: all that is within a radius of a point, a line or a polygon.
pub(super) struct Body<'a> {
    core: &'a [Point],
    /// How far from the core the obstacle ends (m).
    thickness: f64,
    /// A disc around all of it; for a disc, that disc.
    center: [f64; 2],
    radius: f64,
    /// Greatest coordinate (m).
    size: f64,
}

impl<'a> Body<'a> {
    pub(super) fn new(shape: &'a Shape) -> Self {
        let (core, thickness) = (shape.vertices(), shape.radius());
        if let [center] = core {
            let (center, radius) = ([center.x, center.y], thickness);
            let size = center[0].abs() + center[1].abs() + radius;
            return Self { core, thickness, center, radius, size };
        }
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for vertex in core {
            for (axis, v) in [vertex.x, vertex.y].into_iter().enumerate() {
                low[axis] = low[axis].min(v);
                high[axis] = high[axis].max(v);
            }
        }
        let center = [0.5 * low[0] + 0.5 * high[0], 0.5 * low[1] + 0.5 * high[1]];
        let radius = length([high[0] - center[0], high[1] - center[1]]) + thickness;
        let size = low.iter().chain(&high).fold(0.0, |most: f64, v| most.max(v.abs())) + radius;
        Self { core, thickness, center, radius, size }
    }

    /// The straight line between two points.
    pub(super) fn segment(ends: &'a [Point; 2]) -> Self {
        let [a, b] = ends;
        let center = [0.5 * a.x + 0.5 * b.x, 0.5 * a.y + 0.5 * b.y];
        let radius = length([b.x - center[0], b.y - center[1]]);
        let size = [a.x, a.y, b.x, b.y].into_iter().fold(0.0, |most: f64, v| most.max(v.abs())) + radius;
        Self { core: ends, thickness: 0.0, center, radius, size }
    }

    /// How far a distance from a link within `reach` (m) of the origin may be off (m).
    pub(super) fn rounding(&self, reach: f64) -> f64 {
        let size = self.size + reach;
        if size < LARGEST { ROUNDING * size } else { f64::INFINITY }
    }

    /// Least distance (m) from `axis` to the obstacle; not above 0 when they meet: then minus the depth, but in the core of
    /// a polygon no more than its thickness.
    pub(super) fn distance(&self, axis: &Axis) -> f64 {
        self.distance_while_turning(axis, 0.0)
    }

    /// How far every point of a link of half `width` (m) may move with the link still meeting the obstacle; not above 0
    /// where it does not meet it.
    pub(super) fn depth(&self, axis: &Axis, width: f64) -> f64 {
        let hull = self.distance_of_hull(axis, 0.0);
        // The obstacle is at least as far away as the disc around it.
        if self.is_disc() || hull > width {
            return width - hull;
        }
        // As far as the core is from where a link still meets the obstacle.
        let width = width + self.thickness;
        let distance = core_distance(axis, 0.0, self.core);
        if distance > 0.0 { width - distance } else { width + core_depth(axis, self.core) }
    }

    fn is_disc(&self) -> bool {
        self.core.len() == 1
    }

    /// Least distance (m) that the link keeps while it turns about its start by no more than `turn` (rad)
    /// either way: the least of "distance - turn * way from the start" over the points of the link.
    pub(super) fn distance_while_turning(&self, axis: &Axis, turn: f64) -> f64 {
        if turn > WIDEST_TURN {
            return self.distance(axis) - axis.length * turn;
        }
        if self.is_disc() {
            return self.distance_of_hull(axis, turn);
        }
        core_distance(axis, turn, self.core) - self.thickness
    }

    /// The same as [`Self::distance_while_turning`] for the disc around the obstacle: never more.
    pub(super) fn distance_of_hull(&self, axis: &Axis, turn: f64) -> f64 {
        if turn > WIDEST_TURN {
            return self.distance_of_hull(axis, 0.0) - axis.length * turn;
        }
        let tilt = Tilt::new(axis, turn);
        let (along, aside) = tilt.place(self.center);
        tilt.distance(along, aside) - self.radius
    }
}

/// An axis with the turn it may make: measures points by where they lie along and aside of the axis.
struct Tilt<'a> {
    axis: &'a Axis,
    turn: f64,
    /// Tangent of the angle whose sine is `turn`.
    tangent: f64,
}

impl<'a> Tilt<'a> {
    fn new(axis: &'a Axis, turn: f64) -> Self {
        Self { axis, turn, tangent: turn / (1.0 - turn * turn).sqrt() }
    }

    fn place(&self, point: [f64; 2]) -> (f64, f64) {
        let [dx, dy] = [point[0] - self.axis.start[0], point[1] - self.axis.start[1]];
        let [ux, uy] = self.axis.along;
        (dx * ux + dy * uy, dy * ux - dx * uy)
    }

    /// Least of |point - axis at r| - turn * r over r: a convex function, least where its slope is 0.
    fn distance(&self, along: f64, aside: f64) -> f64 {
        let r = (along + aside.abs() * self.tangent).clamp(0.0, self.axis.length);
        length([along - r, aside]) - self.turn * r
    }
}

/// Over an edge and the axis "distance - turn * r" is convex, and without a crossing its least value is found
/// with a vertex of the edge or an end of the axis: so every vertex against the axis and both ends of the axis
/// against every edge are enough. A line between two vertices is an edge there and back, with nothing inside.
fn core_distance(axis: &Axis, turn: f64, vertices: &[Point]) -> f64 {
    let tilt = Tilt::new(axis, turn);
    let reach = axis.length * turn;
    let end = [axis.start[0] + axis.length * axis.along[0], axis.start[1] + axis.length * axis.along[1]];
    let mut least = f64::INFINITY;
    let mut start_is_inside = false;
    let mut a = vertices[vertices.len() - 1];
    let (mut along_a, mut aside_a) = tilt.place([a.x, a.y]);
    for &b in vertices {
        let (along_b, aside_b) = tilt.place([b.x, b.y]);
        if (aside_a > 0.0) != (aside_b > 0.0) {
            let r = along_a + (along_b - along_a) * (aside_a / (aside_a - aside_b));
            if (0.0..=axis.length).contains(&r) {
                return -reach;
            }
        }
        least = least
            .min(tilt.distance(along_b, aside_b))
            .min(distance_to_edge(axis.start, a, b))
            .min(distance_to_edge(end, a, b) - reach);
        start_is_inside ^= ray_meets_edge(axis.start, a, b);
        (a, along_a, aside_a) = (b, along_b, aside_b);
    }
    if start_is_inside && vertices.len() > 2 { -reach } else { least }
}

/// A link goes on crossing an edge while its ends stay on their sides of the edge's line and the edge's ends off the
/// link; and an end of it stays inside while it moves less far than the boundary is.
fn core_depth(axis: &Axis, vertices: &[Point]) -> f64 {
    let tilt = Tilt::new(axis, 0.0);
    let end = [axis.start[0] + axis.length * axis.along[0], axis.start[1] + axis.length * axis.along[1]];
    let mut crossing = 0.0_f64;
    let mut to_boundary = [f64::INFINITY; 2];
    let mut inside = [false; 2];
    let mut a = vertices[vertices.len() - 1];
    for &b in vertices {
        let (edge_x, edge_y) = (b.x - a.x, b.y - a.y);
        let size = length([edge_x, edge_y]);
        let sides = [axis.start, end].map(|p| (edge_x * (p[1] - a.y) - edge_y * (p[0] - a.x)) / size);
        let ((along_a, aside_a), (along_b, aside_b)) = (tilt.place([a.x, a.y]), tilt.place([b.x, b.y]));
        if (sides[0] > 0.0) != (sides[1] > 0.0) && (aside_a > 0.0) != (aside_b > 0.0) {
            let off = tilt.distance(along_a, aside_a).min(tilt.distance(along_b, aside_b));
            crossing = crossing.max(off.min(sides[0].abs()).min(sides[1].abs()));
        }
        for (i, p) in [axis.start, end].into_iter().enumerate() {
            to_boundary[i] = to_boundary[i].min(distance_to_edge(p, a, b));
            inside[i] ^= ray_meets_edge(p, a, b);
        }
        a = b;
    }
    let is_inside = |&i: &usize| inside[i] && vertices.len() > 2;
    let deepest_end = (0..2).filter(is_inside).map(|i| to_boundary[i]).fold(0.0, f64::max);
    crossing.max(deepest_end)
}

fn distance_to_edge(point: [f64; 2], a: Point, b: Point) -> f64 {
    let [ex, ey] = [b.x - a.x, b.y - a.y];
    let [dx, dy] = [point[0] - a.x, point[1] - a.y];
    let square = ex * ex + ey * ey;
    // An edge whose square underflows is a point for the digits that count.
    let t = if square > 0.0 { ((dx * ex + dy * ey) / square).clamp(0.0, 1.0) } else { 0.0 };
    length([dx - t * ex, dy - t * ey])
}

/// Whether the ray from `point` to the right passes the edge; one of its ends belongs to it.
fn ray_meets_edge(point: [f64; 2], a: Point, b: Point) -> bool {
    let [ax, ay] = [a.x - point[0], a.y - point[1]];
    let [bx, by] = [b.x - point[0], b.y - point[1]];
    (ay > 0.0) != (by > 0.0) && (ax * by - bx * ay > 0.0) == (by > ay)
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}
