//! What the search for a shortest path keeps.

use std::cmp::Ordering;

use crate::geometry::Point;

/// A stretch of a side, and the last bend, from which all of it is seen.
#[derive(Clone, Copy)]
pub(super) struct Node {
    /// The cell entered, or the one that holds the goal.
    pub(super) cell: u32,
    /// The side it is entered by; `NONE` at the start.
    pub(super) side: u32,
    /// The stretch of that side, in the cell's plane.
    pub(super) left: Point,
    pub(super) right: Point,
    pub(super) left_vertex: u32,
    pub(super) right_vertex: u32,
    /// The last bend, in the cell's plane, and its vertex.
    pub(super) root: Point,
    pub(super) root_vertex: u32,
    pub(super) cost: f64,
    pub(super) parent: u32,
    /// At which end of the parent's stretch the path bent.
    pub(super) bent: Bent,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Bent {
    No,
    Left,
    Right,
}

/// A node waiting, or the end of a path; the cheapest comes first, then the eldest.
pub(super) struct Waiting {
    pub(super) estimate: f64,
    pub(super) node: u32,
    pub(super) goal: Option<Goal>,
}

#[derive(Clone, Copy)]
pub(super) struct Goal {
    pub(super) point: Point,
    pub(super) bent: Bent,
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.estimate.total_cmp(&self.estimate).then(other.node.cmp(&self.node))
    }
}
