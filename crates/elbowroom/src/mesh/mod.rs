//! Shortest paths among walls on flat navigation meshes: convex cells joined along their sides.

mod cells;
mod crossed;
mod geodesic;
mod measure;
mod node;
mod sight;

pub use cells::{Across, MeshError, NavigationMesh, Side};
pub use geodesic::{Geodesic, MeshPoint, geodesic};
pub use measure::Measure;
