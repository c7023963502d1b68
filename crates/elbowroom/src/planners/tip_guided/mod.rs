//! What planners of arms with any number of links share: a guide over the tip's workspace, inverse kinematics by swarm,
//! certified turns.

mod guide;
mod inverse_swarm;
mod lead;
mod shorten;
mod trees;

pub use inverse_swarm::{InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm};

pub(super) use guide::Guide;
pub(super) use lead::Leader;
pub(super) use shorten::{price, shortened};
pub(super) use trees::Trees;
