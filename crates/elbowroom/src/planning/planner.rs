use std::ops::RangeInclusive;

use super::{Found, OptionValue, PlanError, Problem};

/// Walls of a lower bound that costs a millisecond or two to prove stand this far inside the obstacles (rad).
const COARSE_DISTANCE: f64 = 1e-2;

/// Which of a planner's searches it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Round {
    /// How far inside the obstacles the walls of the lower bound stood (rad): one of [`Planner::rounds`].
    pub distance: f64,
    /// No motion costs less (m, rad or s by the objective), as far as proved by now.
    pub lower_bound: Option<f64>,
}

/// A way to find paths or motions.
///
/// [`plan`](super::plan()) gives it a [`Problem`] and judges whatever it hands back: a planner can be wrong, its plans
/// cannot. An implementor needs a name and a search; examples/custom_planner.rs has one.
pub trait Planner: std::fmt::Debug + Send + Sync {
    /// The word for it in files and on the command line.
    fn name(&self) -> &str;

    /// The numbers of links of the arms that it serves.
    fn links(&self) -> RangeInclusive<usize> {
        2..=usize::MAX
    }

    /// Its options by name, with their values.
    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        Vec::new()
    }

    /// Gives `option`, one of [`options`](Self::options), another value.
    ///
    /// # Errors
    /// What it may be, such as `a whole number from 1 to 64`.
    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), String> {
        let _ = (option, value);
        Err("left out: there are no options".to_owned())
    }

    /// The option that limits how many candidates it judges, if it counts them.
    fn budget(&self) -> Option<&'static str> {
        None
    }

    /// How far inside the obstacles (rad) the walls of the lower bound stand in one search after the other: each is a
    /// proof of its own and a call of [`search`](Self::search). All but the first are for who asks for a
    /// [`gap`](super::PlanSettings::gap), or where a search has not found.
    fn rounds(&self) -> &[f64] {
        &[COARSE_DISTANCE]
    }

    /// Candidates for motions from one of the problem's starts to one of its goals.
    ///
    /// # Errors
    /// [`PlanError`]: [`PlanError::NotFoundInBudget`] and its kin where there is none, [`PlanError::Stopped`] where the monitor
    /// says so, [`PlanError::BadSettings`] and [`PlanError::Failed`] in the planner's own words.
    fn search(&self, problem: &Problem<'_>, round: Round) -> Result<Found, PlanError>;
}
