//! Accepted motions, made better for what was asked, shape and timing together.

use std::f64::consts::PI;

use super::limits::stated_limits;
use super::made::{Made, followed};
use super::{Pace, PlanError, Problem, mismatch};
use crate::arm::{Arm, Joint, JointLimits};
use crate::optimise::{Constraints, Goal, Length, improved};
use crate::path::can_be_deformed;
use crate::trajectory::{Motion, SpeedLimits};
use crate::verify::{Trajectory, VerifySettings};

/// How far within its limits a joint stays (rad), except where a task begins or ends nearer: samples of the motion, interpolated by
/// others, may overshoot.
const WITHIN_LIMITS: f64 = 1e-4;

/// Arms of more links keep their motion as it is: one program would take seconds, in which nobody could stop it.
const MOST_LINKS: usize = 12;

/// How many motions are made better, at most.
const SHAPED: usize = 3;

/// Whether motions of ours in `problem` are shaped.
pub(super) fn shapes(problem: &Problem<'_>) -> bool {
    problem.scene.arm().links() <= MOST_LINKS
}

/// Of `ranked` motions, the best first, of which the one at `first` was proposed before all others, the one that is the best when they are
/// made better: the fastest where time counts, else the fastest of those that are longer by no more than the slack than the shortest; of the
/// duration that was asked for, if one was.
///
/// # Errors
/// [`PlanError::Stopped`], [`PlanError::TooFast`]
pub(super) fn best_of(
    problem: &Problem<'_>,
    mut ranked: Vec<(f64, Made)>,
    first: usize,
    lower_bound: Option<f64>,
) -> Result<Option<(f64, Made)>, PlanError> {
    let is_ours = |(_, made): &(f64, Made)| made.is_ours && made.trajectory.motion().duration() > 0.0;
    if !shapes(problem) || !ranked.iter().any(is_ours) {
        return Ok(ranked.into_iter().next());
    }
    let least = ranked.iter().map(|(cost, _)| *cost).fold(f64::INFINITY, f64::min);
    // What was proposed first is always among them: what its motion costs as yet does not tell what becomes of it.
    ranked[..=first].rotate_right(1);
    let mut best: Option<Best> = None;
    for motions in in_turn(problem, ranked) {
        let (motions, longest) = match problem.settings.objective.length() {
            Some(length) => shortest_of(problem, motions, length, lower_bound)?,
            None => (motions, None),
        };
        let found = fastest_of(problem, motions, longest)?.map(|(cost, made)| Best { cost, made, longest });
        best = best.into_iter().chain(found).min_by(|a, b| a.cost.total_cmp(&b.cost));
        // Where none of them became better, others may.
        if best.as_ref().is_some_and(|best| best.cost < least) {
            break;
        }
    }
    let Some(Best { cost, made, longest }) = best else { return Ok(None) };
    match problem.settings.pace {
        Pace::Duration(seconds) if made.is_ours => lasting(problem, made, seconds, longest).map(Some),
        _ => Ok(Some((cost, made))),
    }
}

/// What became of some motions.
struct Best {
    cost: f64,
    made: Made,
    /// What it was not to be longer than.
    longest: Longest,
}

/// `ranked` motions, [`SHAPED`] at a time: at first those whose paths cannot be pulled over to any before them, for what can be ends as the
/// same motion when it is made better, as a rule.
fn in_turn(problem: &Problem<'_>, ranked: Vec<(f64, Made)>) -> Vec<Vec<(f64, Made)>> {
    let mut first: Vec<(f64, Made)> = Vec::new();
    let mut others = Vec::new();
    for (cost, made) in ranked {
        let is_known =
            |(_, known): &(f64, Made)| can_be_deformed(problem.scene, &known.joint_path, &made.joint_path);
        if first.len() < SHAPED && !first.iter().any(is_known) {
            first.push((cost, made));
        } else {
            others.push((cost, made));
        }
    }
    let mut turns = vec![first];
    while !others.is_empty() {
        let later = others.split_off(others.len().min(SHAPED));
        turns.push(std::mem::replace(&mut others, later));
    }
    turns
}

