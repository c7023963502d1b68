//! Cost-to-go over any graph: D*, which repairs its answer after changes, and Dijkstra's algorithm, which judges it.

mod dijkstra;
mod dstar;
mod first_wave;
mod goal;
mod graph;
mod nodes;
mod open_list;
mod plateaus;
mod ring;

pub use dijkstra::dijkstra;
pub use dstar::{Dstar, NodeState, Progress, Until};
pub use goal::GoalError;
pub use graph::Graph;
pub use plateaus::{PlateauSettings, plateaus};
