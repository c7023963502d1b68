//! Whether the arm, or its tip, cannot be anywhere along a line: the opposite of a sweep.

use super::clearance::{Axis, Body};
use crate::arm::lerp_pair;
use crate::geometry::Point;
use crate::scene::TwoLinkScene;

/// Halvings after which a stretch of a line is given up.
const DEEPEST: u32 = 24;

/// The obstacles and what is needed to look at them along many lines.
pub(super) struct Blocked<'a> {
    base: [f64; 2],
    lengths: [f64; 2],
    half_width: f64,
    bodies: Vec<(Body<'a>, f64)>,
}

/// Between so many halvings what touches is halved on without a look at what else does, which may be deeper.
const HALVINGS_PER_LOOK: u32 = 4;

/// What blocked the last configuration: it likely blocks the next.
type Witness = Option<(usize, usize)>;

impl<'a> Blocked<'a> {
    pub(super) fn new(scene: TwoLinkScene<'a>) -> Self {
        let arm = scene.arm();
        let (base, [l1, l2]) = (arm.base(), arm.lengths());
        let reach = base.x.abs() + base.y.abs() + l1 + l2 + arm.half_width();
        let bodies = scene.obstacles().iter().map(|obstacle| {
            let body = Body::new(&obstacle.shape);
            let rounding = body.rounding(reach);
            (body, rounding)
        });
        Self {
            base: [base.x, base.y],
            lengths: [l1, l2],
            half_width: arm.half_width(),
            bodies: bodies.collect(),
        }
    }

    /// Whether at every place of the straight joint motion from `from` to `to` a link touches an obstacle: proved, not
    /// sampled. A link that is `d` deep at a place still touches where none of its points moved by more than `d`.
    pub(super) fn all_along(&self, from: &[f64; 2], to: &[f64; 2]) -> bool {
        let mut witness = None;
        self.between(from, to, &mut witness, 0)
    }

    /// Whether the tip touches an obstacle at every place of the line from `from` to `to` (m).
    pub(super) fn tip_all_along(&self, from: Point, to: Point, depth: u32) -> bool {
        let middle = from.lerp(to, 0.5);
        let half = 0.5 * from.distance(to);
        let axis = Axis { start: [middle.x, middle.y], along: [1.0, 0.0], length: 0.0 };
        let depths = self.bodies.iter().map(|(body, rounding)| body.depth(&axis, self.half_width) - rounding);
        let deepest = depths.fold(f64::NEG_INFINITY, f64::max);
        deepest > half
            || (deepest > 0.0
                && depth < DEEPEST
                && self.tip_all_along(from, middle, depth + 1)
                && self.tip_all_along(middle, to, depth + 1))
    }

    fn between(&self, from: &[f64; 2], to: &[f64; 2], witness: &mut Witness, depth: u32) -> bool {
        let middle = lerp_pair(from, to, 0.5);
        let turn = [0.5 * (to[0] - from[0]), 0.5 * (to[1] - from[1])];
        let first = self.lengths[0] * turn[0].abs();
        let bounds = [first, first + self.lengths[1] * (turn[0] + turn[1]).abs()];
        let axes = self.axes(&middle);
        let halves = |witness: &mut Witness| {
            depth < DEEPEST
                && self.between(from, &middle, witness, depth + 1)
                && self.between(&middle, to, witness, depth + 1)
        };
        if let Some((link, body)) = *witness {
            let known = self.depth(&axes, link, body);
            if known > bounds[link] {
                return true;
            }
            if known > 0.0 && !depth.is_multiple_of(HALVINGS_PER_LOOK) {
                return halves(witness);
            }
        }
        let mut best = (f64::NEG_INFINITY, None);
        let mut deepest = f64::NEG_INFINITY;
        // Where the first link is clear all along, as between most walls, the second is what touches.
        for link in [1, 0] {
            for body in 0..self.bodies.len() {
                let depth = self.depth(&axes, link, body);
                deepest = deepest.max(depth);
                if depth - bounds[link] > best.0 {
                    best = (depth - bounds[link], Some((link, body)));
                }
            }
            if best.0 > 0.0 {
                break;
            }
        }
        *witness = best.1;
        if best.0 > 0.0 {
            return true;
        }
        deepest > 0.0 && halves(witness)
    }

    fn axes(&self, q: &[f64; 2]) -> [Axis; 2] {
        let ((s1, c1), (s2, c2)) = (libm::sincos(q[0]), libm::sincos(q[0] + q[1]));
        let [l1, l2] = self.lengths;
        let elbow = [self.base[0] + l1 * c1, self.base[1] + l1 * s1];
        [
            Axis { start: self.base, along: [c1, s1], length: l1 },
            Axis { start: elbow, along: [c2, s2], length: l2 },
        ]
    }

    /// How far every point of a link may move (m) with the link still touching; 0 or less where it does not touch.
    fn depth(&self, axes: &[Axis; 2], link: usize, body: usize) -> f64 {
        let (body, rounding) = &self.bodies[body];
        body.depth(&axes[link], self.half_width) - rounding
    }
}
