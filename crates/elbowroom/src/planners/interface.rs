//! The one way into all planners.

use super::plan::check_bound;
use super::planner::Planner;
use super::posture_true::Paths;
use super::settings::{Pace, PlanSettings};
use super::{Monitor, Plan, PlanError, dstar_pso, ik_pso, posture_true, swarms};
use crate::scene::{Scene, Task, TwoLinkError};

/// Plans `task`: whatever the planner, what comes out is a motion that the verifier has proved to be safe.
///
/// # Errors
/// [`PlanError`]; a missing path is [`PlanError::NoPath`] where that is proved.
pub fn plan(
    scene: &Scene,
    task: &Task,
    planner: &Planner,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    if let Some(obstacle) = scene.first_moving() {
        return Err(PlanError::Moving { obstacle, name: scene.obstacles()[obstacle].name.clone() });
    }
    check(planner, settings)?;
    let plan = by(planner, scene, task, settings, monitor)?;
    if let Some(bound) = plan.lower_bound {
        check_bound(plan.cost, bound)?;
    }
    Ok(plan)
}

fn by(
    planner: &Planner,
    scene: &Scene,
    task: &Task,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    let over = |paths: Paths<'_>| {
        let scene = scene.two_link().map_err(|error| match error {
            TwoLinkError::Links { found } => PlanError::OtherArm { planner: planner.name(), links: found },
            TwoLinkError::Moving { obstacle, name } => PlanError::Moving { obstacle, name },
        })?;
        posture_true::plan(scene, task, paths, settings, monitor)
    };
    match planner {
        Planner::DstarPso(own) if scene.arm().links() > 2 => {
            dstar_pso::plan(scene, task, own, settings, monitor)
        }
        Planner::DstarPso(own) => over(Paths::OfGrid(Some(own))),
        Planner::Dstar => over(Paths::OfGrid(None)),
        Planner::Optimal => over(Paths::OffGrid),
        Planner::IkPso(own) => ik_pso::plan(scene, task, own, settings, monitor),
        Planner::Pso(own) => swarms::plan(scene, task, settings, monitor, |ends| {
            swarms::pso(scene, ends, own, settings, monitor)
        }),
        Planner::Cbpso(own) => swarms::plan(scene, task, settings, monitor, |ends| {
            swarms::cbpso(scene, ends, own, settings, monitor)
        }),
        Planner::NscPso(own) => swarms::plan(scene, task, settings, monitor, |ends| {
            swarms::nsc_pso(scene, ends, own, settings, monitor)
        }),
    }
}

fn check(planner: &Planner, settings: &PlanSettings) -> Result<(), PlanError> {
    if let Planner::DstarPso(swarm) = planner {
        swarm.check()?;
    }
    if let Some(gap) = settings.gap.filter(|gap| gap.is_nan() || *gap < 0.0) {
        return Err(PlanError::Gap { gap });
    }
    match settings.pace {
        Pace::Duration(duration) if !(duration.is_finite() && duration > 0.0) => {
            Err(PlanError::Duration { duration })
        }
        _ => Ok(()),
    }
}
