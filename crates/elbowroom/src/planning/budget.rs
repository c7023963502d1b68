//! What a search has spent, and may spend.

use super::{Effort, Monitor, PlanError};

/// Evaluations between two samples at the monitor: a few milliseconds.
const EVALUATIONS_PER_LOOK: usize = 200;

/// Why a search ends before it has found.
#[derive(Debug, Clone, PartialEq)]
pub enum Exhausted {
    /// The budget is spent.
    Spent,
    /// Something that no further search mends.
    Failed(PlanError),
}

impl From<PlanError> for Exhausted {
    fn from(error: PlanError) -> Self {
        Self::Failed(error)
    }
}

/// Counts evaluations, and asks the monitor every few of them.
pub struct Budget<'a> {
    /// Who is asked whether to go on.
    pub monitor: &'a dyn Monitor,
    limit: usize,
    made: usize,
    looked_at: usize,
    convergence: Vec<(usize, f64)>,
}

impl<'a> Budget<'a> {
    /// Of `limit` evaluations.
    pub fn new(limit: usize, monitor: &'a dyn Monitor) -> Self {
        Self { monitor, limit, made: 0, looked_at: 0, convergence: Vec::new() }
    }

    /// How many evaluations were made.
    pub fn made(&self) -> usize {
        self.made
    }

    /// How many may still be made.
    pub fn left(&self) -> usize {
        self.limit - self.made
    }

    /// Enters `evaluations` that are about to be made.
    ///
    /// # Errors
    /// [`Exhausted`] when there are not so many left, or the monitor says no; then none is entered.
    pub fn spend(&mut self, evaluations: usize) -> Result<(), Exhausted> {
        if evaluations > self.left() {
            return Err(Exhausted::Spent);
        }
        if self.made + evaluations >= self.looked_at + EVALUATIONS_PER_LOOK {
            self.looked_at = self.made + evaluations;
            self.look()?;
        }
        self.made += evaluations;
        Ok(())
    }

    /// Gives back what was entered and not made.
    pub fn give_back(&mut self, evaluations: usize) {
        self.made = self.made.saturating_sub(evaluations);
        self.looked_at = self.looked_at.min(self.made);
    }

    /// Asks the monitor.
    ///
    /// # Errors
    /// [`PlanError::Stopped`]
    pub fn look(&self) -> Result<(), PlanError> {
        if self.monitor.keep_going() { Ok(()) } else { Err(PlanError::Stopped) }
    }

    /// Enters a feasible candidate of `cost`.
    pub fn found(&mut self, cost: f64) {
        if self.convergence.last().is_none_or(|(_, known)| cost < *known) {
            self.convergence.push((self.made, cost));
        }
    }

    /// The account.
    pub fn effort(self) -> Effort {
        Effort { evaluations: self.made, convergence: self.convergence }
    }
}
