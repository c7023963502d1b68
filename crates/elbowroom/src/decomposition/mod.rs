//! The plane of both joints, or of the tip, cut into convex cells: what obstacles and stops leave of it, a little more or
//! a little less, as a surface.
//!
//! Slices of the obstacles are exact, and between two slices their edges are nearly straight: few trapezoids are as
//! good as a very fine grid. Why a surface and not a grid: the shortest path on it is exact, so that its length is a
//! lower bound where the cells cover all that is free, and nearly a plan where they cover only what is free.

mod joints;
mod sew;
mod slabs;
mod tips;

pub(crate) use joints::{JointChart, sheet_ranges};
pub(crate) use slabs::Walls;
pub(crate) use tips::tip_chart;
