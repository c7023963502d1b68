//! Geometry without time: where the tip goes, and where the joints go.

mod asked;
mod chain_move;
mod clearance;
mod follow;
mod homotopy;
mod joint_path;
mod pairs;
mod penetration;
mod simplify;
mod straight_move;
mod tip_path;
mod two_link_move;

pub use clearance::{CERTIFIED_CLEARANCE, link_clearances, motion_bounds, self_clearance};
pub use follow::{FollowError, Followed, Jump, JumpKind, follow};
pub(crate) use homotopy::can_be_deformed;
pub use joint_path::JointPath;
pub(crate) use pairs::{joint_path, pairs};
pub(crate) use penetration::Penetration;
pub use simplify::simplify;
pub(crate) use straight_move::straight_move_clears;
pub use straight_move::{straight_move_is_free, straight_move_keeps};
pub use tip_path::TipPath;
pub(crate) use two_link_move::motion_bounds_of_two;