/// A length, and the most that a motion may have of it (m or rad).
type Longest = Option<(Length, f64)>;

/// All of `motions` that are not longer than they may be when they are made as short as they can, and how long that is.
///
/// # Errors
/// [`PlanError::Stopped`]
fn shortest_of(
    problem: &Problem<'_>,
    motions: Vec<(f64, Made)>,
    length: Length,
    lower_bound: Option<f64>,
) -> Result<(Vec<(f64, Made)>, Longest), PlanError> {
    let shorten = |(cost, made): (f64, Made)| {
        let shorter = better(problem, &made, &problem.limits, Goal::Shortest(length), None)?;
        Ok(shorter.filter(|(shorter, _)| *shorter < cost).unwrap_or((cost, made)))
    };
    let mut shortened = each(motions, shorten)?;
    shortened.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((least, _)) = shortened.first() else { return Ok((shortened, None)) };
    let mut longest = least * (1.0 + problem.settings.slack);
    if let (Some(gap), Some(bound)) = (problem.settings.gap, lower_bound) {
        longest = longest.min(least.max(bound * (1.0 + gap)));
    }
    shortened.retain(|(cost, _)| *cost <= longest);
    Ok((shortened, Some((length, longest))))
}

/// The fastest of `motions` when all are made faster, with its cost.
///
/// # Errors
/// [`PlanError::Stopped`]
fn fastest_of(
    problem: &Problem<'_>,
    motions: Vec<(f64, Made)>,
    longest: Longest,
) -> Result<Option<(f64, Made)>, PlanError> {
    let mut best: Option<(f64, Made)> = None;
    for found in each(motions, |motion| faster(problem, motion, longest))? {
        if best.as_ref().is_none_or(|(_, known)| duration(&found.1) < duration(known)) {
            best = Some(found);
        }
    }
    Ok(best)
}

/// What `becomes` of each motion, in their order, on all cores where the pool is compiled in.
fn each(
    motions: Vec<(f64, Made)>,
    becomes: impl Fn((f64, Made)) -> Result<(f64, Made), PlanError> + Send + Sync,
) -> Result<Vec<(f64, Made)>, PlanError> {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        motions.into_par_iter().map(becomes).collect()
    }
    #[cfg(not(feature = "parallel"))]
    motions.into_iter().map(becomes).collect()
}

fn duration(made: &Made) -> f64 {
    made.trajectory.motion().duration()
}

/// A motion made faster, or as it was.
///
/// # Errors
/// [`PlanError::Stopped`]
fn faster(
    problem: &Problem<'_>,
    (cost, made): (f64, Made),
    longest: Longest,
) -> Result<(f64, Made), PlanError> {
    let fastest = |made: &Made, longest| better(problem, made, &problem.limits, Goal::Fastest, longest);
    // What is fast without regard to its length and shortened then is faster, as a rule, than what is short and made faster.
    let mut found = None;
    if longest.is_some()
        && let Some((_, regardless)) = fastest(&made, None)?
    {
        found = fastest(&regardless, longest)?;
    }
    if found.is_none() {
        found = fastest(&made, longest)?;
    }
    Ok(found.filter(|(_, found)| duration(found) < duration(&made)).unwrap_or((cost, made)))
}

