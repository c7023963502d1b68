//! Planar arms: their parts, limits, forward kinematics; for two links also inverse kinematics in closed form.

mod chain;
mod configuration;
mod error;
mod inverse;
mod inverse_near;
mod joint;
mod measures;
mod posture;
mod two_link;

pub use chain::Arm;
pub use configuration::{Configuration, joint_distance, lerp};
pub use error::ArmError;
pub use inverse::InverseError;
pub use joint::{Joint, JointLimits, JointLimitsError, MotionLimitError, MotionLimits};
pub(crate) use measures::LENGTHS;
pub use measures::MOST_LINKS;
pub use posture::Posture;
pub use two_link::TwoLink;
pub(crate) use two_link::lerp_pair;
