//! From a task to a plan.

mod bound;
mod by_name;
mod candidates;
mod chain;
mod changing_graph;
mod chart;
mod choose;
mod contacts;
mod dstar_pso;
mod endpoints;
mod finish;
mod ik_pso;
mod interface;
mod limits;
mod monitor;
mod nearest;
mod optimal;
mod pairs;
mod paper;
mod plan;
mod planner;
mod posture_graph;
mod posture_true;
mod pull;
mod settings;
mod sheets;
mod smooth;
mod swarms;
mod union_graph;

pub use by_name::{NameError, OptionValue};
pub(crate) use changing_graph::{ChangingGraph, Goal};
pub(crate) use endpoints::Endpoints;
pub(crate) use sheets::Kept;

pub use candidates::NEARLY_EQUAL;
pub use chain::{InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm};
pub use ik_pso::IkPsoSettings;
pub use interface::plan;
pub(crate) use limits::motion_limits;
pub use limits::{ASSUMED_LIMITS, AssumedLimit};
pub use monitor::{Monitor, Stage, Unwatched};
pub use paper::{Method, PaperError, PaperPlan, PaperSettings, plan_as_in_paper};
pub use plan::{Effort, NoPath, Plan, PlanError, gap};
pub use planner::Planner;
pub use settings::{Objective, Pace, PlanSettings};
pub use swarms::{CbpsoSettings, Initialisation, NscPsoSettings, PsoSettings};
