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
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// How much longer than the shortest a motion may be to be faster, as a share, where tip or joint travel counts.
    pub slack: f64,
    /// The clearance that the motion keeps (m); `None` for that of its task.
    pub clearance: Option<f64>,
}

/// How much longer than the shortest a motion may be to be faster, where nothing else is asked, as a share.
pub const SLACK: f64 = 0.005;

impl Default for PlanSettings {
    fn default() -> Self {
        Self {
            objective: Objective::default(),
            pace: Pace::default(),
            seed: 0,
            gap: None,
            slack: SLACK,
            clearance: None,
        }
    }
}

impl PlanSettings {
    /// Refuses numbers that make no sense.
    pub(super) fn check(&self) -> Result<(), PlanError> {
        if let Some(gap) = self.gap.filter(|gap| gap.is_nan() || *gap < 0.0) {
            return Err(PlanError::Gap { gap });
        }
        if !(self.slack >= 0.0 && self.slack.is_finite()) {
            return Err(PlanError::Slack { slack: self.slack });
        }
        match self.pace {
            Pace::Duration(duration) if !is_duration(duration) => Err(PlanError::Duration { duration }),
            _ => Ok(()),
        }
    }
}
