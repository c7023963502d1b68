//! Shortest paths among walls on flat surfaces sewn together of convex cells.

mod cells;
mod measure;
mod node;
mod sight;
mod taut;

pub use cells::{Across, Side, Surface, SurfaceError};
pub use measure::Measure;
pub use taut::{SurfacePlace, TautPath, taut_path};
