//! What is asked: an arm among obstacles, the grid of its map, and the tasks.

mod obstacle;
mod task;

use crate::arm::TwoLinkArm;
use crate::grid::Grid;

pub use obstacle::{Obstacle, Shape};
pub use task::{Place, Task, TaskPosture};

/// An arm among obstacles, with the grid of its map and named tasks.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The arm.
    pub arm: TwoLinkArm,
    /// Where the free-space maps have their points.
    pub grid: Grid,
    /// What the arm must not touch.
    pub obstacles: Vec<Obstacle>,
    /// What is asked of the arm, in the file's order.
    pub tasks: Vec<Task>,
}

impl Scene {
    /// The task called `name`.
    pub fn task(&self, name: &str) -> Option<&Task> {
        self.tasks.iter().find(|task| task.name == name)
    }
}
