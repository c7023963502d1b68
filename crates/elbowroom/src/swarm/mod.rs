//! Particle swarms.

mod guided;

pub use guided::{DrawnPaths, GuidedSwarmError, GuidedSwarmSettings, MAX_CANDIDATES, Terrain, draw_paths};
