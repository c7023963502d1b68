//! Paths, found one after the other and made shorter, as candidates.

use super::local_planner::LocalPlanner;
use super::shorten::{estimated_cost, shortened};
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::planning::{Candidate, Exhausted, Found, PathToFollow, Pick, PlanError, Problem};

/// Shortens the paths that `next` finds until `enough` are found or the budget is spent; where it finds none it is asked again. The
/// cheapest, `most` of them, are candidates: the first that is accepted will do.
///
/// # Errors
/// [`PlanError`]
pub(in crate::planners) fn gather(
    problem: &Problem<'_>,
    mut local: LocalPlanner<'_>,
    [enough, most]: [usize; 2],
    mut next: impl FnMut(&mut LocalPlanner<'_>) -> Result<Option<Vec<Configuration>>, Exhausted>,
) -> Result<Found, PlanError> {
    let (arm, objective) = (problem.scene.arm(), problem.settings.objective);
    let mut paths: Vec<(f64, JointPath)> = Vec::new();
    while paths.len() < enough {
        let found = match next(&mut local) {
            Ok(Some(path)) => shortened(&mut local, path, objective),
            Ok(None) => continue,
            Err(exhausted) => Err(exhausted),
        };
        match found {
            Ok(path) => {
                let estimate = estimated_cost(arm, objective, &path, problem.scene.grid().step());
                local.budget.found(estimate);
                paths.push((estimate, path));
            }
            Err(Exhausted::Spent) => break,
            Err(Exhausted::Failed(error)) => return Err(error),
        }
    }
    paths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let chosen_from = paths.len();
    let candidate = |(_, path)| Candidate::certified(PathToFollow::closely(path));
    let candidates = paths.into_iter().take(most).map(candidate).collect();
    Ok(Found { candidates, pick: Pick::First, chosen_from, effort: Some(local.budget.effort()) })
}
