//! Planners that let a particle swarm choose a whole path, or a whole motion, at once.

mod cbpso;
mod choice;
mod hunt;
mod nsc_pso;
mod polyline;
mod pso;
mod task;
mod track;

pub use cbpso::CbpsoSettings;
pub use nsc_pso::{Initialisation, NscPsoSettings};
pub use pso::PsoSettings;

pub(super) use cbpso::plan as cbpso;
pub(super) use nsc_pso::plan as nsc_pso;
pub(super) use pso::plan as pso;
pub(super) use task::plan;
