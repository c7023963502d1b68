//! What planners of arms with any number of links share: a guide over the tip's workspace, inverse kinematics by swarm,
//! certified turns.

mod inverse_swarm;
mod local_planner;
mod navigation;
mod shorten;
mod trees;

pub use inverse_swarm::{InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm};

pub(super) use local_planner::LocalPlanner;
pub(super) use navigation::NavigationFunction;
pub(super) use shorten::{estimated_cost, shortened};
pub(super) use trees::Trees;
