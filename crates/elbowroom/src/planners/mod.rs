//! From a task to a plan.

mod bound;
mod by_name;
mod candidates;
mod chain;
mod chart;
mod choose;
mod dstar_pso;
mod ends;
mod finish;
mod ik_pso;
mod interface;
mod limits;
mod monitor;
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

pub use by_name::{NameError, OptionValue};
pub use candidates::NEARLY_EQUAL;
pub use chain::{InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm};
pub use ik_pso::IkPsoSettings;
pub use interface::plan;
pub use limits::{ASSUMED_LIMITS, AssumedLimit};
pub use monitor::{Monitor, Stage, Unwatched};
pub use paper::{Method, PaperError, PaperPlan, PaperSettings, plan_as_in_paper};
pub use plan::{Effort, NoPath, Plan, PlanError};
pub use settings::{Objective, Pace, PlanSettings, Planner};
