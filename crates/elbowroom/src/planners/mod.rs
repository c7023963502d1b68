//! Every planner in a file of its own, the list of them ([`all`]), and what several of them share: paths over and off the grid
//! (`over_grid`, `off_grid`), what is led by the tip's way (`tip_guided`), swarms over whole candidates (`swarms`).

mod by_name;
mod cbpso;
mod dstar;
mod dstar_pso;
mod guided_rrt_connect;
mod ik_pso;
mod nsc_pso;
mod off_grid;
mod optimal;
mod over_grid;
mod paper;
mod pso;
mod shortcut;
mod shortlist;
mod swarms;
mod tip_guided;

pub use by_name::NameError;
pub use cbpso::CbpsoPlanner;
pub use dstar::DstarPlanner;
pub use dstar_pso::DstarPsoPlanner;
pub use guided_rrt_connect::GuidedRrtConnectPlanner;
pub use ik_pso::IkPsoPlanner;
pub use nsc_pso::{Initialisation, NscPsoPlanner};
pub use optimal::OptimalPlanner;
pub use paper::{Method, PaperError, PaperPlan, PaperSettings, plan_as_in_paper};
pub use pso::PsoPlanner;
pub use tip_guided::{InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm};

use crate::arm::Arm;
use crate::planning::{OptionValue, Planner};

/// Every planner with its default options, the paper's first.
pub fn all() -> Vec<Box<dyn Planner>> {
    vec![
        Box::new(DstarPsoPlanner::default()),
        Box::new(DstarPlanner),
        Box::new(OptimalPlanner),
        Box::new(GuidedRrtConnectPlanner::default()),
        Box::new(PsoPlanner::default()),
        Box::new(CbpsoPlanner::default()),
        Box::new(NscPsoPlanner::default()),
        Box::new(IkPsoPlanner::default()),
    ]
}

/// The planner to take for `arm` where none is named: the first of [`all`] that serves it.
pub fn default_for(arm: &Arm) -> Box<dyn Planner> {
    let mut all = all().into_iter();
    all.find(|planner| planner.links().contains(&arm.links()))
        .unwrap_or_else(|| Box::new(GuidedRrtConnectPlanner::default()))
}

/// The planner called `name`, with these options in place of its defaults.
///
/// # Errors
/// [`NameError`] for a name or option that is not known, which lists those that are, or a value that makes no sense.
pub fn by_name(name: &str, options: &[(String, OptionValue)]) -> Result<Box<dyn Planner>, NameError> {
    by_name::named(all(), name, options)
}
