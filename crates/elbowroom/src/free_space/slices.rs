//! What the obstacles forbid in configuration space, slice by slice: exact intervals of the second joint for a place
//! of the first, in closed form.
//!
//! A link that turns about its start meets a disc in one arc of directions, and a line in one: the union over all
//! discs and lines that the outline of what must not be touched is made of is all that is forbidden, for a link that
//! begins outside. Discs lie around the core's vertices, lines on both sides of its edges.

use std::f64::consts::{PI, TAU};

use crate::arm::TwoLink;
use crate::geometry::{Point, Segment, Shape, Vector, angle_difference};
use crate::scene::{Obstacle, TwoLinkScene};

/// Gaps between arcs up to this (rad) are rounding.
const ROUNDING: f64 = 1e-12;

/// The forbidden places of the joints of an arm among obstacles.
#[derive(Debug, Clone)]
pub struct Slices<'a> {
    arm: TwoLink,
    obstacles: &'a [Obstacle],
    /// How near to an obstacle a link's centre line may not come (m).
    width: f64,
}

/// Directions from `start` counter-clockwise over `width` (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arc {
    start: f64,
    width: f64,
}

impl<'a> Slices<'a> {
    /// The slices of `scene`, with links that must stay `margin` (m) clear.
    pub fn new(scene: TwoLinkScene<'a>, margin: f64) -> Self {
        Self { arm: *scene.arm(), obstacles: scene.obstacles(), width: scene.arm().half_width() + margin }
    }

    /// Where in `range` (rad) the first joint makes the first link touch an obstacle: intervals in order that do not
    /// overlap.
    pub fn first_joint(&self, range: [f64; 2]) -> Vec<[f64; 2]> {
        self.forbidden(self.arm.base(), self.arm.lengths()[0], 0.0, range)
    }

    /// Where in `range` (rad) the second joint makes the second link touch an obstacle while the first stands at
    /// `q1` (rad).
    pub fn second_joint(&self, q1: f64, range: [f64; 2]) -> Vec<[f64; 2]> {
        let [l1, l2] = self.arm.lengths();
        self.forbidden(self.arm.base() + Vector::polar(l1, q1), l2, q1, range)
    }

    fn forbidden(&self, pivot: Point, length: f64, carrier: f64, range: [f64; 2]) -> Vec<[f64; 2]> {
        let mut found: Vec<[f64; 2]> = Vec::new();
        for obstacle in self.obstacles {
            self.arcs(&obstacle.shape, pivot, length, &mut |arc| {
                if arc.width >= TAU {
                    found.push(range);
                    return;
                }
                let start = arc.start - carrier;
                let first = ((range[0] - start - arc.width) / TAU).ceil();
                let last = ((range[1] - start) / TAU).floor();
                for turn in first as i64..=last as i64 {
                    let from = start + TAU * turn as f64;
                    found.push([from.max(range[0]), (from + arc.width).min(range[1])]);
                }
            });
        }
        merged(found)
    }

    /// Calls `each` with the arcs of directions in which a link that begins at `pivot` comes too near to `shape`.
    fn arcs(&self, shape: &Shape, pivot: Point, length: f64, each: &mut impl FnMut(Arc)) {
        let all = Arc { start: -PI, width: TAU };
        let width = shape.radius() + self.width;
        let mut inside = false;
        for edge in shape.edges() {
            inside ^= shape.has_inside() && passes_right_of(edge, pivot);
            if edge.distance_to_point(pivot) <= width {
                each(all);
                return;
            }
            let along = edge.b - edge.a;
            // One too short for its square is as good as its ends.
            if along.length_squared() <= f64::MIN_POSITIVE {
                continue;
            }
            let aside = Vector::new(-along.y, along.x) * (width / along.length());
            if width > 0.0 {
                let other = Segment::new(edge.a + -aside, edge.b + -aside);
                each_some(line(pivot, length, other), each);
            }
            each_some(line(pivot, length, Segment::new(edge.a + aside, edge.b + aside)), each);
        }
        if width > 0.0 {
            shape.vertices().iter().for_each(|&vertex| each_some(disc(pivot, length, vertex, width), each));
        }
        if inside {
            each(all);
        }
    }
}

fn each_some(arc: Option<Arc>, each: &mut impl FnMut(Arc)) {
    if let Some(arc) = arc {
        each(arc);
    }
}

/// Directions in which a link of `length` from `pivot` touches a disc.
fn disc(pivot: Point, length: f64, center: Point, radius: f64) -> Option<Arc> {
    let ray = center - pivot;
    let squared = ray.length_squared();
    let distance = squared.sqrt();
    if distance <= radius {
        return Some(Arc { start: -PI, width: TAU });
    }
    if distance > length + radius {
        return None;
    }
    let half = if squared <= length * length + radius * radius {
        libm::asin((radius / distance).min(1.0))
    } else {
        let cos = (squared + length * length - radius * radius) / (2.0 * distance * length);
        libm::acos(cos.clamp(-1.0, 1.0))
    };
    Some(Arc { start: ray.angle() - half, width: 2.0 * half })
}

/// Directions in which a link of `length` from `pivot` touches a line that does not go through the pivot.
fn line(pivot: Point, length: f64, line: Segment) -> Option<Arc> {
    let (along, ray) = (line.b - line.a, line.a - pivot);
    let squared = along.length_squared();
    if squared == 0.0 {
        return None;
    }
    // What of the line lies in the link's reach: |ray + along t| <= length.
    let middle = -ray.dot(along) / squared;
    let off = ray.cross(along);
    let half = (length * length - off * off / squared) / squared;
    if half < 0.0 {
        return None;
    }
    let half = half.sqrt();
    let (from, to) = ((middle - half).max(0.0), (middle + half).min(1.0));
    if from > to {
        return None;
    }
    let end = |t: f64| match t {
        0.0 => line.a,
        1.0 => line.b,
        _ => line.a + along * t,
    };
    let (a, b) = ((end(from) - pivot).angle(), (end(to) - pivot).angle());
    let turn = angle_difference(a, b);
    Some(if turn >= 0.0 { Arc { start: a, width: turn } } else { Arc { start: b, width: -turn } })
}

/// Whether the ray from `point` to the right passes the edge; one of its ends belongs to it.
fn passes_right_of(edge: Segment, point: Point) -> bool {
    let (a, b) = (edge.a - point, edge.b - point);
    (a.y > 0.0) != (b.y > 0.0) && (a.cross(b) > 0.0) == (b.y > a.y)
}

/// The union of intervals, in order.
pub(crate) fn merged(mut intervals: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    intervals.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut union: Vec<[f64; 2]> = Vec::with_capacity(intervals.len());
    for [from, to] in intervals {
        match union.last_mut() {
            Some(last) if from <= last[1] + ROUNDING => last[1] = last[1].max(to),
            _ => union.push([from, to]),
        }
    }
    union
}
