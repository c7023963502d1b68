//! What is kept while obstacles move, against the same from scratch.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "judge/distance.rs"]
mod distance;
mod judge;
#[path = "online/moves.rs"]
mod moves;
#[path = "online/refill.rs"]
mod refill;
#[path = "online/roadmap.rs"]
mod roadmap;
mod worlds;
