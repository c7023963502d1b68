//! From what a planner found, paths or motions, to one that is accepted.

use super::candidate::Proposed;
use super::limits::stated_limits;
use super::made::{Made, followed, mismatched};
use super::shaping::{best_of, shapes};
use super::smoothing::{SmoothError, Smoothed, Style, smooth};
use super::{
    AssumedLimit, END_ROUNDING, Found, Pace, PathToFollow, Pick, Plan, PlanError, PlanRecord, Problem, Stage,
    mismatch,
};
use crate::trajectory::Motion;
use crate::verify::{Trajectory, VerifySettings};

/// Costs that differ by less than this share are the same: sums of the same steps in another order.
const SAME_COST: f64 = 1e-9;

/// The plan of `planner` that the best, or the first, of the candidates makes.
///
/// # Errors
/// [`PlanError`], the last candidate's, where none is accepted.
pub(super) fn accepted(
    problem: &Problem<'_>,
    planner: &str,
    found: Found,
    lower_bound: Option<f64>,
) -> Result<Plan, PlanError> {
    problem.monitor.stage(Stage::Trajectory);
    let (scene, objective) = (problem.scene, problem.settings.objective);
    let evaluations = found.effort.as_ref().map_or(0, |effort| effort.evaluations);
    let mut refused = PlanError::NotFoundInBudget { evaluations };
    let mut ranked: Vec<(f64, Made)> = Vec::new();
    // Where among them the first is that was proposed.
    let mut first = 0;
    for candidate in found.candidates {
        let made = match candidate.0 {
            Proposed::Path { path, is_certified } => along(problem, planner, path, is_certified, lower_bound),
            Proposed::Motion { motion, is_draft } => {
                judged(problem, planner, motion).map(|made| Made { is_ours: is_draft, ..made })
            }
        };
        let made = match made {
            Ok(made) => made,
            Err(PlanError::Stopped) => return Err(PlanError::Stopped),
            Err(error) => {
                refused = error;
                continue;
            }
        };
        let trajectory = &made.trajectory;
        // One that is to be shaped takes as long as was asked for in the end.
        let mismatch = match made.is_ours && shapes(problem) {
            true => mismatch(scene, problem.task, trajectory.motion(), &trajectory.verdict().posture_changes),
            false => mismatched(problem, trajectory),
        };
        if let Some(mismatch) = mismatch {
            refused = PlanError::Mismatch { planner: planner.to_owned(), mismatch };
            continue;
        }
        let cost = objective.of_motion(scene.arm(), trajectory.motion());
        let rank = ranked.iter().position(|(known, of)| is_better((cost, &made), (*known, of)));
        let rank = rank.unwrap_or(ranked.len());
        if !ranked.is_empty() && rank <= first {
            first += 1;
        }
        ranked.insert(rank, (cost, made));
        if found.pick == Pick::First {
            break;
        }
    }
    let (cost, made) = best_of(problem, ranked, first, lower_bound)?.ok_or(refused)?;
    if let Some(mismatch) = mismatched(problem, &made.trajectory) {
        return Err(PlanError::Mismatch { planner: planner.to_owned(), mismatch });
    }
    let Made { trajectory, joint_path, path_cost, vias, .. } = made;
    let record = PlanRecord {
        cost,
        lower_bound,
        path_cost,
        paths_to_choose_from: found.chosen_from,
        tip_path: joint_path.tips(scene.arm()),
        joint_path,
        vias,
        stops: trajectory.motion().stops(),
        assumed_limits: kept(&problem.assumed_limits, &trajectory),
        effort: found.effort,
        clearance: 0.0,
    };
    Ok(Plan::new(record, trajectory))
}

