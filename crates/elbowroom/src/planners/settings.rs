use super::IkPsoSettings;
use super::swarms::{CbpsoSettings, NscPsoSettings, PsoSettings};
use crate::swarm::GuidedSwarmSettings;

/// How a path is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Planner {
    /// D*'s back-pointers alone, over grid points and postures.
    Dstar,
    /// The best of the paths that the modified lbest swarm draws there; for arms of more than two links, of those that a swarm
    /// follows along D*'s ways over the tip's workspace.
    DstarPso(GuidedSwarmSettings),
    /// Taut paths that leave the grid.
    Optimal,
    /// A plain particle swarm over via points.
    Pso(PsoSettings),
    /// A cultural swarm over quartic and quintic pieces.
    Cbpso(CbpsoSettings),
    /// A swarm over way-points that begins where the straight way is bad.
    NscPso(NscPsoSettings),
    /// Inverse kinematics by a swarm along a tip path, IK-PSO-style.
    IkPso(IkPsoSettings),
}

impl Planner {
    /// The word for it in files and on the command line.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Dstar => "dstar",
            Self::DstarPso(_) => "dstar-pso",
            Self::Optimal => "optimal",
            Self::Pso(_) => "pso",
            Self::Cbpso(_) => "cbpso",
            Self::NscPso(_) => "nsc-pso",
            Self::IkPso(_) => "ik-pso",
        }
    }
}

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

/// How a task is planned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanSettings {
    /// How the path is found.
    pub planner: Planner,
    /// What the choice among paths goes by.
    pub objective: Objective,
    /// How long the motion takes.
    pub pace: Pace,
    /// Seed of the swarm.
    pub seed: u64,
    /// How far the cost may be above the lower bound, as a share of it, before [`Planner::Optimal`] stops trying to
    /// do better.
    pub gap: Option<f64>,
}

impl Default for PlanSettings {
    fn default() -> Self {
        Self {
            planner: Planner::DstarPso(GuidedSwarmSettings::default()),
            objective: Objective::default(),
            pace: Pace::default(),
            seed: 0,
            gap: None,
        }
    }
}
