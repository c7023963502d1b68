//! Geometry without time: where the tip goes, and where the joints go.

mod follow;
mod joint_path;
mod simplify;
mod sweep;
mod tip_path;
mod turn;

pub use follow::{FollowError, Followed, Jump, JumpKind, follow};
pub use joint_path::JointPath;
pub use simplify::simplify;
pub use sweep::{
    CERTIFIED_CLEARANCE, certified_clearance, link_clearances, motion_bounds, sweep_is_free, sweep_keeps,
};
pub use tip_path::TipPath;
pub use turn::{clearances, self_clearance, turn_is_free};
