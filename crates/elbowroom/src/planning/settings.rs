use super::{Objective, PlanError, is_duration};

/// How long a motion takes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Pace {
    /// As short as the planner finds under the motion limits.
    #[default]
    Fastest,
    /// This long (s).
    Duration(f64),
}

/// How a task is planned, whatever the planner.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlanSettings {
    /// What the choice among paths goes by.
    pub objective: Objective,
    /// How long the motion takes.
    pub pace: Pace,
    /// Of all that is random.
    pub seed: u64,
    /// How far the cost may be above the lower bound, as a share of it, before a planner that searches in rounds stops trying
    /// to do better.
    pub gap: Option<f64>,
}

impl PlanSettings {
    /// Refuses numbers that make no sense.
    pub(super) fn check(&self) -> Result<(), PlanError> {
        if let Some(gap) = self.gap.filter(|gap| gap.is_nan() || *gap < 0.0) {
            return Err(PlanError::Gap { gap });
        }
        match self.pace {
            Pace::Duration(duration) if !is_duration(duration) => Err(PlanError::Duration { duration }),
            _ => Ok(()),
        }
    }
}
