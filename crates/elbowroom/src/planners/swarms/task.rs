//! What all swarms do before they search.

use super::super::bound::coarse_least_cost;
use super::super::endpoints::Endpoints;
use super::super::finish::along;
use super::super::settings::PlanSettings;
use super::super::{Effort, Monitor, Plan, PlanError};
use crate::path::JointPath;
use crate::scene::{Scene, Task};

/// Plans `task` by the swarm that `search` is, between the endpoints that it is given.
///
/// # Errors
/// [`PlanError::NotFoundInBudget`] where no candidate was certified; others as the interface says.
pub(in crate::planners) fn plan(
    scene: &Scene,
    task: &Task,
    settings: &PlanSettings,
    monitor: &impl Monitor,
    search: impl FnOnce(&Endpoints) -> Result<Plan, PlanError>,
) -> Result<Plan, PlanError> {
    let ends = Endpoints::new(scene, task, settings.seed, monitor)?;
    let lower_bound = coarse_least_cost(scene, &ends, settings, monitor)?;
    let plan = match ends.already_there() {
        Some(q) => along(scene, JointPath(vec![q.clone()]), settings, Effort::default(), monitor)?,
        None => search(&ends)?,
    };
    Ok(Plan { lower_bound, ..plan })
}
