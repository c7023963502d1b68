//! From a task to a plan.

mod monitor;
mod paper;
mod union_graph;

pub use monitor::{Monitor, Stage, Unwatched};
pub use paper::{Method, PaperError, PaperPlan, PaperSettings, plan_as_in_paper};
