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

impl Default for Planner {
    /// The paper's: D* and its swarm.
    fn default() -> Self {
        Self::DstarPso(GuidedSwarmSettings::default())
    }
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