/// The limits that were assumed and that the motion keeps: one that takes as long as it was asked to may go beyond them, which
/// only the scene could forbid.
fn kept(assumed: &[AssumedLimit], trajectory: &Trajectory) -> Vec<AssumedLimit> {
    let (margins, motion) = (&trajectory.verdict().motion_margins, trajectory.motion());
    let ends = [motion.start(), motion.end()].map(|time| motion.at(time).acceleration);
    let keeps = |limit: &&AssumedLimit| {
        // An acceleration out of nothing is a jerk beyond any limit.
        let jumps = |end: &Vec<f64>| limit.rate == "jerk" && end[limit.joint - 1].abs() > END_ROUNDING;
        margins[limit.joint - 1]
            .of(limit.rate)
            .is_some_and(|margin| margin.largest <= limit.value * (1.0 + SAME_COST))
            && !ends.iter().any(jumps)
    };
    assumed.iter().filter(keeps).copied().collect()
}

/// Whether one costs less, or the same with more clearance.
fn is_better((cost, one): (f64, &Made), (known, other): (f64, &Made)) -> bool {
    let clearance =
        |made: &Made| made.trajectory.verdict().least_clearance.map_or(f64::INFINITY, |at| at.distance);
    let slack = SAME_COST * known;
    cost < known - slack || (cost <= known + slack && clearance(one) > clearance(other))
}

/// A motion along a path, whose moves are certified first unless they were.
fn along(
    problem: &Problem<'_>,
    planner: &str,
    follow: PathToFollow,
    is_certified: bool,
    lower_bound: Option<f64>,
) -> Result<Made, PlanError> {
    let uncertified = if is_certified { None } else { follow.first_uncertified(problem.scene) };
    if let Some(from) = uncertified {
        return Err(PlanError::Uncertified { planner: planner.to_owned(), from });
    }
    let smoothed = smoothed(problem, planner, &follow, lower_bound)?;
    let path_cost = follow.tip_travel(problem.scene.arm());
    Ok(Made {
        trajectory: smoothed.trajectory,
        joint_path: follow.path,
        path_cost,
        vias: smoothed.vias,
        is_ours: true,
    })
}

/// The path, smoothed; with a stop at each corner where only that is as short as the gap asks for.
fn smoothed(
    problem: &Problem<'_>,
    planner: &str,
    PathToFollow { path, tolerance, .. }: &PathToFollow,
    lower_bound: Option<f64>,
) -> Result<Smoothed, PlanError> {
    let (scene, objective) = (problem.scene, problem.settings.objective);
    let pace = if shapes(problem) { Pace::Fastest } else { problem.settings.pace };
    let stated = stated_limits(scene.arm());
    let wanted = (pace, problem.endpoints.keep_posture);
    let smooth = |style| smooth(scene, &path.0, &problem.limits, &stated, wanted, style, problem.monitor);
    let flowing = smooth(Style::Flowing { tolerance: *tolerance })
        .map_err(|error: SmoothError| error.in_terms_of(planner, pace))?;
    let (Some(gap), Some(bound)) = (problem.settings.gap, lower_bound) else { return Ok(flowing) };
    let is_too_long = |cost: f64| cost > bound * (1.0 + gap);
    let own = objective.of_path(scene.arm(), path);
    if is_too_long(objective.of_motion(scene.arm(), flowing.trajectory.motion()))
        && own.is_some_and(|own| !is_too_long(own))
    {
        return Ok(smooth(Style::StopToStop).unwrap_or(flowing));
    }
    Ok(flowing)
}

/// The motion as it is.
fn judged(problem: &Problem<'_>, planner: &str, motion: Motion) -> Result<Made, PlanError> {
    let keep_going = || problem.monitor.keep_going();
    let settings = VerifySettings::default();
    let trajectory =
        Trajectory::certify_until(problem.scene, motion, &settings, &keep_going).map_err(|verdict| {
            match problem.go_on() {
                Ok(()) => PlanError::Refused { planner: planner.to_owned(), verdict },
                Err(stopped) => stopped,
            }
        })?;
    let (joint_path, vias) = followed(problem.scene, trajectory.motion());
    let path_cost = trajectory.motion().tip_length(problem.scene.arm());
    Ok(Made { trajectory, joint_path, path_cost, vias, is_ours: false })
}
