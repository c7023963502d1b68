use super::Joint;
use crate::geometry::{Point, Segment, Vector};

/// The closed forms of an arm of two links: [`Arm::two_link`](super::Arm::two_link) has them.
///
/// Configurations are pairs of joint positions (rad), base first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoLink {
    base: Point,
    lengths: [f64; 2],
    half_width: f64,
    joints: [Joint; 2],
}

impl TwoLink {
    /// Of measures that an arm has checked.
    pub(super) fn of(base: Point, lengths: [f64; 2], half_width: f64, joints: [Joint; 2]) -> Self {
        Self { base, lengths, half_width, joints }
    }

    /// Where the first joint turns (m).
    pub fn base(&self) -> Point {
        self.base
    }

    /// Length of each link (m), base first.
    pub fn lengths(&self) -> [f64; 2] {
        self.lengths
    }

    /// Radius of the capsules around the links' centre lines (m).
    pub fn half_width(&self) -> f64 {
        self.half_width
    }

    /// The joints, base first.
    pub fn joints(&self) -> &[Joint; 2] {
        &self.joints
    }

    /// Least and greatest distance from base to tip that the links allow, whatever the joint limits (m).
    pub fn reach(&self) -> [f64; 2] {
        let [l1, l2] = self.lengths;
        [(l1 - l2).abs(), l1 + l2]
    }

    /// Where the second joint is at `q` (m).
    pub fn elbow(&self, q: &[f64; 2]) -> Point {
        self.base + Vector::polar(self.lengths[0], q[0])
    }

    /// Where the end of the second link is at `q` (m): forward kinematics.
    pub fn tip(&self, q: &[f64; 2]) -> Point {
        self.elbow(q) + Vector::polar(self.lengths[1], q[0] + q[1])
    }

    /// Centre lines of the two links at `q`, base first.
    pub fn link_segments(&self, q: &[f64; 2]) -> [Segment; 2] {
        let (elbow, tip) = (self.elbow(q), self.tip(q));
        [Segment::new(self.base, elbow), Segment::new(elbow, tip)]
    }

    /// Whether every joint may stand where `q` puts it.
    pub fn within_limits(&self, q: &[f64; 2]) -> bool {
        self.joints.iter().zip(q).all(|(joint, angle)| joint.limits.contains(*angle))
    }

    /// How far each joint turns on the shortest straight motion from `from` to `to` (rad), as
    /// [`Arm::difference`](super::Arm::difference) has it.
    pub fn difference(&self, from: &[f64; 2], to: &[f64; 2]) -> [f64; 2] {
        std::array::from_fn(|j| self.joints[j].limits.difference(from[j], to[j]))
    }
}

/// The pair of positions (rad) at `fraction` of the straight line from `from` to `to`, with no turn taken off.
pub(crate) fn lerp_pair(from: &[f64; 2], to: &[f64; 2], fraction: f64) -> [f64; 2] {
    std::array::from_fn(|j| from[j] + (to[j] - from[j]) * fraction)
}
