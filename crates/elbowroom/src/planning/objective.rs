use crate::arm::Arm;
use crate::path::JointPath;
use crate::trajectory::Motion;

/// What a motion shall cost little of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
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
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Tip, Self::Joint, Self::Time];

    /// The word for it in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tip => "tip",
            Self::Joint => "joint",
            Self::Time => "time",
        }
    }

    /// What it is measured in.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Tip => "m",
            Self::Joint => "rad",
            Self::Time => "s",
        }
    }

    /// What `motion` costs (m, rad or s).
    pub fn of_motion(self, arm: &Arm, motion: &Motion) -> f64 {
        match self {
            Self::Tip => motion.tip_length(arm),
            Self::Joint => motion.joint_length(),
            Self::Time => motion.duration(),
        }
    }

    /// What straight moves along `path` cost (m or rad), stops at its corners included; `None` for time, which the path does not
    /// tell.
    pub fn of_path(self, arm: &Arm, path: &JointPath) -> Option<f64> {
        match self {
            Self::Tip => Some(path.tip_travel(arm)),
            Self::Joint => Some(path.length()),
            Self::Time => None,
        }
    }
}
