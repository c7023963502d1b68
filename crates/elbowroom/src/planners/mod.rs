//! From a task to a plan.

mod bound;
mod candidates;
mod changing_graph;
mod chart;
mod choose;
mod limits;
mod monitor;
mod nearest;
mod optimal;
mod paper;
mod plan;
mod posture_graph;
mod posture_true;
mod problem;
mod pull;
mod settings;
mod sheets;
mod smooth;
mod union_graph;

pub(crate) use changing_graph::{ChangingGraph, Goal};
pub(crate) use problem::Problem;
pub(crate) use sheets::Kept;

pub use candidates::NEARLY_EQUAL;
pub use limits::{ASSUMED_LIMITS, AssumedLimit};
pub use monitor::{Monitor, Stage, Unwatched};
pub use paper::{Method, PaperError, PaperPlan, PaperSettings, plan_as_in_paper};
pub use plan::{NoPath, Plan, PlanError};
pub use posture_true::plan;
pub use settings::{Objective, Pace, PlanSettings, Planner};
