//! From what a planner found, a path or a motion, to a plan.

use super::limits::{motion_limits, stated_limits};
use super::plan::Effort;
use super::settings::{Objective, PlanSettings};
use super::smooth::{SmoothError, Style, smooth};
use super::{Monitor, Plan, PlanError, Stage};
use crate::arm::Arm;
use crate::path::JointPath;
use crate::scene::Scene;
use crate::trajectory::Motion;
use crate::verify::{Trajectory, VerifySettings};

/// How far a motion may stray from a path before the verifier is asked, in grid steps.
const TOLERANCE: f64 = 0.1;

/// The plan along `path`, whose straight turns are certified free.
///
/// # Errors
/// [`PlanError::Refused`], [`PlanError::TooFast`], [`PlanError::Stopped`]
pub(crate) fn along(
    scene: &Scene,
    path: JointPath,
    settings: &PlanSettings,
    effort: Effort,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    monitor.stage(Stage::Trajectory);
    let (limits, assumed_limits) = motion_limits(scene.arm());
    let stated = stated_limits(scene.arm());
    let style = Style::Flowing { tolerance: TOLERANCE };
    let smoothed = smooth(scene, &path.0, &limits, &stated, settings.pace, style, monitor)
        .map_err(|error| SmoothError::in_terms_of(error, settings.pace))?;
    Ok(Plan {
        cost: cost(scene.arm(), settings.objective, smoothed.trajectory.motion()),
        lower_bound: None,
        path_cost: path.tip_travel(scene.arm()),
        paths_to_choose_from: 1,
        tip_path: path.tips(scene.arm()),
        joint_path: path,
        vias: smoothed.vias,
        stops: smoothed.stops,
        trajectory: smoothed.trajectory,
        assumed_limits,
        effort: Some(effort),
    })
}

/// The plan whose motion is `motion` itself: `path` follows it, and at its places `vias` two pieces meet, ends included.
///
/// # Errors
/// [`PlanError::Refused`] when the verifier does not accept it, [`PlanError::Stopped`]
pub(crate) fn with_motion(
    scene: &Scene,
    motion: Motion,
    path: JointPath,
    vias: Vec<usize>,
    settings: &PlanSettings,
    effort: Effort,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    monitor.stage(Stage::Trajectory);
    let (_, assumed_limits) = motion_limits(scene.arm());
    let keep_going = || monitor.keep_going();
    let trajectory = Trajectory::certify_until(scene, motion, &VerifySettings::default(), &keep_going)
        .map_err(|verdict| if keep_going() { PlanError::Refused(verdict) } else { PlanError::Stopped })?;
    Ok(Plan {
        cost: cost(scene.arm(), settings.objective, trajectory.motion()),
        lower_bound: None,
        path_cost: trajectory.motion().tip_length(scene.arm()),
        paths_to_choose_from: 1,
        tip_path: path.tips(scene.arm()),
        vias,
        joint_path: path,
        stops: 0,
        trajectory,
        assumed_limits,
        effort: Some(effort),
    })
}

/// What `motion` costs in terms of `objective`.
pub(crate) fn cost(arm: &Arm, objective: Objective, motion: &Motion) -> f64 {
    match objective {
        Objective::Tip => motion.tip_length(arm),
        Objective::Joint => motion.joint_length(),
        Objective::Time => motion.duration(),
    }
}
