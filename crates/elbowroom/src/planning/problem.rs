use super::{AssumedLimit, Endpoints, Monitor, PlanError, PlanSettings, motion_limits};
use crate::scene::{Scene, Task, TwoLinkScene};
use crate::trajectory::SpeedLimits;

/// What a planner is given to search: a task in a scene whose obstacles are static, in configurations.
#[non_exhaustive]
pub struct Problem<'a> {
    /// Arm and obstacles.
    pub scene: &'a Scene,
    /// What is asked.
    pub task: &'a Task,
    /// The free configurations it may begin and end in.
    pub endpoints: Endpoints,
    /// Objective, pace and seed.
    pub settings: PlanSettings,
    /// The motion limits of each joint, with [`ASSUMED_LIMITS`](super::ASSUMED_LIMITS) where the scene states none.
    pub limits: Vec<SpeedLimits>,
    /// Those that were assumed.
    pub assumed_limits: Vec<AssumedLimit>,
    /// To be told of stages, and asked every few milliseconds whether to go on.
    pub monitor: &'a dyn Monitor,
}

impl<'a> Problem<'a> {
    /// The problem of `task`.
    pub(super) fn new(
        scene: &'a Scene,
        task: &'a Task,
        settings: &PlanSettings,
        monitor: &'a dyn Monitor,
    ) -> Result<Self, PlanError> {
        let endpoints = Endpoints::new(scene, task, settings.seed, monitor)?;
        let (limits, assumed_limits) = motion_limits(scene.arm());
        Ok(Self { scene, task, endpoints, settings: *settings, limits, assumed_limits, monitor })
    }

    /// The scene with the closed forms of two links.
    ///
    /// # Errors
    /// [`PlanError::OtherArm`] in the name of `planner` where the arm has more links.
    pub fn two_link(&self, planner: &str) -> Result<TwoLinkScene<'a>, PlanError> {
        self.scene.two_link().map_err(|error| PlanError::not_two_link(planner, error))
    }

    /// Whether to go on.
    ///
    /// # Errors
    /// [`PlanError::Stopped`] if not.
    pub fn go_on(&self) -> Result<(), PlanError> {
        if self.monitor.keep_going() { Ok(()) } else { Err(PlanError::Stopped) }
    }
}
