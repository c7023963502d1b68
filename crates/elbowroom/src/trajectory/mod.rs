//! Motion over time: polynomial pieces per joint.

mod motion;
mod piece;

pub use motion::{Motion, MotionError};
pub use piece::{Piece, State};