/// The smoothest motion that takes so many `seconds`, under the limits that are assumed where the scene states none as long as they
/// allow it, under those stated otherwise.
///
/// # Errors
/// [`PlanError::Stopped`], [`PlanError::TooFast`]
fn lasting(
    problem: &Problem<'_>,
    mut fastest: Made,
    seconds: f64,
    longest: Longest,
) -> Result<(f64, Made), PlanError> {
    let stated = stated_limits(problem.scene.arm());
    let mut limits = &problem.limits;
    if duration(&fastest) > seconds {
        limits = &stated;
        if let Some((_, faster)) = better(problem, &fastest, limits, Goal::Fastest, longest)?
            && duration(&faster) < duration(&fastest)
        {
            fastest = faster;
        }
    }
    if let Some(found) = better(problem, &fastest, limits, Goal::Smoothest(seconds), longest)? {
        return Ok(found);
    }
    let too_fast = PlanError::TooFast { duration: seconds, fastest: duration(&fastest) };
    let slower = fastest.trajectory.motion().lasting(seconds).map_err(|_| too_fast.clone())?;
    accepted(problem, &fastest, slower)?.ok_or(too_fast)
}

/// The best motion for `goal` near a motion of ours, and its cost; `None` where none is found that does the task.
///
/// # Errors
/// [`PlanError::Stopped`]
fn better(
    problem: &Problem<'_>,
    made: &Made,
    limits: &[SpeedLimits],
    goal: Goal,
    longest: Longest,
) -> Result<Option<(f64, Made)>, PlanError> {
    let (scene, motion) = (problem.scene, made.trajectory.motion());
    if !made.is_ours || motion.duration() == 0.0 {
        return Ok(None);
    }
    let keep_going = || problem.monitor.keep_going();
    let start = motion.at(motion.start()).position;
    let ranges = ranges(scene.arm(), problem.endpoints.keep_posture, &start);
    let constraints = Constraints { scene, limits, ranges: &ranges, longest, keep_going: &keep_going };
    let found = improved(&constraints, goal, motion);
    problem.go_on()?;
    Ok(found.and_then(|trajectory| doing_the_task(problem, made, trajectory)))
}

/// The motion and its cost, if it is safe and does the task.
///
/// # Errors
/// [`PlanError::Stopped`]
fn accepted(problem: &Problem<'_>, made: &Made, motion: Motion) -> Result<Option<(f64, Made)>, PlanError> {
    let keep_going = || problem.monitor.keep_going();
    let certified = Trajectory::certify_until(problem.scene, motion, &VerifySettings::default(), &keep_going);
    problem.go_on()?;
    Ok(certified.ok().and_then(|trajectory| doing_the_task(problem, made, trajectory)))
}

/// What became of `made`, and its cost, if it does the task.
fn doing_the_task(problem: &Problem<'_>, made: &Made, trajectory: Trajectory) -> Option<(f64, Made)> {
    let (scene, motion) = (problem.scene, trajectory.motion());
    let changes = &trajectory.verdict().posture_changes;
    if mismatch(scene, problem.task, motion, changes).is_some() {
        return None;
    }
    let cost = problem.settings.objective.of_motion(scene.arm(), motion);
    let (joint_path, vias) = followed(scene, motion);
    let vias = [vias[0], vias[vias.len() - 1]].to_vec();
    Some((cost, Made { trajectory, joint_path, path_cost: made.path_cost, vias, is_ours: true }))
}

/// Where each joint may be (rad): within its limits, and where the posture is kept, on its side of full stretch and fold.
fn ranges(arm: &Arm, keep_posture: bool, start: &[f64]) -> Vec<[f64; 2]> {
    let range = |joint: &Joint| match joint.limits {
        JointLimits::Continuous => [f64::NEG_INFINITY, f64::INFINITY],
        JointLimits::Range { min, max } => [min + WITHIN_LIMITS, max - WITHIN_LIMITS],
    };
    let mut ranges: Vec<[f64; 2]> = arm.joints().iter().map(range).collect();
    if let (true, [_, second], [_, bend]) = (keep_posture, &mut ranges[..], start) {
        let half_turn = (bend / PI).floor();
        *second = [second[0].max(half_turn * PI), second[1].min((half_turn + 1.0) * PI)];
    }
    ranges
}
