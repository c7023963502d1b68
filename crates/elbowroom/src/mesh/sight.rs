//! What is seen along straight lines, with rounding in favour of being seen.

use crate::geometry::{Point, Vector};

/// Cross products below this share of their factors count as 0, in favour of being seen.
const ROUNDING: f64 = 1e-13;

/// From and to which share the line from `p` to `q`, counter-clockwise as seen from `root`, lies between two rays.
pub(super) fn seen(root: &Point, right: &Vector, left: &Vector, p: Point, q: Point) -> (f64, f64) {
    let (to_p, to_q) = (p - *root, q - *root);
    let after_right = [right.cross(to_p), right.cross(to_q)];
    let before_left = [-left.cross(to_p), -left.cross(to_q)];
    let share = |[at_p, at_q]: [f64; 2]| (at_p / (at_p - at_q)).clamp(0.0, 1.0);
    // Once round the cell, what is hidden to the right comes first and what is hidden to the left last.
    let from = match (below(after_right[0], right, &to_p), below(after_right[1], right, &to_q)) {
        (_, true) => 1.0,
        (true, false) => share(after_right),
        (false, false) => 0.0,
    };
    let to = match (below(before_left[0], left, &to_p), below(before_left[1], left, &to_q)) {
        (true, _) => 0.0,
        (false, true) => share(before_left),
        (false, false) => 1.0,
    };
    (from, to.max(from))
}

/// `share`, at an end of its line if it is that near.
pub(super) fn snapped(share: f64, near: f64) -> f64 {
    if share < near {
        0.0
    } else if share > 1.0 - near {
        1.0
    } else {
        share
    }
}

/// Whether the cross product of `a` and `b` is below 0 by more than rounding.
pub(super) fn below(cross: f64, a: &Vector, b: &Vector) -> bool {
    cross < 0.0 && cross * cross > ROUNDING * ROUNDING * a.length_squared() * b.length_squared()
}

/// Where the line from `from` to `to` crosses that from `a` to `b`, which it does but for rounding.
pub(super) fn crossing_of(from: Point, to: Point, a: Point, b: Point) -> Point {
    let (way, side) = (to - from, b - a);
    let across = side.cross(way);
    let share = if across == 0.0 {
        // Along the side: as soon as it is reached.
        side.dot(from - a) / side.length_squared()
    } else {
        way.cross(a - from) / across
    };
    a.lerp(b, share.clamp(0.0, 1.0))
}
