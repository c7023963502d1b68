use std::ops::RangeInclusive;

use super::over_grid::{Choice, over_grid};
use crate::planning::{Found, OptionValue, PlanError, Planner, Problem, Round};
use crate::swarm::{GuidedSwarmSettings, MAX_CANDIDATES};

/// `dstar-pso`, the paper's: of D*'s own paths over grid points and postures, and those that the modified lbest swarm draws
/// over its cost-to-go, the best; for arms of two links.
///
/// # Reference
/// The paper's sections 4, 6 and 7; what is certified is ours.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DstarPsoPlanner {
    /// How the swarm draws.
    pub swarm: GuidedSwarmSettings,
}

impl Planner for DstarPsoPlanner {
    fn name(&self) -> &str {
        "dstar-pso"
    }

    fn links(&self) -> RangeInclusive<usize> {
        2..=2
    }

    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        vec![("candidates", OptionValue::Count(self.swarm.candidates))]
    }

    fn set(&mut self, _: &str, value: &OptionValue) -> Result<(), String> {
        self.swarm.candidates = value.count_in(1..=MAX_CANDIDATES)?;
        Ok(())
    }

    fn budget(&self) -> Option<&'static str> {
        Some("candidates")
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        self.swarm.check().map_err(|error| PlanError::BadSettings {
            planner: self.name().to_owned(),
            reason: error.to_string(),
        })?;
        over_grid(problem, self.name(), Choice::Drawn(&self.swarm))
    }
}
