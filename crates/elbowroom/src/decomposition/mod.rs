//! Vertical (trapezoidal) cell decomposition of the configuration space of two joints, and of the workspace of the tip: what
//! obstacles and stops leave open of it, a little more or a little less, as a navigation mesh.
//!
//! Slices of the obstacles are exact, and between two slices their edges are nearly straight: few trapezoids are as
//! good as a very fine grid. Why a mesh and not a grid: the shortest path on it is exact, so that its length is a
//! lower bound where the cells cover all that is free, and nearly a plan where they cover only what is free.

mod connect;
mod joint_space;
mod slabs;
mod workspace;

pub(crate) use joint_space::{JointSpaceCells, branch_ranges};
pub(crate) use slabs::Approximation;
pub(crate) use workspace::workspace_cells;
