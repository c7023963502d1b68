use super::over_grid::{Choice, over_grid};
use crate::planning::{Found, PlanError, Planner, Problem, Round};

/// `dstar`: D*'s back-pointers alone, over grid points and postures; for arms of two links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DstarPlanner;

impl Planner for DstarPlanner {
    fn name(&self) -> &str {
        "dstar"
    }

    fn links(&self) -> std::ops::RangeInclusive<usize> {
        2..=2
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        over_grid(problem, self.name(), Choice::OwnOnly)
    }
}
