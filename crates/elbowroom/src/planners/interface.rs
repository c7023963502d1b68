//! The one way into all planners.

use super::settings::{Pace, PlanSettings, Planner};
use super::{Monitor, Plan, PlanError, dstar_pso, ik_pso, posture_true, swarms};
use crate::arm::Arm;
use crate::scene::{Scene, Task};

/// Plans `task`: whatever the planner, what comes out is a motion that the verifier has proved to be safe.
///
/// # Errors
/// [`PlanError`]; a missing path is [`PlanError::NoPath`] where that is proved.
pub fn plan<A: Arm>(
    scene: &Scene<A>,
    task: &Task,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    check(settings)?;
    match &settings.planner {
        Planner::DstarPso(swarm) if scene.arm.lengths().len() > 2 => {
            dstar_pso::plan(&scene.planar(), task, swarm, settings, monitor)
        }
        Planner::IkPso(ik) => ik_pso::plan(&scene.planar(), task, ik, settings, monitor),
        Planner::Dstar | Planner::DstarPso(_) | Planner::Optimal => {
            let planner = settings.planner.name();
            let links = scene.arm.lengths().len();
            let scene = scene.two_link().ok_or(PlanError::OtherArm { planner, links })?;
            posture_true::plan(&scene, task, settings, monitor)
        }
        Planner::Pso(_) | Planner::Cbpso(_) | Planner::NscPso(_) => {
            swarms::plan(&scene.planar(), task, settings, monitor)
        }
    }
}

fn check(settings: &PlanSettings) -> Result<(), PlanError> {
    if let Planner::DstarPso(swarm) = &settings.planner {
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
