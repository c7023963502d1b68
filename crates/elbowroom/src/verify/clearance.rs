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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::random::unit;
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    fn shape(rng: &mut ChaCha8Rng, kind: usize) -> Shape {
        let mut place = || Point::new(2.0 * unit(rng) - 1.0, 2.0 * unit(rng) - 1.0);
        let (a, b) = (place(), place());
        let corner = |i: usize| a + Vector::polar(0.6, 0.3 + 1.2 * i as f64);
        match kind {
            0 => Shape::circle(a, 0.4).unwrap(),
            1 => Shape::segment(a, b, 0.1).unwrap(),
            2 => Shape::polygon((0..5).map(corner).collect()).unwrap(),
            _ => Shape::rounded_polygon((0..5).map(corner).collect(), 0.1).unwrap(),
        }
    }

    #[test]
    fn a_link_still_touches_wherever_it_moves_by_less_than_its_depth() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let mut deep = 0;
        for case in 0..4000 {
            let shape = shape(&mut rng, case % 4);
            let body = Body::new(&shape);
            let width = if case % 3 == 0 { 0.0 } else { 0.05 };
            let angle = 6.0 * unit(&mut rng);
            let along = [libm::cos(angle), libm::sin(angle)];
            let start = [3.0 * unit(&mut rng) - 1.5, 3.0 * unit(&mut rng) - 1.5];
            let length = 0.2 + unit(&mut rng);
            let axis = |by: [f64; 2]| Axis { start: [start[0] + by[0], start[1] + by[1]], along, length };
            let depth = body.depth(&axis([0.0, 0.0]), width);
            let distance = body.distance(&axis([0.0, 0.0]));
            if depth <= 0.0 {
                assert!(distance >= width - 1e-12, "apart by {distance}, and {depth} deep");
                continue;
            }
            deep += 1;
            let mut comes_out = false;
            for look in 0..64 {
                let way = f64::from(look) * std::f64::consts::TAU / 64.0;
                let moved = |by: f64| body.distance(&axis([by * libm::cos(way), by * libm::sin(way)]));
                assert!(moved(0.999 * depth) <= width + 1e-9, "{case}: out before {depth}");
                comes_out |= moved(1.01 * depth + 1e-9) > width;
            }
            // What touches from outside the core is exactly so deep.
            if distance > 1e-9 - shape.radius() {
                let nearest = width - distance;
                assert!((depth - nearest).abs() < 1e-9, "{case}: {depth}, {nearest}");
                assert!(comes_out || shape.vertices().len() > 1, "{case}: {depth} is too little");
            }
        }
        assert!(deep > 500, "{deep}");
    }

    #[test]
    fn a_line_between_two_points_is_as_far_away_as_the_shape_of_it() {
        let mut rng = ChaCha8Rng::seed_from_u64(4);
        for _ in 0..2000 {
            let mut place = || Point::new(4.0 * unit(&mut rng) - 2.0, 4.0 * unit(&mut rng) - 2.0);
            let ends = [place(), place()];
            let from = place();
            let line = Body::segment(&ends);
            let shape = Shape::segment(ends[0], ends[1], 0.0).unwrap();
            let of_shape = Body::new(&shape);
            let axis = Axis { start: [from.x, from.y], along: [0.6, 0.8], length: 0.7 };
            assert_eq!(line.distance(&axis), of_shape.distance(&axis));
            // The rounding of a body is of all that it comes from.
            let size = ends.iter().map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
            assert!(line.rounding(1.0) >= ROUNDING * (size + 1.0));
        }
    }
}
