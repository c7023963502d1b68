//! Where paths to the goal come from.

use super::placed::{AWAY, placed, still};
use super::roadmap::{Kept, Roadmap};
use crate::path::JointPath;
use crate::planning::PlanError;
use crate::scene::{Course, Obstacle, Place, Scene, Task, TaskPosture};

/// Paths to a goal from wherever the arm is, kept up to date while obstacles move.
pub(super) struct Routes {
    past_all: Roadmap,
    past_still: Roadmap,
}

impl Routes {
    /// For an arm that stands at `start` (rad) now and wants to `goal`.
    ///
    /// # Errors
    /// As [`Roadmap::new`].
    pub(super) fn new(scene: &Scene, start: [f64; 2], goal: &Place) -> Result<Self, PlanError> {
        let task = Task {
            name: String::new(),
            start: Place::Configuration(start.into()),
            goal: goal.clone(),
            posture: TaskPosture::Any,
            clearance: 0.0,
        };
        let roadmap = || Roadmap::new(still(scene, |_, _| None), &task);
        Ok(Self { past_all: roadmap()?, past_still: roadmap()? })
    }

    /// What both roadmaps keep.
    pub(super) fn kept(&self) -> [Kept; 2] {
        [self.past_all.kept(), self.past_still.kept()]
    }

    /// A path past all obstacles of `scene` as they are at `time` (s); `None` where the grid has none. The scene may differ
    /// from the one the routes were made for by the motion of its obstacles.
    pub(super) fn past_all(
        &mut self,
        scene: &Scene,
        time: f64,
        from: &[f64; 2],
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Option<JointPath> {
        let obstacles = placed(scene, |_, obstacle| match obstacle.motion.as_ref()?.course() {
            Course::Absent => Some(AWAY),
            course => Some(course.shift_at(time)),
        });
        path(&mut self.past_all, obstacles, from, keep_going)
    }

    /// A path past the static obstacles of `scene`.
    pub(super) fn past_still(
        &mut self,
        scene: &Scene,
        from: &[f64; 2],
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Option<JointPath> {
        let obstacles = placed(scene, |_, obstacle| obstacle.motion.as_ref().map(|_| AWAY));
        path(&mut self.past_still, obstacles, from, keep_going)
    }
}

fn path(
    roadmap: &mut Roadmap,
    obstacles: Vec<Obstacle>,
    from: &[f64; 2],
    keep_going: &dyn Fn() -> bool,
) -> Option<JointPath> {
    roadmap.place_obstacles(obstacles);
    roadmap.path_from_until(from, keep_going).ok().map(|route| route.path)
}
