//! What steps of a graph cost.

use super::branch_grid::to_edge;
use crate::arm::{Posture, TwoLink};
use crate::geometry::{Point, Vector};
use crate::mesh::Measure;

/// What is to be little of a path over the graph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StepCost {
    /// Travel of the tip (m).
    Tip,
    /// What the joints turn, as it is measured (rad or s).
    Joints(Measure),
}

impl StepCost {
    /// Of the straight move between two configurations, with the tip where it is there: of the tip's straight way within a posture, and
    /// by way of full stretch or fold between them.
    pub(super) fn between(
        self,
        arm: &TwoLink,
        (a, qa): (Point, &[f64; 2]),
        (b, qb): (Point, &[f64; 2]),
    ) -> f64 {
        match (self, Posture::of(qa), Posture::of(qb)) {
            (Self::Joints(measure), ..) => {
                let [x, y] = arm.difference(qa, qb);
                measure.of(Vector::new(x, y))
            }
            (Self::Tip, Some(pa), Some(pb)) if pa != pb => {
                a.distance(b).max(to_edge(arm, a) + to_edge(arm, b))
            }
            (Self::Tip, ..) => a.distance(b),
        }
    }

    /// What any path between two configurations costs at least.
    pub(super) fn at_least(self, arm: &TwoLink, a: (Point, &[f64; 2]), b: (Point, &[f64; 2])) -> f64 {
        match self {
            Self::Tip => a.0.distance(b.0),
            Self::Joints(_) => self.between(arm, a, b),
        }
    }
}
