//! The incumbent: the best candidate so far that is certified, whichever swarm found it, until the budget is spent.

use super::settings::SETTINGS;
use crate::planning::{Budget, Effort, Exhausted, Monitor, PlanError};
use crate::swarm::Fitness;

/// How much a candidate that looks free and is refused counts as violating (m²): less than any that looks in contact.
const REFUSED: f64 = 1e-12;

/// Judges candidates and keeps the best that is certified.
pub(in crate::planners) struct Incumbent<'a, T> {
    budget: Budget<'a>,
    best: Option<(f64, T)>,
    ended: Option<Exhausted>,
}

impl<'a, T> Incumbent<'a, T> {
    pub(in crate::planners) fn new(evaluations: usize, monitor: &'a dyn Monitor) -> Self {
        Self { budget: Budget::new(evaluations, monitor), best: None, ended: None }
    }

    /// The fitness of a candidate of this cost and violation. One that seems to be the best is certified first: `certify`
    /// gives what it stands for, or `None` if it is not free after all.
    pub(in crate::planners) fn evaluate(
        &mut self,
        violation: impl FnOnce() -> f64,
        cost: impl FnOnce() -> f64,
        certify: impl FnOnce() -> Option<T>,
    ) -> Fitness {
        if self.is_over() {
            return Fitness { violation: f64::INFINITY, cost: f64::INFINITY };
        }
        if let Err(exhausted) = self.budget.spend(1) {
            self.ended = Some(exhausted);
            return Fitness { violation: f64::INFINITY, cost: f64::INFINITY };
        }
        let violation = violation();
        if violation > 0.0 || violation.is_nan() {
            return Fitness { violation: violation.max(REFUSED), cost: 0.0 };
        }
        let cost = cost();
        if self.best.as_ref().is_none_or(|(least, _)| cost < *least) {
            let Some(found) = certify() else { return Fitness { violation: REFUSED, cost } };
            self.budget.found(cost);
            self.best = Some((cost, found));
        }
        Fitness { violation: 0.0, cost }
    }

    /// Whether the budget is spent, or the monitor has stopped it.
    pub(in crate::planners) fn is_over(&self) -> bool {
        self.ended.is_some()
    }

    /// The best certified candidate, and what it took.
    ///
    /// # Errors
    /// [`PlanError::Stopped`] or [`PlanError::NotFoundInBudget`] where there is none.
    pub(in crate::planners) fn end(self) -> Result<(T, Effort), PlanError> {
        match (self.best, self.ended) {
            (Some((_, found)), _) => Ok((found, self.budget.effort())),
            (None, Some(Exhausted::Failed(error))) => Err(error),
            (None, _) => Err(PlanError::NotFoundInBudget { evaluations: self.budget.made() }),
        }
    }
}

/// When a swarm that finds no better candidate is given up.
pub(in crate::planners) struct Stagnation {
    left: usize,
    best: Fitness,
}

impl Stagnation {
    pub(in crate::planners) fn new() -> Self {
        use crate::swarm::Value;
        Self { left: SETTINGS.stagnation, best: Fitness::WORST }
    }

    /// Whether the swarm, whose best is `best` now, is worth another iteration.
    pub(in crate::planners) fn lasts(&mut self, best: Fitness) -> bool {
        use crate::swarm::Value;
        if best.is_better(self.best) {
            *self = Self { left: SETTINGS.stagnation, best };
        }
        self.left = self.left.saturating_sub(1);
        self.left > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swarm_that_finds_nothing_better_is_given_up() {
        let of = |cost: f64| Fitness { violation: 0.0, cost };
        let mut stagnation = Stagnation::new();
        assert!((0..SETTINGS.stagnation - 1).all(|_| stagnation.lasts(of(1.0))));
        assert!(!stagnation.lasts(of(1.0)));
        // Whatever is better gives it as many iterations again.
        let mut stagnation = Stagnation::new();
        assert!((0..10 * SETTINGS.stagnation).all(|i| stagnation.lasts(of(-(i as f64)))));
    }
}
