use std::ops::RangeInclusive;

use super::off_grid::{Search, over_joints, over_tips};
use super::over_grid::{self, Choice, paths_over_grid};
use crate::path::JointPath;
use crate::planning::{Candidate, Found, PathToFollow, Pick, PlanError, Planner, Problem, Round};

/// How closely paths are followed, and how near to the obstacles they and the walls of bounds are.
struct Settings {
    /// How far a motion may stray from a taut path before the verifier is asked, in grid steps: it has no zigzag to lose.
    taut_tolerance: f64,
    /// How much farther inside the obstacles the walls of a bound stand than those of free cells before them: a wall costs
    /// more to prove than to look past.
    walls_deeper: f64,
    /// Walls of lower bounds stand this far inside the obstacles (rad), from round to round: twice as far as the free cells stay before
    /// them.
    distances: [f64; 5],
}

const SETTINGS: Settings =
    Settings { taut_tolerance: 0.1, walls_deeper: 2.0, distances: [6e-3, 2e-3, 2e-4, 2e-5, 2e-6] };

/// `optimal`: taut paths that leave the grid, with a lower bound, ever nearer to the obstacles until the gap between both is as
/// small as was asked for; for arms of two links.
///
/// # Reference
/// Exact shortest paths over a cell decomposition of the configuration space, and over the tip's plane: docs/planners/optimal.md.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OptimalPlanner;

impl Planner for OptimalPlanner {
    fn name(&self) -> &str {
        "optimal"
    }

    fn links(&self) -> RangeInclusive<usize> {
        2..=2
    }

    fn rounds(&self) -> &[f64] {
        &SETTINGS.distances
    }

    /// Paths over the joints or, where that is what counts, over the tip; where corners cost what D* finds as well, which may have
    /// fewer of them.
    fn search(&self, problem: &Problem<'_>, round: Round) -> Result<Found, PlanError> {
        let scene = problem.two_link(self.name())?;
        let (objective, limits) = (problem.settings.objective, &problem.limits);
        // Whoever asks for a gap wants the best of several.
        let near = match problem.settings.gap {
            None if !objective.is_in_workspace() && !objective.minds_corners() => round.lower_bound,
            _ => None,
        };
        let search = Search::new(round.distance / SETTINGS.walls_deeper, near);
        let over_joints =
            || over_joints(scene, &problem.endpoints, objective, limits, search, problem.monitor);
        let taut = |path| candidate(path, SETTINGS.taut_tolerance);
        let candidates = if objective.is_in_workspace() {
            let on_grid = self.on_grid(problem)?.candidates;
            let mut rough: Vec<JointPath> = on_grid.into_iter().filter_map(Candidate::into_path).collect();
            if rough.is_empty() {
                rough = over_joints()?;
            }
            let mut candidates = Vec::new();
            for path in &rough {
                candidates.extend(over_tips(scene, path, problem.monitor)?.into_iter().map(taut));
            }
            candidates
        } else if objective.minds_corners() {
            let mut candidates = self.on_grid(problem)?.candidates;
            match over_joints() {
                // The corners are kept to closely, and loosely.
                Ok(more) => {
                    candidates.extend(more.into_iter().flat_map(|path| {
                        [candidate(path.clone(), over_grid::SETTINGS.tolerance), taut(path)]
                    }))
                }
                Err(PlanError::NotFoundOverJoints { .. }) if !candidates.is_empty() => {}
                Err(other) => return Err(other),
            }
            candidates
        } else {
            over_joints()?.into_iter().map(taut).collect()
        };
        Ok(Found::new(candidates, Pick::Best))
    }
}

impl OptimalPlanner {
    /// D*'s own paths; none where the grid does not connect start and goal.
    fn on_grid(&self, problem: &Problem<'_>) -> Result<Found, PlanError> {
        match paths_over_grid(problem, self.name(), Choice::OwnOnly) {
            Err(PlanError::NotFound { .. }) => Ok(Found::new(Vec::new(), Pick::Best)),
            other => other,
        }
    }
}

/// A motion along `path`.
fn candidate(path: JointPath, tolerance: f64) -> Candidate {
    Candidate::certified(PathToFollow { path, tip_travel: None, tolerance })
}
