//! What planners share that let a particle swarm choose a whole path, or a whole motion, at once.

mod choice;
mod hunt;
mod polyline;
mod track;

pub(super) use choice::Choice;
pub(super) use hunt::{Hunt, Patience};
pub(super) use polyline::{around_straight, certified, places};
pub(super) use track::Track;

/// The most candidates that a planner may be told to judge.
pub(super) const MOST_EVALUATIONS: usize = 1_000_000_000;
