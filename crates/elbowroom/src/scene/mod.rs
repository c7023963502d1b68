//! What is asked: an arm among obstacles, the grid of its map, and the tasks.

mod file;
mod mover;
mod obstacle;
mod problem;
mod task;

use crate::arm::{Arm, PlanarArm, TwoLinkArm};
use crate::grid::Grid;

pub use file::{Location, Locations, Problem, SceneError, SceneFile, parse};
pub use mover::{Course, MOST_WAYPOINTS, Mover, MoverError, Sight, Waypoint};
pub use obstacle::{Obstacle, Shape};
pub use problem::SceneProblem;
pub use task::{Place, Task, TaskPosture};

/// An arm among obstacles, with the grid of its map and named tasks.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene<A = TwoLinkArm> {
    /// The arm.
    pub arm: A,
    /// Where the free-space maps have their points.
    pub grid: Grid,
    /// What the arm must not touch.
    pub obstacles: Vec<Obstacle>,
    /// What is asked of the arm, in the file's order.
    pub tasks: Vec<Task>,
}

impl<A: Arm> Scene<A> {
    /// The scene of these parts.
    ///
    /// # Errors
    /// [`SceneProblem`] for names that come twice, more parts than can be numbered, a task's place that is no number, or
    /// one of another arm.
    pub fn new(arm: A, grid: Grid, obstacles: Vec<Obstacle>, tasks: Vec<Task>) -> Result<Self, SceneProblem> {
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

    /// The same scene for what needs an arm of two links, if it has one.
    pub fn two_link(&self) -> Option<Scene> {
        Some(self.with(self.arm.two_link()?))
    }

    /// The same scene for what takes arms of any number of links.
    pub fn planar(&self) -> Scene<PlanarArm> {
        self.with(self.arm.planar())
    }

    fn with<B>(&self, arm: B) -> Scene<B> {
        let (grid, obstacles, tasks) = (self.grid, self.obstacles.clone(), self.tasks.clone());
        Scene { arm, grid, obstacles, tasks }
    }
}
