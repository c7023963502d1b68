//! Lets swarms hunt for the best candidate that is certified, one swarm after the other, until the budget is spent.

use super::super::chain::{Halt, Ledger};
use super::super::{Monitor, PlanError};
use crate::swarm::Fitness;

/// How much a candidate that looks free and is refused counts as violating (m²): less than any that looks in contact.
const REFUSED: f64 = 1e-12;

/// Judges candidates and keeps the best that is certified.
pub(super) struct Hunt<'a, M, T> {
    ledger: Ledger<'a, M>,
    best: Option<(f64, T)>,
    halt: Option<Halt>,
}

impl<'a, M: Monitor, T> Hunt<'a, M, T> {
    pub(super) fn new(budget: usize, monitor: &'a M) -> Self {
        Self { ledger: Ledger::new(budget, monitor), best: None, halt: None }
    }

    /// The fitness of a candidate of this cost and violation. One that seems to be the best is certified first: `certify`
    /// gives what it stands for, or `None` if it is not free after all.
    pub(super) fn judge(
        &mut self,
        violation: impl FnOnce() -> f64,
        cost: impl FnOnce() -> f64,
        certify: impl FnOnce() -> Option<T>,
    ) -> Fitness {
        if self.is_over() {
            return Fitness { violation: f64::INFINITY, cost: f64::INFINITY };
        }
        if let Err(halt) = self.ledger.spend(1) {
            self.halt = Some(halt);
            return Fitness { violation: f64::INFINITY, cost: f64::INFINITY };
        }
        let violation = violation();
        if violation > 0.0 || violation.is_nan() {
            return Fitness { violation: violation.max(REFUSED), cost: 0.0 };
        }
        let cost = cost();
        if self.best.as_ref().is_none_or(|(least, _)| cost < *least) {
            let Some(found) = certify() else { return Fitness { violation: REFUSED, cost } };
            self.ledger.found(cost);
            self.best = Some((cost, found));
        }
        Fitness { violation: 0.0, cost }
    }

    /// Whether the budget is spent, or the monitor has stopped it.
    pub(super) fn is_over(&self) -> bool {
        self.halt.is_some()
    }

    /// The best certified candidate, and what it took.
    ///
    /// # Errors
    /// [`PlanError::Stopped`] or [`PlanError::NotFoundInBudget`] where there is none.
    pub(super) fn end(self) -> Result<(T, super::super::Effort), PlanError> {
        match (self.best, self.halt) {
            (Some((_, found)), _) => Ok((found, self.ledger.effort())),
            (None, Some(Halt::Failed(error))) => Err(error),
            (None, _) => Err(PlanError::NotFoundInBudget { evaluations: self.ledger.made() }),
        }
    }
}

/// Iterations without a better candidate after which a swarm is given up.
pub(super) struct Patience {
    left: usize,
    best: Fitness,
}

impl Patience {
    const ITERATIONS: usize = 60;

    pub(super) fn new() -> Self {
        use crate::swarm::Value;
        Self { left: Self::ITERATIONS, best: Fitness::WORST }
    }

    /// Whether the swarm, whose best is `best` now, is worth another iteration.
    pub(super) fn lasts(&mut self, best: Fitness) -> bool {
        use crate::swarm::Value;
        if best.is_better(self.best) {
            *self = Self { left: Self::ITERATIONS, best };
        }
        self.left = self.left.saturating_sub(1);
        self.left > 0
    }
}
