//! Graphs that planners search: free configurations over a grid, one layer per solution branch, and the moves between them.
//!
//! A solution branch is a posture, and for a joint with limits more than a turn apart each turn it can be at.

mod branch_grid;
mod clearance_cache;
mod dynamic_graph;
mod posture_graph;
mod step_cost;
mod union_graph;

pub(crate) use branch_grid::{NodeCache, direct};
pub(crate) use dynamic_graph::{DynamicGraph, Goal};
pub(crate) use posture_graph::PostureGraph;
pub(crate) use step_cost::StepCost;
pub(crate) use union_graph::UnionGraph;
