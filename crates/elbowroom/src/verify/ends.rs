//! Whether the arm is at rest where the motion begins and ends.

use super::End;
use super::rate::Quantity;
use super::verdict::Violation;
use crate::arm::Joint;
use crate::trajectory::Motion;

/// How fast a joint may still be where it is to be at rest (rad/s, rad/s²): room for the rounding of files.
pub const REST_ROUNDING: f64 = 1e-6;

/// Reports the joints that are not at rest at an end where they are to be.
pub(super) fn check(motion: &Motion, joints: &[Joint], ends: [End; 2], violations: &mut Vec<Violation>) {
    for (end, (asked, time)) in ends.into_iter().zip([motion.start(), motion.end()]).enumerate() {
        let End::AtRest(continuous) = asked else { continue };
        let state = motion.at(time);
        for (j, joint) in joints.iter().enumerate() {
            let rates = [
                (Quantity::Velocity, state.velocity[j], joint.motion.acceleration),
                (Quantity::Acceleration, state.acceleration[j], joint.motion.jerk),
            ];
            for (what, value, next_limit) in rates {
                let counts = what <= continuous || next_limit.is_some();
                // Not a number is not at rest.
                let rests = value.abs() <= REST_ROUNDING;
                if counts && !rests {
                    let (joint, at_end) = (j + 1, end == 1);
                    violations.push(Violation::NotAtRest { joint, at_end, what, value, time });
                }
            }
        }
    }
}
