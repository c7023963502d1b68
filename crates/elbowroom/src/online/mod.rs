//! Planning while the arm moves, among obstacles that move.

mod replanner;
mod roadmap;
mod routes;
mod world;

pub use replanner::{Decision, ReplanError, Replanner, Update};
pub use roadmap::{NoRoute, Roadmap, Route, Updated, Upkeep};
pub use world::World;
