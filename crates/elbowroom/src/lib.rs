//! Motion planning for planar robot arms.
//!
//! The crate is pure: no files, no clock, no printing, no threads of its own making. Lengths are in
//! metres, angles in radians, times in seconds; positions are in the world frame.
//!
//! Modules import only from those before them:
//! `geometry < surface < grid < search < random < swarm < arm < scene < free_space < path < trajectory < verify < planners < online`.

pub mod arm;
pub mod free_space;
pub mod geometry;
pub mod grid;
pub mod online;
pub mod path;
pub mod planners;
mod random;
pub mod scene;
pub mod search;
pub mod surface;
pub mod swarm;
pub mod trajectory;
pub mod verify;
