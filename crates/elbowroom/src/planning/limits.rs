use std::f64::consts::PI;

use crate::arm::{Arm, Joint};
use crate::trajectory::SpeedLimits;

/// What a joint is taken to be capable of where its scene does not say: a slow industrial arm.
pub const ASSUMED_LIMITS: SpeedLimits = SpeedLimits { velocity: PI / 2.0, acceleration: PI, jerk: 4.0 * PI };

/// A motion limit that the scene does not state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AssumedLimit {
    /// 1 for the joint at the base.
    pub joint: usize,
    /// `velocity`, `acceleration` or `jerk`.
    pub rate: &'static str,
    /// What was taken in its place (rad/s, rad/s², rad/s³).
    pub value: f64,
}

/// The motion limits of the joints, with [`ASSUMED_LIMITS`] where none is stated, and a list of those.
pub(crate) fn motion_limits(arm: &Arm) -> (Vec<SpeedLimits>, Vec<AssumedLimit>) {
    let mut assumed = Vec::new();
    let limit = |(j, joint): (usize, &Joint)| {
        let stated = joint.motion;
        let mut take = |rate: &'static str, stated: Option<f64>, value: f64| {
            stated.unwrap_or_else(|| {
                assumed.push(AssumedLimit { joint: j + 1, rate, value });
                value
            })
        };
        SpeedLimits {
            velocity: take("velocity", stated.velocity, ASSUMED_LIMITS.velocity),
            acceleration: take("acceleration", stated.acceleration, ASSUMED_LIMITS.acceleration),
            jerk: take("jerk", stated.jerk, ASSUMED_LIMITS.jerk),
        }
    };
    let limits = arm.joints().iter().enumerate().map(limit).collect();
    (limits, assumed)
}

/// The limits that the scene states; a rate without one may be as great as it likes.
pub(super) fn stated_limits(arm: &Arm) -> Vec<SpeedLimits> {
    let limit = |joint: &Joint| SpeedLimits {
        velocity: joint.motion.velocity.unwrap_or(f64::INFINITY),
        acceleration: joint.motion.acceleration.unwrap_or(f64::INFINITY),
        jerk: joint.motion.jerk.unwrap_or(f64::INFINITY),
    };
    arm.joints().iter().map(limit).collect()
}
