//! Planning while obstacles move.

mod roadmap;

pub use roadmap::{NoRoute, Roadmap, Route, Updated, Upkeep};
