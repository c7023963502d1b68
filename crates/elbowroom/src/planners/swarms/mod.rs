//! Planners that let a particle swarm choose a whole path, or a whole motion, at once.

mod cbpso;
mod choice;
mod hunt;
mod nsc_pso;
mod polyline;
mod pso;
mod track;

pub use cbpso::CbpsoSettings;
pub use nsc_pso::{Initialisation, NscPsoSettings};
pub use pso::PsoSettings;

use super::bound::coarse_least_cost;
use super::ends::Ends;
use super::finish::along;
use super::settings::{PlanSettings, Planner};
use super::{Effort, Monitor, Plan, PlanError};
use crate::arm::{Arm, PlanarArm};
use crate::path::JointPath;
use crate::scene::{Scene, Task};

/// Plans `task` by the swarm that the settings name.
///
/// # Errors
/// [`PlanError::NotFoundInBudget`] where no candidate was certified; others as the interface says.
pub(super) fn plan(
    scene: &Scene<PlanarArm>,
    task: &Task,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    let ends = Ends::new(scene, task, settings.seed, monitor)?;
    let lower_bound = coarse_least_cost(scene, task, settings, monitor)?;
    let plan = match &settings.planner {
        _ if ends.starts.iter().any(|start| ends.goals.contains(start)) => {
            let stay = ends.starts.into_iter().find(|start| ends.goals.contains(start));
            along(scene, JointPath(stay.into_iter().collect()), settings, Effort::default(), monitor)?
        }
        Planner::Cbpso(own) => cbpso::plan(scene, task, settings, own, &ends, monitor)?,
        Planner::NscPso(own) => nsc_pso::plan(scene, task, settings, own, &ends, monitor)?,
        Planner::Pso(own) => pso::plan(scene, task, settings, own, &ends, monitor)?,
        // The interface sends no others here.
        other => {
            let links = scene.arm.lengths().len();
            return Err(PlanError::OtherArm { planner: other.name(), links });
        }
    };
    Ok(Plan { lower_bound, ..plan })
}
