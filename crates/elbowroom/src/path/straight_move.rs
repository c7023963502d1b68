//! Whether the arm may turn straight from one configuration to another: certified, not sampled.

use super::asked::Asked;
use super::{chain_move, two_link_move};
use crate::arm::Arm;
use crate::scene::{Obstacle, Scene};

/// Whether all links stay clear of all that they must not touch while each joint turns evenly from `from` to `to` (rad).
///
/// By bisection with a bound on the motion: over a stretch whose points move by no more than `b`, links that are clear
/// by `c0` at one end and `c1` at the other are clear all the way if `c0 + c1 > b`. `false` also when a clearance comes
/// down to [`CERTIFIED_CLEARANCE`](super::CERTIFIED_CLEARANCE), or cannot be told from it in bounded work, and where an
/// obstacle of the scene moves. Joint limits are not examined: between two configurations within them there is no other.
///
/// # Panics
/// Unless both have a position for each joint.
///
/// # Reference
/// Schwarzer, Saha and Latombe, *Adaptive dynamic collision checking*, IEEE T-RO 21(3), 2005.
pub fn straight_move_is_free(scene: &Scene, from: &[f64], to: &[f64]) -> bool {
    is_clear(scene.arm(), scene.obstacles(), [from, to], Asked::CERTIFIED)
}

/// [`straight_move_is_free`] with `margin` (m) more clearance, and given up sooner: for moves that would be nice to have.
///
/// # Panics
/// Unless both have a position for each joint.
pub fn straight_move_keeps(scene: &Scene, from: &[f64], to: &[f64], margin: f64) -> bool {
    is_clear(scene.arm(), scene.obstacles(), [from, to], Asked::with_margin(margin))
}

/// [`straight_move_is_free`] as far as one obstacle alone is concerned.
pub(crate) fn straight_move_clears(arm: &Arm, obstacle: &Obstacle, from: &[f64], to: &[f64]) -> bool {
    is_clear(arm, std::slice::from_ref(obstacle), [from, to], Asked::OF_OBSTACLES)
}

/// Two links have a way of their own to the same answers, which is quicker: no list of what is undecided is kept.
fn is_clear(arm: &Arm, obstacles: &[Obstacle], ends: [&[f64]; 2], asked: Asked) -> bool {
    if let (&[first, second], [Ok(from), Ok(to)]) = (arm.lengths(), ends.map(<&[f64; 2]>::try_from)) {
        return two_link_move::is_clear(arm, [first, second], obstacles, [from, to], asked);
    }
    chain_move::is_clear(arm, obstacles, ends, asked)
}
