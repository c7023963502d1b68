//! What planners of arms with any number of links share: a navigation function over the tip's workspace, a local planner that leads the
//! arm along it by certified moves, two trees, and paths made shorter.

mod gather;
mod inverse_swarm;
mod local_planner;
mod navigation;
mod settings;
mod shorten;
mod trees;

pub use inverse_swarm::{InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm};

pub(super) use gather::gather;
pub(super) use local_planner::LocalPlanner;
pub(super) use navigation::NavigationFunction;
pub(super) use trees::Trees;
