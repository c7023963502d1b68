//! Where time is what counts: accepted motions, made as fast as the limits allow.

use std::f64::consts::PI;

use super::made::{Made, followed, mismatched};
use super::{Objective, Pace, PlanError, Problem};
use crate::arm::{Arm, Joint, JointLimits};
use crate::optimise::{Constraints, fastest};
use crate::verify::Trajectory;

/// Arms of more links keep their motion as it is: one program would take seconds, in which nobody could stop it.
const MOST_LINKS: usize = 12;

/// Of `ranked` motions, the best first, the first; where time is what counts, the one that is the fastest when all are made faster.
///
/// # Errors
/// [`PlanError::Stopped`]
pub(super) fn fastest_of(
    problem: &Problem<'_>,
    ranked: Vec<(f64, Made)>,
) -> Result<Option<(f64, Made)>, PlanError> {
    if problem.settings.objective != Objective::Time || problem.settings.pace != Pace::Fastest {
        return Ok(ranked.into_iter().next());
    }
    let mut best: Option<(f64, Made)> = None;
    for (cost, made) in ranked {
        let (cost, made) = match faster(problem, &made)? {
            Some(faster) => (faster.trajectory.motion().duration(), faster),
            None => (cost, made),
        };
        if best.as_ref().is_none_or(|(known, _)| cost < *known) {
            best = Some((cost, made));
        }
    }
    Ok(best)
}

/// The fastest motion near a motion of ours, if that is faster.
///
/// # Errors
/// [`PlanError::Stopped`]
fn faster(problem: &Problem<'_>, made: &Made) -> Result<Option<Made>, PlanError> {
    let (scene, motion) = (problem.scene, made.trajectory.motion());
    if !made.is_ours || motion.duration() == 0.0 || scene.arm().links() > MOST_LINKS {
        return Ok(None);
    }
    let keep_going = || problem.monitor.keep_going();
    let start = motion.at(motion.start()).position;
    let ranges = ranges(scene.arm(), problem.endpoints.keep_posture, &start);
    let constraints =
        Constraints { scene, limits: &problem.limits, ranges: &ranges, keep_going: &keep_going };
    let found = fastest(&constraints, motion);
    problem.go_on()?;
    let is_faster = |found: &Trajectory| {
        found.motion().duration() < motion.duration() && mismatched(problem, found).is_none()
    };
    Ok(found.filter(is_faster).map(|trajectory| {
        let (joint_path, vias) = followed(scene, trajectory.motion());
        let path_cost = trajectory.motion().tip_length(scene.arm());
        let vias = [vias[0], vias[vias.len() - 1]].to_vec();
        Made { trajectory, joint_path, path_cost, vias, is_ours: true }
    }))
}

/// Where each joint may be (rad): within its limits, and where the posture is kept, on its side of full stretch and fold.
fn ranges(arm: &Arm, keep_posture: bool, start: &[f64]) -> Vec<[f64; 2]> {
    let range = |joint: &Joint| match joint.limits {
        JointLimits::Continuous => [f64::NEG_INFINITY, f64::INFINITY],
        JointLimits::Range { min, max } => [min, max],
    };
    let mut ranges: Vec<[f64; 2]> = arm.joints().iter().map(range).collect();
    if let (true, [_, second], [_, bend]) = (keep_posture, &mut ranges[..], start) {
        let half_turn = (bend / PI).floor();
        *second = [second[0].max(half_turn * PI), second[1].min((half_turn + 1.0) * PI)];
    }
    ranges
}
