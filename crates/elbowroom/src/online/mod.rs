//! Planning while the arm moves, among obstacles that move.

mod escape;
mod interval_search;
mod replanner;
mod retreat;
mod roadmap;
mod routes;
mod safe_intervals;
mod search;
mod to_goal;
mod world;

pub use replanner::{Decision, ReplanError, Replanner, Update};
pub use roadmap::{NoRoute, Roadmap, Route, Updated, Upkeep};
pub use world::World;
