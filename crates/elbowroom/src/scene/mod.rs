//! What is asked: an arm among obstacles, the grid of its map, and the tasks.

mod file;
mod obstacle;
mod problem;
mod task;

use crate::arm::TwoLinkArm;
use crate::grid::Grid;

pub use file::{Location, Locations, Problem, SceneError, SceneFile, parse};
pub use obstacle::{Obstacle, Shape};
pub use problem::SceneProblem;
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
    /// The scene of these parts.
    ///
    /// # Errors
    /// [`SceneProblem`] for names that come twice, more parts than can be numbered, or a task's place that is no
    /// number.
    pub fn new(
        arm: TwoLinkArm,
        grid: Grid,
        obstacles: Vec<Obstacle>,
        tasks: Vec<Task>,
    ) -> Result<Self, SceneProblem> {
        let scene = Self { arm, grid, obstacles, tasks };
        match problem::first(&scene) {
            Some(problem) => Err(problem),
            None => Ok(scene),
        }
    }

    /// The task called `name`.
    pub fn task(&self, name: &str) -> Option<&Task> {
        self.tasks.iter().find(|task| task.name == name)
    }
}
