//! Lengths of motions as sums of chords, and how they change with the control points.

use super::control_points::{ControlPoints, weights};
use crate::arm::{Arm, joint_distance};
use crate::trajectory::Motion;

/// Chords of each piece: on pieces that turn by a sixth of a radian in all they are too short by a share of 3e-4.
const CHORDS: usize = 2;

/// What the length of a motion is measured by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Length {
    /// The way of the tip (m).
    Tip,
    /// The way in configuration space (rad).
    Joint,
}

/// A place on the spline between two chords.
pub(super) struct Place {
    pub(super) piece: usize,
    pub(super) share: f64,
    /// Of the tip (m) or of the joints (rad).
    pub(super) at: Vec<f64>,
    /// How each coordinate changes with each joint; `None` where the coordinates are the joints.
    pub(super) jacobian: Option<Vec<Vec<f64>>>,
}

impl Length {
    /// The places between chords of the spline, in order.
    pub(super) fn places(self, arm: &Arm, control: &ControlPoints) -> Vec<Place> {
        let pieces = control.pieces();
        let place = |i: usize| {
            let (piece, share) = match i / CHORDS {
                piece if piece < pieces => (piece, (i % CHORDS) as f64 / CHORDS as f64),
                _ => (pieces - 1, 1.0),
            };
            let q = control.position(piece, share);
            let (at, jacobian) = match self {
                Self::Joint => (q, None),
                Self::Tip => {
                    let (tip, slopes) = (arm.tip(&q), arm.jacobian(&q));
                    let rows = vec![
                        slopes.iter().map(|slope| slope.x).collect(),
                        slopes.iter().map(|slope| slope.y).collect(),
                    ];
                    (vec![tip.x, tip.y], Some(rows))
                }
            };
            Place { piece, share, at, jacobian }
        };
        (0..=pieces * CHORDS).map(place).collect()
    }

    /// Of a motion, exactly.
    pub(super) fn of(self, arm: &Arm, motion: &Motion) -> f64 {
        match self {
            Self::Tip => motion.tip_length(arm),
            Self::Joint => motion.joint_length(),
        }
    }
}

/// The sum of the chords.
pub(super) fn sum_of_chords(places: &[Place]) -> f64 {
    places.windows(2).map(|pair| joint_distance(&pair[0].at, &pair[1].at)).sum()
}

/// The sum of their squares.
pub(super) fn sum_of_squares(places: &[Place]) -> f64 {
    let square = |chord: f64| chord * chord;
    places.windows(2).map(|pair| square(joint_distance(&pair[0].at, &pair[1].at))).sum()
}

/// A sum over `(control point, joint, factor)`, and a constant.
pub(super) type Linear = (Vec<(usize, usize, f64)>, f64);

impl Place {
    /// The coordinates here, linear about the last iterate.
    pub(super) fn linear(&self, control: &ControlPoints) -> Vec<Linear> {
        let weights = weights(self.share);
        let joints = control.joints();
        let coordinate = |c: usize| {
            let mut terms = Vec::with_capacity(4 * joints);
            let mut constant = self.at[c];
            for (k, weight) in weights.iter().enumerate() {
                for j in 0..joints {
                    let slope = match &self.jacobian {
                        None => f64::from(u8::from(j == c)),
                        Some(jacobian) => jacobian[c][j],
                    };
                    let factor = weight * slope;
                    if factor != 0.0 {
                        terms.push((self.piece + k, j, factor));
                        constant -= factor * control.point(self.piece + k)[j];
                    }
                }
            }
            (terms, constant)
        };
        (0..self.at.len()).map(coordinate).collect()
    }
}
