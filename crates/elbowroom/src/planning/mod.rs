//! From a task to a plan, whatever the planner: what a planner is given, what it hands back, and the one way from there to a
//! motion that is proved to be safe.
//!
//! [`plan`] checks what is asked, finds the configurations that a task begins and ends in, proves a lower bound, lets the
//! [`Planner`] search, smooths the paths it found, has the verifier judge the motions, and checks that they do the task.

mod accept;
mod bound;
mod budget;
mod candidate;
mod duration;
mod effort;
mod endpoints;
mod error;
mod limits;
mod made;
mod mismatch;
mod monitor;
mod no_path;
mod objective;
mod options;
mod plan;
mod planner;
mod problem;
mod settings;
mod shaping;
mod smoothing;
mod solve;

pub(crate) use bound::least_cost;
pub use budget::{Budget, Exhausted};
pub(crate) use candidate::PathToFollow;
pub use candidate::{Candidate, Found, Pick};
pub(crate) use duration::is_duration;
pub use duration::{LONGEST_DURATION, SHORTEST_DURATION};
pub use effort::Effort;
pub use endpoints::Endpoints;
pub use error::PlanError;
pub(crate) use error::{FINER, static_only};
pub(crate) use limits::motion_limits;
pub use limits::{ASSUMED_LIMITS, AssumedLimit};
pub use mismatch::{END_ROUNDING, Mismatch, mismatch};
pub use monitor::{Monitor, Stage, Unwatched};
pub use no_path::NoPath;
pub use objective::Objective;
pub use options::OptionValue;
pub use plan::{Plan, PlanRecord, RecordError, gap};
pub use planner::{Planner, Round};
pub use problem::Problem;
pub use settings::{Pace, PlanSettings, SLACK};
pub use solve::plan;
