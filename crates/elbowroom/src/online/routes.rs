//! Where paths to the goal come from.

use super::roadmap::Roadmap;
use super::world::shifted;
use crate::arm::Configuration;
use crate::geometry::Vector;
use crate::path::JointPath;
use crate::planners::PlanError;
use crate::scene::{Course, Mover, Obstacle, Place, Scene, Task, TaskPosture};

/// How far away an obstacle is put that is not there (m): farther than any arm that is served reaches.
const AWAY: f64 = 1e5;

/// Paths to a goal from wherever the arm is, kept up to date while obstacles move.
pub(super) struct Routes {
    /// The obstacles where the scene has them.
    obstacles: Vec<Obstacle>,
    past_all: Roadmap,
    past_still: Roadmap,
}

impl Routes {
    /// For an arm that stands at `start` now and wants to `goal`.
    ///
    /// # Errors
    /// As [`Roadmap::new`].
    pub(super) fn new(scene: &Scene, start: &Configuration<2>, goal: &Place) -> Result<Self, PlanError> {
        let task = Task {
            name: String::new(),
            start: Place::Configuration(start.0.to_vec()),
            goal: goal.clone(),
            posture: TaskPosture::Any,
        };
        let roadmap = || Roadmap::new(scene.clone(), &task);
        Ok(Self { obstacles: scene.obstacles.clone(), past_all: roadmap()?, past_still: roadmap()? })
    }

    /// A path past all obstacles as they are at `time` (s), as far as the arm knows; `None` where the grid has none.
    pub(super) fn past_all(
        &mut self,
        movers: &[Mover],
        time: f64,
        from: &Configuration<2>,
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Option<JointPath> {
        let placed = self.placed(movers, |mover| match mover.course() {
            Course::Absent => Vector::new(AWAY, AWAY),
            course => course.shift_at(time),
        });
        path(&mut self.past_all, placed, from, keep_going)
    }

    /// A path past the obstacles that stand still.
    pub(super) fn past_still(
        &mut self,
        movers: &[Mover],
        from: &Configuration<2>,
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Option<JointPath> {
        let placed = self.placed(movers, |_| Vector::new(AWAY, AWAY));
        path(&mut self.past_still, placed, from, keep_going)
    }

    /// The obstacles, those that move shifted by so much.
    fn placed(&self, movers: &[Mover], shift: impl Fn(&Mover) -> Vector) -> Vec<Obstacle> {
        let mut obstacles = self.obstacles.clone();
        for mover in movers {
            let shape = &self.obstacles[mover.obstacle()].shape;
            obstacles[mover.obstacle()].shape = shifted(shape, shift(mover));
        }
        obstacles
    }
}

fn path(
    roadmap: &mut Roadmap,
    obstacles: Vec<Obstacle>,
    from: &Configuration<2>,
    keep_going: &dyn Fn() -> bool,
) -> Option<JointPath> {
    roadmap.move_obstacles(obstacles);
    roadmap.path_from_until(from, keep_going).ok().map(|route| route.path)
}
