//! Where paths to the goal come from.

use super::world::shifted;
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::planners::certified_path;
use crate::scene::{Course, Mover, Scene};

/// Paths to any of some goals from wherever the arm is.
pub(super) struct Routes {
    scene: Scene,
    goals: Vec<Configuration<2>>,
}

impl Routes {
    pub(super) fn new(scene: Scene, goals: Vec<Configuration<2>>) -> Self {
        Self { scene, goals }
    }

    /// A path past all obstacles as they are at `time` (s), as far as the arm knows; `None` where the grid has none.
    pub(super) fn past_all(
        &mut self,
        movers: &[Mover],
        time: f64,
        from: &Configuration<2>,
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Option<JointPath> {
        let mut scene = self.scene.clone();
        for mover in movers {
            let shape = &self.scene.obstacles[mover.obstacle()].shape;
            scene.obstacles[mover.obstacle()].shape = shifted(shape, mover.course().shift_at(time));
        }
        let absent = |index: usize| {
            movers.iter().any(|mover| mover.obstacle() == index && *mover.course() == Course::Absent)
        };
        without(&mut scene, absent);
        certified_path(&scene, from, &self.goals, keep_going)
    }

    /// A path past the obstacles that stand still.
    pub(super) fn past_still(
        &mut self,
        movers: &[Mover],
        from: &Configuration<2>,
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Option<JointPath> {
        let mut scene = self.scene.clone();
        without(&mut scene, |index| movers.iter().any(|mover| mover.obstacle() == index));
        certified_path(&scene, from, &self.goals, keep_going)
    }
}

fn without(scene: &mut Scene, gone: impl Fn(usize) -> bool) {
    let mut index = 0;
    scene.obstacles.retain(|_| {
        index += 1;
        !gone(index - 1)
    });
}
