use super::problem::{self, SceneProblem};
use super::{Obstacle, Task};
use crate::arm::Arm;
use crate::grid::Grid;

/// An arm among obstacles, with the grid of its map and named tasks.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    arm: Arm,
    grid: Grid,
    obstacles: Vec<Obstacle>,
    tasks: Vec<Task>,
}

impl Scene {
    /// The scene of these parts.
    ///
    /// # Errors
    /// [`SceneProblem`] for names that come twice, more parts than can be numbered, a task's place that is no number, or
    /// one of another arm.
    pub fn new(
        arm: Arm,
        grid: Grid,
        obstacles: Vec<Obstacle>,
        tasks: Vec<Task>,
    ) -> Result<Self, SceneProblem> {
        match problem::first(&arm, &obstacles, &tasks) {
            Some(problem) => Err(problem),
            None => Ok(Self { arm, grid, obstacles, tasks }),
        }
    }

    /// The arm.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// Where the free-space maps have their points.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// What the arm must not touch, in the file's order.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// What is asked of the arm, in the file's order.
    pub fn tasks(&self) -> &[Task] {
        &self.tasks
    }

    /// The task called `name`.
    pub fn task(&self, name: &str) -> Option<&Task> {
        self.tasks.iter().find(|task| task.name == name)
    }

    /// The first obstacle that moves, by its number from 0, if any does.
    pub fn first_moving(&self) -> Option<usize> {
        self.obstacles.iter().position(|obstacle| obstacle.motion.is_some())
    }

    /// The same with another arm.
    ///
    /// # Errors
    /// As [`Scene::new`].
    pub fn with_arm(&self, arm: Arm) -> Result<Self, SceneProblem> {
        Self::new(arm, self.grid, self.obstacles.clone(), self.tasks.clone())
    }

    /// The same over another grid.
    #[must_use]
    pub fn with_grid(&self, grid: Grid) -> Self {
        Self { grid, ..self.clone() }
    }

    /// The same with other obstacles.
    ///
    /// # Errors
    /// As [`Scene::new`].
    pub fn with_obstacles(&self, obstacles: Vec<Obstacle>) -> Result<Self, SceneProblem> {
        Self::new(self.arm.clone(), self.grid, obstacles, self.tasks.clone())
    }

    /// The same with other tasks.
    ///
    /// # Errors
    /// As [`Scene::new`].
    pub fn with_tasks(&self, tasks: Vec<Task>) -> Result<Self, SceneProblem> {
        Self::new(self.arm.clone(), self.grid, self.obstacles.clone(), tasks)
    }

    /// Obstacles of this scene in other places, or with their motion known otherwise: names are as they were.
    pub(crate) fn obstacles_mut(&mut self) -> &mut [Obstacle] {
        &mut self.obstacles
    }
}
