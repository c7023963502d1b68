//! Motion planning for planar robot arms.
//!
//! The crate is pure: no files, no clock, no printing, no threads of its own making. Lengths are in
//! metres, angles in radians, times in seconds; positions are in the world frame.
//!
//! A [`Scene`] is what is asked; [`plan`] makes a [`Plan`] of one of its tasks, whose [`Trajectory`] the verifier has proved to be
//! safe; [`verify`](verify::verify) judges anybody's [`Motion`].
//!
//! ```
//! use elbowroom::planners::DstarPsoPlanner;
//! use elbowroom::planning::{PlanSettings, Unwatched};
//! use elbowroom::{parse, plan};
//!
//! let text = "
//! elbowroom: 1
//! units: {length: cm, angle: deg}
//! arm: {links: [25, 25], joints: [{continuous: true}, {min: -150, max: 150}]}
//! grid: {x: [-50, 50], y: [-50, 50], step: 2}
//! obstacles: [{circle: {center: [22, 22], radius: 5}}]
//! tasks: {first: {start: [40, 10], goal: [-45, -15]}}
//! ";
//! let scene = parse(text, "cell.yaml")?.scene;
//! let task = scene.task("first").ok_or("no such task")?;
//! let plan = plan(&scene, task, &DstarPsoPlanner::default(), &PlanSettings::default(), &Unwatched)?;
//! assert!(plan.trajectory().verdict().is_safe());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Modules import only from those before them:
//! `units < geometry < mesh < grid < search < random < swarm < arm < scene < free_space < path < trajectory < verify < optimise < decomposition < roadmap < planning < planners < online`.

// Sine, logarithm and their like come from `libm`, which is the same everywhere: clippy.toml lists what does not.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod arm;
mod decomposition;
pub mod free_space;
pub mod geometry;
pub mod grid;
pub mod mesh;
pub mod online;
mod optimise;
pub mod path;
pub mod planners;
pub mod planning;
mod random;
mod roadmap;
pub mod scene;
pub mod search;
pub mod swarm;
pub mod trajectory;
pub mod units;
pub mod verify;

pub use arm::{Arm, Configuration};
pub use planning::{Plan, PlanError, Planner, plan};
pub use scene::{Obstacle, Scene, Task, parse};
pub use trajectory::Motion;
pub use verify::{Trajectory, Verdict};
