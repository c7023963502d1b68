use super::PlanError;
use crate::arm::{Configuration, Posture};
use crate::free_space::configurations;
use crate::scene::{Scene, Task, TaskPosture};

/// A task in configurations: any of the starts will do, and any of the goals.
pub(crate) struct Problem {
    pub(crate) starts: Vec<Configuration<2>>,
    pub(crate) goals: Vec<Configuration<2>>,
    /// Whether the posture may change on the way.
    pub(crate) may_flip: bool,
}

impl Problem {
    pub(crate) fn new(scene: &Scene, task: &Task) -> Result<Self, PlanError> {
        let starts = configurations(scene, &task.start).map_err(PlanError::Start)?;
        let mut goals = configurations(scene, &task.goal).map_err(PlanError::Goal)?;
        let wanted = match task.posture {
            TaskPosture::Up => Some(Posture::ElbowUp),
            TaskPosture::Down => Some(Posture::ElbowDown),
            TaskPosture::Any | TaskPosture::Keep => None,
        };
        if let Some(wanted) = wanted {
            // With the links in line it is either posture.
            goals.retain(|q| Posture::of(q).is_none_or(|posture| posture == wanted));
            if goals.is_empty() {
                return Err(PlanError::GoalPosture { wanted });
            }
        }
        Ok(Self { starts, goals, may_flip: task.posture != TaskPosture::Keep })
    }

    /// A start that is a goal already.
    pub(crate) fn already_there(&self) -> Option<Configuration<2>> {
        self.starts.iter().find(|start| self.goals.contains(start)).copied()
    }
}
