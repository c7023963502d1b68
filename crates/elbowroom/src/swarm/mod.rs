//! Particle swarms.

mod bounds;
mod cultural;
mod guided;
mod neighbours;
mod particles;
mod settings;
mod value;
mod views;

pub use bounds::{Bounds, BoundsError, MAX_COORDINATES};
pub use cultural::{CulturalError, CulturalSettings, CulturalSwarm};
pub use guided::{DrawnPaths, GuidedSwarmError, GuidedSwarmSettings, MAX_CANDIDATES, draw_paths};
pub use particles::{Minimum, Swarm, minimise};
pub use settings::{Neighbourhood, SwarmError, SwarmSettings};
pub use value::{Fitness, Value};
pub use views::Terrain;
