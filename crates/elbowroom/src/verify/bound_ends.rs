//! What start and goal alone tell of every motion between them, whatever is in the way.

use super::bound::SUM_ROUNDING;
use crate::arm::Arm;
use crate::trajectory::{SpeedLimits, Stop, least_time};

/// A lower bound of the duration (s) of every motion from rest at `start` to rest at `goal`, each joint no farther than `away` (rad) from
/// there, under `limits`, one per joint: each has to go there by itself, the shorter way round where it is continuous, as no other
/// way is shorter.
pub(crate) fn least_time_between(
    arm: &Arm,
    limits: &[SpeedLimits],
    start: &[f64],
    goal: &[f64],
    away: f64,
) -> f64 {
    let joints = arm.joints().iter().zip(limits).zip(start.iter().zip(goal));
    let times = joints.map(|((joint, limits), (start, goal))| {
        let way = joint.limits.difference(*start, *goal).abs();
        least_time(way - 2.0 * away, limits, [Stop::Rest; 2])
    });
    times.fold(0.0, f64::max) * (1.0 - SUM_ROUNDING)
}
