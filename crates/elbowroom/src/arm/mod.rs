//! Planar arms: their parts, limits, forward kinematics; for two links also inverse kinematics in closed form.

mod chain;
mod configuration;
mod inverse;
mod inverse_near;
mod joint;
mod planar;
mod posture;
mod two_link;

pub use chain::Arm;
pub use configuration::{Configuration, joint_distance};
pub use inverse::InverseError;
pub use joint::{Joint, JointLimits, JointLimitsError, MotionLimits};
pub use planar::{MOST_LINKS, PlanarArm};
pub use posture::Posture;
pub use two_link::{ArmError, TwoLinkArm};
