/// What a motion shall cost little of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Objective {
    /// Length of the tip's way (m).
    #[default]
    Tip,
    /// Length of the way in configuration space (rad).
    Joint,
    /// Time under the motion limits (s).
    Time,
}

impl Objective {
    /// The word for it in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tip => "tip",
            Self::Joint => "joint",
            Self::Time => "time",
        }
    }
}

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
    /// Seed of the swarm.
    pub seed: u64,
    /// How far the cost may be above the lower bound, as a share of it, before the planner `optimal` stops trying
    /// to do better.
    pub gap: Option<f64>,
}
