//! Whether a motion is safe: a proof or a reason why not.
//!
//! The verifier looks at the polynomials themselves, never at samples of them. Its geometry is its own, so
//! that a mistake in what the planners use cannot pass here. Between the pieces' ends every statement holds
//! for the exact polynomials: bounds carry an allowance for the rounding of their arithmetic, and what cannot
//! be told apart in it is refused.

mod bernstein;
mod blocked;
mod bound;
mod bound_ends;
mod bound_time;
mod bound_tips;
mod check;
mod clearance;
mod continuity;
mod doubt;
mod ends;
mod foreign;
mod least_rate;
mod limits;
mod moving;
mod pairs;
mod peak;
mod posture_changes;
mod progress;
mod rate;
mod rows;
mod settings;
mod sweep;
mod trajectory;
mod verdict;

pub(crate) use bound::images;
pub use bound::{BoundError, OpenJoints, Reachability, bound_over_joints};
pub(crate) use bound_ends::least_time_between;
pub use bound_time::bound_over_time;
pub(crate) use bound_tips::innermost_reach;
pub use bound_tips::{OpenTips, bound_over_tips};
pub(crate) use check::clear_until;
pub use check::{verify, verify_rows, verify_until};
pub use continuity::JUMP_ROUNDING;
pub use doubt::{Allowance, Allowed, Unjudged, Unknown};
pub use ends::REST_ROUNDING;
pub use foreign::{SMALL, STOP_DIGITS};
pub use posture_changes::MOST_POSTURE_CHANGES;
pub use rate::{Quantity, Rate};
pub use rows::{Rows, SAMPLED};
pub use settings::{End, FLOOR, VerifySettings};
pub use trajectory::Trajectory;
pub use verdict::{Against, Clearance, JointMargin, MotionMargin, MotionMargins, Verdict, Violation};
