//! What is kept while obstacles move, against the same from scratch; what the replanner foresees.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
#[path = "online/foresight.rs"]
mod foresight;
mod judge;
#[path = "online/kept.rs"]
mod kept;
#[path = "online/known.rs"]
mod known;
#[path = "online/moves.rs"]
mod moves;
#[path = "online/refill.rs"]
mod refill;
#[path = "online/roadmap.rs"]
mod roadmap;
mod worlds;
