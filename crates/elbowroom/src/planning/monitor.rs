/// A part of the work, in the order of the data flow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// What no motion can cost less than.
    Bound,
    /// The map of where the tip may stand.
    FreeSpace,
    /// D* from the goal.
    CostToGo,
    /// Paths over the cost-to-go.
    TipPath,
    /// A configuration for each place of the path.
    JointPath,
    /// Polynomials over time.
    Trajectory,
}

impl Stage {
    /// The word for it in files: `free_space`, `cost_to_go`, ...
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bound => "bound",
            Self::FreeSpace => "free_space",
            Self::CostToGo => "cost_to_go",
            Self::TipPath => "tip_path",
            Self::JointPath => "joint_path",
            Self::Trajectory => "trajectory",
        }
    }
}

/// The caller's view of a plan in the making. The core has no clock: who wants times or a timeout measures
/// here.
pub trait Monitor: Sync {
    /// `stage` begins; the one before it is done.
    fn stage(&self, stage: Stage);

    /// Whether to go on. Asked every few milliseconds; after `false` the planner returns without a plan.
    fn keep_going(&self) -> bool;
}

/// Nobody watches, nothing stops it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Monitor for Unwatched {
    fn stage(&self, _stage: Stage) {}

    fn keep_going(&self) -> bool {
        true
    }
}
