//! The two-link arm: its parts, limits, forward and inverse kinematics.

mod configuration;
mod inverse;
mod joint;
mod posture;
mod two_link;

pub use configuration::Configuration;
pub use inverse::InverseError;
pub use joint::{Joint, JointLimits, JointLimitsError, MotionLimits};
pub use posture::Posture;
pub use two_link::{ArmError, TwoLinkArm};
