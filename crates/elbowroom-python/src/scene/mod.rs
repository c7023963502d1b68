//! A scene and its parts as Python shows them: the core's own values, checked where they are made.

mod arm;
mod configurations;
mod grid;
mod model;
mod motion;
mod obstacle;
mod part;
mod source;
mod task;
mod units;

pub(crate) use arm::{Arm, Joint};
pub(crate) use grid::Grid;
pub(crate) use model::{Scene, scene_again};
pub(crate) use motion::ObstacleMotion;
pub(crate) use obstacle::{Obstacle, add_shapes};
pub(crate) use task::{Configuration, Task};
pub(crate) use units::{Units, measured, stated};
