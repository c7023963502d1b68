use crate::arm::{InverseError, Posture};
use crate::geometry::{Point, Segment};
use crate::scene::{Obstacle, TwoLinkScene};

/// Clearance up to which link and obstacle count as touching (m): the floor below which rounding decides.
pub const CONTACT_FLOOR: f64 = 1e-9;

/// Whether the tip may stand somewhere in one posture and, if not, what forbids it.
///
/// Where several things forbid it the first in the order of this list is given, then the lowest joint, link and
/// obstacle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CellState {
    /// Within reach and joint limits, and nothing touched.
    Free,
    /// The links cannot put the tip there.
    OutOfReach,
    /// A joint would have to turn beyond its limits.
    JointLimit {
        /// 1 for the joint at the base.
        joint: u8,
    },
    /// A link would touch an obstacle.
    Collision {
        /// 1 for the link at the base.
        link: u8,
        /// Its place in the scene's list, from 0.
        obstacle: u16,
    },
}

impl CellState {
    /// Whether the tip may stand there.
    pub fn is_free(self) -> bool {
        self == Self::Free
    }
}

/// The state of one place of the tip in `posture`: what a map holds for each of its points, worked out by
/// inverse and forward kinematics.
///
/// The quick way by which maps are filled falls back on this wherever rounding could decide.
pub fn state_of(scene: TwoLinkScene<'_>, tip: Point, posture: Posture) -> CellState {
    match scene.arm().inverse(tip, posture) {
        Err(InverseError::OutOfReach { .. }) => CellState::OutOfReach,
        Err(InverseError::OutsideJointLimits { joint, .. }) => CellState::JointLimit { joint: joint as u8 },
        // Configurations that differ by whole revolutions put the links in the same place.
        Ok(found) => match first_contact(scene, scene.arm().link_segments(&found[0])) {
            None => CellState::Free,
            Some((link, obstacle)) => {
                CellState::Collision { link: link as u8 + 1, obstacle: obstacle as u16 }
            }
        },
    }
}

/// The first link, and its first obstacle, that touch; both from 0.
fn first_contact(scene: TwoLinkScene<'_>, links: [Segment; 2]) -> Option<(usize, usize)> {
    links.into_iter().enumerate().find_map(|(link, segment)| {
        let hit = |obstacle: &Obstacle| touches(scene.arm().half_width(), obstacle, segment);
        scene.obstacles().iter().position(hit).map(|obstacle| (link, obstacle))
    })
}

/// Whether a link of `half_width` (m) with its centre line at `segment` touches `obstacle`.
pub(super) fn touches(half_width: f64, obstacle: &Obstacle, segment: Segment) -> bool {
    obstacle.distance_to_segment(segment) <= half_width + CONTACT_FLOOR
}
