//! What planners share that let a particle swarm choose a whole path, or a whole motion, at once.

mod endpoint_choice;
mod incumbent;
mod path_objective;
mod polyline;
mod settings;

pub(super) use endpoint_choice::EndpointChoice;
pub(super) use incumbent::{Incumbent, Stagnation};
pub(super) use path_objective::PathObjective;
pub(super) use polyline::{PolylineSwarm, around_straight, search_polylines};

/// The most candidates that a planner may be told to judge.
pub(super) const MOST_EVALUATIONS: usize = 1_000_000_000;
