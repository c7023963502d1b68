//! Planning while the arm moves, among obstacles that move.

mod replanner;
mod routes;
mod world;

pub use replanner::{Decision, ReplanError, Replanner, Update};
pub use world::World;
