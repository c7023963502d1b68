use thiserror::Error;

use super::planar::MOST_LINKS;
use super::{Arm, Configuration, Joint, PlanarArm};
use crate::geometry::{Point, Segment, Vector};

/// Shortest and longest link (m) that arithmetic in f64 can serve with the digits promised.
const LENGTHS: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

/// A planar arm of two links on a fixed base; the links are capsules of one half width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoLinkArm {
    base: Point,
    lengths: [f64; 2],
    half_width: f64,
    joints: [Joint; 2],
}

/// Why no arm has the asked measures.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ArmError {
    /// Fewer links than two, or more than are served.
    #[error("{found} links, 2 to {MOST_LINKS} are allowed")]
    Links {
        /// How many were asked for.
        found: usize,
    },
    /// Another number of joints than of links.
    #[error("{found} joints for {links} links, there must be one for each")]
    Joints {
        /// How many were given.
        found: usize,
        /// How many links there are.
        links: usize,
    },
    /// The links before and after a link touch whatever the joints do.
    #[error(
        "link {link} is {length} m long and {half_width} m in half width: its neighbours, which have to keep clear of \
         each other, always touch"
    )]
    AlwaysTouching {
        /// 1 for the link at the base.
        link: usize,
        /// Its length (m).
        length: f64,
        /// Of all links (m).
        half_width: f64,
    },
    /// A link's length is outside what can be served.
    #[error("link {link} is {length} m long, {} m to {} m are allowed", LENGTHS.start(), LENGTHS.end())]
    Length {
        /// 1 for the link at the base.
        link: usize,
        /// What was asked (m).
        length: f64,
    },
    /// The half width is negative, infinite or not a number.
    #[error("half width is {half_width} m, 0 m to {} m are allowed", LENGTHS.end())]
    HalfWidth {
        /// What was asked (m).
        half_width: f64,
    },
    /// The base is too far from the origin for exact enough coordinates, or not a number.
    #[error("base is at ({x} m, {y} m), coordinates up to {} m are allowed", LENGTHS.end())]
    Base {
        /// What was asked (m).
        x: f64,
        /// What was asked (m).
        y: f64,
    },
}

impl TwoLinkArm {
    /// An arm with its base at `base`, links of `lengths` and `half_width` (m), base first.
    ///
    /// # Errors
    /// [`ArmError`] for measures that are not finite or outside what the arithmetic serves.
    pub fn new(
        base: Point,
        lengths: [f64; 2],
        half_width: f64,
        joints: [Joint; 2],
    ) -> Result<Self, ArmError> {
        check_measures(base, &lengths, half_width)?;
        Ok(Self { base, lengths, half_width, joints })
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
    pub fn elbow(&self, q: &Configuration<2>) -> Point {
        self.base + Vector::polar(self.lengths[0], q.0[0])
    }

    /// Where the end of the second link is at `q` (m): forward kinematics.
    pub fn tip(&self, q: &Configuration<2>) -> Point {
        self.elbow(q) + Vector::polar(self.lengths[1], q.0[0] + q.0[1])
    }

    /// Centre lines of the two links at `q`, base first.
    pub fn links(&self, q: &Configuration<2>) -> [Segment; 2] {
        let (elbow, tip) = (self.elbow(q), self.tip(q));
        [Segment::new(self.base, elbow), Segment::new(elbow, tip)]
    }

    /// Whether every joint may stand where `q` puts it.
    pub fn within_limits(&self, q: &Configuration<2>) -> bool {
        self.joints.iter().zip(q.0).all(|(joint, angle)| joint.limits.contains(angle))
    }
}

impl Arm for TwoLinkArm {
    fn base(&self) -> Point {
        self.base
    }

    fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    fn half_width(&self) -> f64 {
        self.half_width
    }

    fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Two links are neighbours.
    fn self_collision(&self) -> bool {
        false
    }

    fn two_link(&self) -> Option<TwoLinkArm> {
        Some(*self)
    }

    fn planar(&self) -> PlanarArm {
        PlanarArm::from(*self)
    }
}

/// The first of the measures that cannot be served.
pub(super) fn check_measures(base: Point, lengths: &[f64], half_width: f64) -> Result<(), ArmError> {
    if let Some(i) = lengths.iter().position(|l| !LENGTHS.contains(l)) {
        return Err(ArmError::Length { link: i + 1, length: lengths[i] });
    }
    if !(0.0..=*LENGTHS.end()).contains(&half_width) {
        return Err(ArmError::HalfWidth { half_width });
    }
    if !(base.x.abs() <= *LENGTHS.end() && base.y.abs() <= *LENGTHS.end()) {
        return Err(ArmError::Base { x: base.x, y: base.y });
    }
    Ok(())
}
