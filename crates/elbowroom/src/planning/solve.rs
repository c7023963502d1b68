//! The one way from a task to a plan, whatever the planner.

use super::accept::accepted;
use super::bound::least_cost;
use super::plan::check_bound;
use super::{
    Candidate, Effort, Found, Monitor, Pace, PathToFollow, Pick, Plan, PlanError, PlanSettings, Planner,
    Problem, Round,
};
use crate::path::JointPath;
use crate::scene::{Scene, Task};

/// Plans `task`: whatever the planner, what comes out is a motion that the verifier has proved to be safe, from a start of the
/// task to a goal of it, at rest at both.
///
/// # Errors
/// [`PlanError`]; a missing path is [`PlanError::NoPath`] where that is proved.
pub fn plan(
    scene: &Scene,
    task: &Task,
    planner: &dyn Planner,
    settings: &PlanSettings,
    monitor: &dyn Monitor,
) -> Result<Plan, PlanError> {
    if let Some(obstacle) = scene.first_moving() {
        return Err(PlanError::Moving { obstacle, name: scene.obstacles()[obstacle].name.clone() });
    }
    settings.check()?;
    if settings.gap.is_some() && planner.rounds().len() < 2 {
        return Err(PlanError::GapOfOneRound { planner: planner.name().to_owned() });
    }
    let (served, links) = (planner.links(), scene.arm().links());
    if !served.contains(&links) {
        let (least, most) = served.into_inner();
        return Err(PlanError::OtherArm { planner: planner.name().to_owned(), least, most, links });
    }
    let clearance = settings.clearance.unwrap_or(task.clearance);
    if clearance == 0.0 {
        return solved(&Problem::new(scene, task, settings, monitor)?, planner);
    }
    let thicker = scene.with_clearance(clearance).ok_or(PlanError::Clearance { clearance })?;
    let problem = Problem::new(&thicker, task, settings, monitor).map_err(|error| error.within(clearance))?;
    let plan = solved(&problem, planner).map_err(|error| error.within(clearance))?;
    plan.with_clearance(&problem, scene, planner.name(), clearance)
}

/// What the planner makes of the problem, if the arm is not there already.
fn solved(problem: &Problem<'_>, planner: &dyn Planner) -> Result<Plan, PlanError> {
    if let Some(q) = problem.endpoints.already_there() {
        let stay = PathToFollow::closely(JointPath(vec![q.clone()]));
        let stay = Found::new(vec![Candidate::certified(stay)], Pick::First);
        let effort = planner.budget().map(|_| Effort::default());
        return accepted(problem, planner.name(), Found { effort, ..stay }, Some(0.0));
    }
    searched(problem, planner)
}

/// What the planner finds, in one round or, until the gap asked for is reached, several.
fn searched(problem: &Problem<'_>, planner: &dyn Planner) -> Result<Plan, PlanError> {
    let mut best: Option<Plan> = None;
    let mut lower_bound = None;
    let mut last = PlanError::Stopped;
    for &distance in planner.rounds() {
        let step = least_cost(problem, distance).and_then(|proved| {
            lower_bound = [lower_bound, proved].into_iter().flatten().reduce(f64::max);
            let found = planner.search(problem, Round { distance, lower_bound })?;
            accepted(problem, planner.name(), found, lower_bound)
        });
        match step {
            Ok(plan) if best.as_ref().is_none_or(|known| plan.cost() < known.cost()) => best = Some(plan),
            Ok(_) => {}
            // Nearer to the obstacles there may be one.
            Err(error @ (PlanError::NotFound { .. } | PlanError::NotFoundOverJoints { .. })) => last = error,
            Err(PlanError::Stopped) if best.is_some() => break,
            Err(error) => return Err(error),
        }
        best = best.map(|plan| {
            let is_concerned = concerns(problem, &plan);
            plan.with_lower_bound(lower_bound.filter(|_| is_concerned))
        });
        let reached = |plan: &Plan| {
            problem.settings.gap.is_none_or(|gap| plan.gap().is_some_and(|reached| reached <= gap))
        };
        if best.as_ref().is_some_and(reached) {
            break;
        }
    }
    let plan = best.ok_or(last)?;
    if let Some(bound) = plan.lower_bound() {
        check_bound(plan.cost(), bound)?;
    }
    Ok(plan)
}

/// Whether what was proved holds for the motion of `plan`: a bound on time regards the limits that were assumed as well, and a
/// motion of another's making may go beyond them.
fn concerns(problem: &Problem<'_>, plan: &Plan) -> bool {
    problem.settings.pace != Pace::Fastest
        || !problem.settings.objective.regards_limits()
        || plan.record().assumed_limits.len() == problem.assumed_limits.len()
}
