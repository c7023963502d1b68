//! Whether the arm may turn straight from one configuration to another: certified, not sampled.

use crate::arm::{Configuration, TwoLinkArm};
use crate::geometry::{Segment, Vector};
use crate::scene::{Obstacle, Scene};

/// Least clearance that a certified motion keeps (m): twice the verifier's floor, so that what is
/// certified here is not refused there for a rounding.
pub const CERTIFIED_CLEARANCE: f64 = 2e-9;

/// Clearances looked at per link and obstacle before a sweep is given up as not free: a motion of a metre
/// that stays within 8e-6 m of an obstacle all along may use them up, one that only passes by does not.
const MOST_LOOKS: u32 = 1 << 17;

/// The same where a refusal costs little.
const FEWER_LOOKS: u32 = 1 << 10;

/// Whether both links stay clear of every obstacle while each joint turns evenly from `from` to `to`.
///
/// By bisection with a bound on the motion: over a stretch whose points move by no more than `b`, a link
/// that is clear by `c0` at one end and `c1` at the other is clear all the way if `c0 + c1 > b`. `false`
/// also when a clearance comes down to [`CERTIFIED_CLEARANCE`], or cannot be told from it in bounded work. Joint limits
/// are not looked at: between two configurations within them there is no other.
///
/// # Reference
/// Schwarzer, Saha and Latombe, *Adaptive dynamic collision checking*, IEEE T-RO 21(3), 2005.
pub fn sweep_is_free(scene: &Scene, from: &Configuration<2>, to: &Configuration<2>) -> bool {
    sweep(scene, from, to, 0.0, MOST_LOOKS)
}

/// [`sweep_is_free`] with `margin` (m) more clearance, and given up sooner: for turns that would be nice to have.
pub fn sweep_keeps(scene: &Scene, from: &Configuration<2>, to: &Configuration<2>, margin: f64) -> bool {
    sweep(scene, from, to, margin, FEWER_LOOKS)
}

fn sweep(
    scene: &Scene,
    from: &Configuration<2>,
    to: &Configuration<2>,
    margin: f64,
    most_looks: u32,
) -> bool {
    let ends = [Pose::of(&scene.arm, from), Pose::of(&scene.arm, to)];
    let bounds = motion_bounds(&scene.arm, from, to);
    scene.obstacles.iter().all(|obstacle| {
        (0..2).all(|link| {
            let kept = CERTIFIED_CLEARANCE + margin;
            let mut sweep = LinkSweep { arm: &scene.arm, obstacle, link, kept, looks_left: most_looks };
            sweep.is_free(&ends[0], &ends[1], bounds[link])
        })
    })
}

/// Clearance of each link at `q` from the nearest obstacle (m), base first.
pub fn link_clearances(scene: &Scene, q: &Configuration<2>) -> [f64; 2] {
    Pose::of(&scene.arm, q).links.map(|link| {
        let distances = scene.obstacles.iter().map(|obstacle| obstacle.distance_to_segment(link));
        distances.fold(f64::INFINITY, f64::min) - scene.arm.half_width()
    })
}

/// [`link_clearances`] less [`CERTIFIED_CLEARANCE`] (m).
///
/// With the sum of two of these above [`motion_bounds`], both links are clear all along the straight turn.
pub fn certified_clearance(scene: &Scene, q: &Configuration<2>) -> [f64; 2] {
    link_clearances(scene, q).map(|clearance| clearance - CERTIFIED_CLEARANCE)
}

/// A configuration with the links it makes.
struct Pose {
    q: Configuration<2>,
    links: [Segment; 2],
}

impl Pose {
    fn of(arm: &TwoLinkArm, q: &Configuration<2>) -> Self {
        let elbow = arm.elbow(q);
        let tip = elbow + Vector::polar(arm.lengths()[1], q.0[0] + q.0[1]);
        Self { q: *q, links: [Segment::new(arm.base(), elbow), Segment::new(elbow, tip)] }
    }
}

/// How far a point of each link can move (m) while the joints turn evenly from `from` to `to`.
pub fn motion_bounds(arm: &TwoLinkArm, from: &Configuration<2>, to: &Configuration<2>) -> [f64; 2] {
    let [l1, l2] = arm.lengths();
    let (turn1, turn2) = (to.0[0] - from.0[0], to.0[1] - from.0[1]);
    let first = l1 * turn1.abs();
    [first, first + l2 * (turn1 + turn2).abs()]
}

/// One link against one obstacle.
struct LinkSweep<'a> {
    arm: &'a TwoLinkArm,
    obstacle: &'a Obstacle,
    link: usize,
    /// Clearance that has to be left (m).
    kept: f64,
    looks_left: u32,
}

impl LinkSweep<'_> {
    fn is_free(&mut self, from: &Pose, to: &Pose, bound: f64) -> bool {
        let (c0, c1) = (self.clearance(from), self.clearance(to));
        c0 > 0.0 && c1 > 0.0 && self.between_is_free((from, c0), (to, c1), bound)
    }

    /// Clearance beyond what is to be kept (m).
    fn clearance(&self, pose: &Pose) -> f64 {
        self.obstacle.distance_to_segment(pose.links[self.link]) - self.arm.half_width() - self.kept
    }

    /// `bound` is how far a point of the link moves between the two poses; halves on every level, so the
    /// recursion ends when it falls below the clearances or one of them is gone.
    fn between_is_free(&mut self, from: (&Pose, f64), to: (&Pose, f64), bound: f64) -> bool {
        if from.1 + to.1 > bound {
            return true;
        }
        if bound <= CERTIFIED_CLEARANCE || self.looks_left == 0 {
            return false;
        }
        self.looks_left -= 1;
        let middle = Pose::of(self.arm, &from.0.q.lerp(&to.0.q, 0.5));
        let clearance = self.clearance(&middle);
        clearance > 0.0
            && self.between_is_free(from, (&middle, clearance), bound / 2.0)
            && self.between_is_free((&middle, clearance), to, bound / 2.0)
    }
}
