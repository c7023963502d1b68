//! Whether a motion does its task, safe as it may be.

use thiserror::Error;

use crate::arm::{Arm, JointLimits, Posture};
use crate::geometry::wrap_angle;
use crate::scene::{Place, Scene, Task, TaskPosture};
use crate::trajectory::Motion;
use crate::units::{Told, Units, apart, measured};

/// How far from its place, or from rest, a motion may begin or end (m, rad, rad/s): room for rounding in files and conversions.
pub const END_ROUNDING: f64 = 1e-6;

/// How a motion fails to do its task.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Mismatch {
    /// It is of another arm.
    #[error("the motion has {found} joints, the arm {joints}")]
    Joints {
        /// Of the motion.
        found: usize,
        /// Of the arm.
        joints: usize,
    },
    /// It begins or ends elsewhere.
    #[error("{}", self.told(Units::SI))]
    Elsewhere {
        /// `start` or `goal`.
        end: &'static str,
        /// How far.
        distance: f64,
        /// `m` for a tip, `rad` for a configuration.
        unit: &'static str,
    },
    /// It begins or ends while joints move.
    #[error("{}", self.told(Units::SI))]
    Turning {
        /// `start` or `goal`.
        end: &'static str,
        /// The greatest of a joint (rad/s).
        velocity: f64,
    },
    /// It begins or ends while joints accelerate whose jerk is limited.
    #[error("{}", self.told(Units::SI))]
    Accelerating {
        /// `start` or `goal`.
        end: &'static str,
        /// The greatest of a joint (rad/s²).
        acceleration: f64,
    },
    /// It takes another time than was asked for.
    #[error("the motion takes {} s, {} s were asked for", apart(*takes, *asked)[0], apart(*takes, *asked)[1])]
    Duration {
        /// What it takes (s).
        takes: f64,
        /// What was asked (s).
        asked: f64,
    },
    /// It ends in the other posture.
    #[error("the motion ends {}, the task asks for {}", found.name(), wanted.name())]
    GoalPosture {
        /// Of its end.
        found: Posture,
        /// Of the task.
        wanted: Posture,
    },
    /// It does not keep its posture.
    #[error("the posture changes at {time:.3} s, the task asks to keep it")]
    PostureChanged {
        /// When it first does (s).
        time: f64,
    },
}

impl Told for Mismatch {
    fn told(&self, units: Units) -> String {
        match *self {
            Self::Elsewhere { end, distance, unit } => {
                let distance = if unit == "m" { units.length(distance) } else { units.angle(distance) };
                format!("the motion is {distance} from the {end}")
            }
            Self::Turning { end, velocity } => {
                let velocity = measured(units.of_radians(velocity));
                format!(
                    "the motion is not at rest at the {end}: a joint moves at {velocity} {}",
                    units.rate_name(1)
                )
            }
            Self::Accelerating { end, acceleration } => {
                let acceleration = measured(units.of_radians(acceleration));
                format!(
                    "the motion is not at rest at the {end}: a joint accelerates by {acceleration} {} there",
                    units.rate_name(2)
                )
            }
            _ => self.to_string(),
        }
    }
}

/// How `motion`, whose posture changes at `posture_changes` (s), fails to do `task` of `scene`; `None` if it does it.
pub fn mismatch(scene: &Scene, task: &Task, motion: &Motion, posture_changes: &[f64]) -> Option<Mismatch> {
    let arm = scene.arm();
    if motion.joints() != arm.links() {
        return Some(Mismatch::Joints { found: motion.joints(), joints: arm.links() });
    }
    let ends =
        [("start", &task.start, motion.at(motion.start())), ("goal", &task.goal, motion.at(motion.end()))];
    for (end, place, state) in &ends {
        let (distance, unit) = away(arm, place, &state.position);
        if distance.is_nan() || distance > END_ROUNDING {
            return Some(Mismatch::Elsewhere { end, distance, unit });
        }
        let velocity = state.velocity.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        if velocity > END_ROUNDING {
            return Some(Mismatch::Turning { end, velocity });
        }
        let limited =
            arm.joints().iter().zip(&state.acceleration).filter(|(joint, _)| joint.motion.jerk.is_some());
        let acceleration = limited.fold(0.0, |most: f64, (_, rate)| most.max(rate.abs()));
        if acceleration > END_ROUNDING {
            return Some(Mismatch::Accelerating { end, acceleration });
        }
    }
    let wanted = match task.posture {
        TaskPosture::Any => return None,
        TaskPosture::Keep => {
            return posture_changes.first().map(|&time| Mismatch::PostureChanged { time });
        }
        TaskPosture::Up => Posture::ElbowUp,
        TaskPosture::Down => Posture::ElbowDown,
    };
    // With the links in line, nearly, it is either.
    let q = &ends[1].2.position;
    let bend = q.get(1).copied().map_or(0.0, wrap_angle);
    let in_line = bend.abs() <= END_ROUNDING || std::f64::consts::PI - bend.abs() <= END_ROUNDING;
    let found = Posture::at(q).filter(|found| *found != wanted && !in_line)?;
    Some(Mismatch::GoalPosture { found, wanted })
}

/// How far the arm at `q` is from `place`, and in what unit; whole revolutions of continuous joints aside.
fn away(arm: &Arm, place: &Place, q: &[f64]) -> (f64, &'static str) {
    match place {
        Place::Tip(tip) => (arm.tip(q).distance(*tip), "m"),
        Place::Configuration(asked) => {
            let joints = arm.joints().iter().zip(q.iter().zip(asked.iter()));
            let turned = joints.map(|(joint, (at, asked))| match joint.limits {
                JointLimits::Continuous => wrap_angle(at - asked).abs(),
                JointLimits::Range { .. } => (at - asked).abs(),
            });
            (turned.fold(0.0, f64::max), "rad")
        }
    }
}
