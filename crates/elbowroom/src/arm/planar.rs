use super::two_link::check_measures;
use super::{Arm, ArmError, Joint, TwoLinkArm};
use crate::geometry::{Point, Vector};

/// The most links that are served.
pub const MOST_LINKS: usize = 64;

/// A planar arm of two or more links on a fixed base; the links are capsules of one half width.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarArm {
    base: Point,
    lengths: Vec<f64>,
    half_width: f64,
    joints: Vec<Joint>,
    self_collision: bool,
}

impl PlanarArm {
    /// An arm with its base at `base`, links of `lengths` and `half_width` (m), base first. With `self_collision` links
    /// that are not neighbours must keep clear of each other.
    ///
    /// # Errors
    /// [`ArmError`] for measures that are not finite or outside what the arithmetic serves, for another number of joints
    /// than of links, and for a link so short that its neighbours always touch.
    ///
    /// # Example
    /// ```
    /// use elbowroom::arm::{Arm, Joint, JointLimits, MotionLimits, PlanarArm};
    /// use elbowroom::geometry::Point;
    ///
    /// let free = Joint { limits: JointLimits::Continuous, motion: MotionLimits::default() };
    /// let arm = PlanarArm::new(Point::new(0.0, 0.0), vec![0.3, 0.3, 0.2], 0.01, vec![free; 3], true)?;
    /// assert!(arm.tip_at(&[0.0, 0.0, 0.0]).distance(Point::new(0.8, 0.0)) < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        base: Point,
        lengths: Vec<f64>,
        half_width: f64,
        joints: Vec<Joint>,
        self_collision: bool,
    ) -> Result<Self, ArmError> {
        if !(2..=MOST_LINKS).contains(&lengths.len()) {
            return Err(ArmError::Links { found: lengths.len() });
        }
        if joints.len() != lengths.len() {
            return Err(ArmError::Joints { found: joints.len(), links: lengths.len() });
        }
        check_measures(base, &lengths, half_width)?;
        let between = 1..lengths.len() - 1;
        if let Some(link) = between.filter(|_| self_collision).find(|&i| lengths[i] <= 2.0 * half_width) {
            return Err(ArmError::AlwaysTouching { link: link + 1, length: lengths[link], half_width });
        }
        Ok(Self { base, lengths, half_width, joints, self_collision })
    }

    /// How the tip moves (m/rad) with each joint at `q` (rad), base first: the columns of the Jacobian.
    pub fn jacobian(&self, q: &[f64]) -> Vec<Vector> {
        let tip = self.tip_at(q);
        let pivots = std::iter::once(self.base).chain(self.link_ends(q)).take(self.lengths.len());
        pivots.map(|pivot| tip - pivot).map(|arm| Vector::new(-arm.y, arm.x)).collect()
    }

    /// Least and greatest distance from base to tip that the links allow, whatever the joint limits (m).
    pub fn reach(&self) -> [f64; 2] {
        let sum: f64 = self.lengths.iter().sum();
        let longest = self.lengths.iter().copied().fold(0.0, f64::max);
        [(2.0 * longest - sum).max(0.0), sum]
    }
}

impl Arm for PlanarArm {
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

    fn self_collision(&self) -> bool {
        self.self_collision
    }

    fn two_link(&self) -> Option<TwoLinkArm> {
        let lengths = <[f64; 2]>::try_from(self.lengths.as_slice()).ok()?;
        let joints = <[Joint; 2]>::try_from(self.joints.as_slice()).ok()?;
        TwoLinkArm::new(self.base, lengths, self.half_width, joints).ok()
    }

    fn planar(&self) -> PlanarArm {
        self.clone()
    }
}

impl From<TwoLinkArm> for PlanarArm {
    fn from(arm: TwoLinkArm) -> Self {
        Self {
            base: arm.base(),
            lengths: arm.lengths().to_vec(),
            half_width: arm.half_width(),
            joints: arm.joints().to_vec(),
            self_collision: false,
        }
    }
}
