//! What is asked: an arm among obstacles, the grid of its map, and the tasks.

mod clearance;
mod file;
mod model;
mod motion;
mod obstacle;
mod problem;
mod task;
mod two_link;

pub use file::{Location, Locations, ParseProblem, SceneError, SceneFile, parse};
pub use model::Scene;
pub use motion::{Course, MOST_WAYPOINTS, ObstacleMotion, ObstacleMotionError, Sight, Waypoint};
pub use obstacle::{Obstacle, obstacle_in_words};
pub use problem::SceneProblem;
pub use task::{Place, Task, TaskPosture};
pub use two_link::{TwoLinkError, TwoLinkScene};
