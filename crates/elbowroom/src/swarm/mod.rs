//! Particle swarms.

mod bounds;
mod guided;
mod neighbours;
mod particles;
mod settings;
mod views;

pub use bounds::{Bounds, BoundsError};
pub use guided::{DrawnPaths, GuidedSwarmError, GuidedSwarmSettings, MAX_CANDIDATES, draw_paths};
pub use particles::{MAX_COORDINATES, Minimum, Swarm, minimise};
pub use settings::{Neighbourhood, SwarmError, SwarmSettings};
pub use views::Terrain;
