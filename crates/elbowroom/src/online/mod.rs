//! Planning while the arm moves, among obstacles that move.

mod evasion;
mod evasion_by_sipp;
mod known;
mod placed;
mod replanner;
mod roadmap;
mod routes;
mod safe_intervals;
mod search;
mod settings;
mod sipp;
mod to_goal;
mod traps;
mod update;
mod world;

pub use known::{KnownError, KnownMotion};
pub use replanner::{ReplanError, Replanner, goal_configurations};
pub use roadmap::{Kept, NoRoute, Roadmap, Route, Updated, Upkeep};
pub use update::{Decision, Update};
pub use world::World;
