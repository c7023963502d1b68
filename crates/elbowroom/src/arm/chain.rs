use super::measures::{LENGTHS, MOST_LINKS};
use super::{ArmError, Configuration, Joint, JointLimits, TwoLink};
use crate::geometry::{Point, Segment, Vector};

/// A planar arm of two or more links end to end on a fixed base: capsules of one half width, a joint at the start of each.
///
/// Positions in configuration space are slices of one joint position each (rad), base first; each joint is measured from
/// the link before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Arm {
    base: Point,
    lengths: Vec<f64>,
    half_width: f64,
    joints: Vec<Joint>,
    self_collision: bool,
}

impl Arm {
    /// An arm with its base at `base`, links of `lengths` and `half_width` (m), base first. With `self_collision` links
    /// that are not neighbours must keep clear of each other.
    ///
    /// # Errors
    /// [`ArmError`] for measures that are not finite or outside what the arithmetic serves, for another number of joints
    /// than of links, for limits of a joint that are none, and for a link so short that its neighbours always touch.
    ///
    /// # Example
    /// ```
    /// use elbowroom::arm::{Arm, Joint};
    /// use elbowroom::geometry::Point;
    ///
    /// let arm = Arm::new(Point::new(0.0, 0.0), vec![0.3, 0.3, 0.2], 0.01, vec![Joint::CONTINUOUS; 3], true)?;
    /// assert!(arm.tip(&[0.0, 0.0, 0.0]).distance(Point::new(0.8, 0.0)) < 1e-15);
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
        for (j, joint) in joints.iter().enumerate() {
            joint.limits.check().map_err(|error| ArmError::JointLimits { joint: j + 1, error })?;
            joint.motion.check().map_err(|error| ArmError::MotionLimit { joint: j + 1, error })?;
        }
        if let Some(i) = lengths.iter().position(|l| !LENGTHS.contains(l)) {
            return Err(ArmError::Length { link: i + 1, length: lengths[i] });
        }
        if !(0.0..=*LENGTHS.end()).contains(&half_width) {
            return Err(ArmError::HalfWidth { half_width });
        }
        if !(base.x.abs() <= *LENGTHS.end() && base.y.abs() <= *LENGTHS.end()) {
            return Err(ArmError::Base { x: base.x, y: base.y });
        }
        let between = 1..lengths.len() - 1;
        if let Some(link) = between.filter(|_| self_collision).find(|&i| lengths[i] <= 2.0 * half_width) {
            return Err(ArmError::AlwaysTouching { link: link + 1, length: lengths[link], half_width });
        }
        Ok(Self { base, lengths, half_width, joints, self_collision })
    }

    /// Where the first joint turns (m).
    pub fn base(&self) -> Point {
        self.base
    }

    /// Length of each link (m), base first.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// How many links there are, and as many joints.
    pub fn links(&self) -> usize {
        self.lengths.len()
    }

    /// Radius of the capsules around the links' centre lines (m).
    pub fn half_width(&self) -> f64 {
        self.half_width
    }

    /// The joints, base first: as many as links.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Whether links that are not neighbours must keep clear of each other.
    pub fn self_collision(&self) -> bool {
        self.self_collision
    }

    /// Least and greatest distance from base to tip that the links allow, whatever the joint limits (m).
    pub fn reach(&self) -> [f64; 2] {
        let sum: f64 = self.lengths.iter().sum();
        let longest = self.lengths.iter().copied().fold(0.0, f64::max);
        [(2.0 * longest - sum).max(0.0), sum]
    }

    /// The closed forms that an arm of two links has; `None` for any other.
    pub fn two_link(&self) -> Option<TwoLink> {
        let lengths = <[f64; 2]>::try_from(self.lengths.as_slice()).ok()?;
        let joints = <[Joint; 2]>::try_from(self.joints.as_slice()).ok()?;
        Some(TwoLink::of(self.base, lengths, self.half_width, joints))
    }

    /// Where the links end at `q` (rad), in order (m): the last is the tip. Forward kinematics.
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    pub fn link_ends(&self, q: &[f64]) -> impl Iterator<Item = Point> {
        self.assert_one_each(q);
        let links = self.lengths.iter().zip(q);
        links.scan((self.base, 0.0), |(end, direction), (&length, angle)| {
            *direction += angle;
            *end = *end + Vector::polar(length, *direction);
            Some(*end)
        })
    }

    /// Where the end of the last link is at `q` (rad) (m).
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    pub fn tip(&self, q: &[f64]) -> Point {
        self.link_ends(q).last().unwrap_or(self.base)
    }

    /// Centre lines of the links at `q` (rad), base first.
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    pub fn link_segments(&self, q: &[f64]) -> impl Iterator<Item = Segment> {
        self.link_ends(q).scan(self.base, |start, end| {
            let segment = Segment::new(*start, end);
            *start = end;
            Some(segment)
        })
    }

    /// How the tip moves (m/rad) with each joint at `q` (rad), base first: the columns of the Jacobian.
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    pub fn jacobian(&self, q: &[f64]) -> Vec<Vector> {
        let tip = self.tip(q);
        let pivots = std::iter::once(self.base).chain(self.link_ends(q)).take(self.lengths.len());
        pivots.map(|pivot| tip - pivot).map(|arm| Vector::new(-arm.y, arm.x)).collect()
    }

    /// Whether `q` (rad) has a position for each joint and every joint may stand there.
    pub fn within_limits(&self, q: &[f64]) -> bool {
        q.len() == self.joints.len()
            && self.joints.iter().zip(q).all(|(joint, &angle)| joint.limits.contains(angle))
    }

    /// `q` (rad) with every joint beyond a stop put on it.
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    #[must_use]
    pub fn clamped(&self, mut q: Configuration) -> Configuration {
        self.assert_one_each(&q);
        for (angle, joint) in q.iter_mut().zip(&self.joints) {
            if let JointLimits::Range { min, max } = joint.limits {
                *angle = angle.clamp(min, max);
            }
        }
        q
    }

    /// How far each joint turns on the shortest straight motion from `from` to `to` (rad): a continuous joint the short way
    /// round, one with limits by the plain difference.
    ///
    /// # Panics
    /// Unless both have a position for each joint.
    pub fn difference(&self, from: &[f64], to: &[f64]) -> Configuration {
        self.assert_one_each(from);
        self.assert_one_each(to);
        let joints = self.joints.iter().zip(from.iter().zip(to));
        joints.map(|(joint, (&from, &to))| joint.limits.difference(from, to)).collect()
    }

    /// `to` with every continuous joint counted on by whole revolutions to where it is nearest to `from` (rad).
    ///
    /// # Panics
    /// Unless both have a position for each joint.
    pub fn nearest_turn(&self, from: &[f64], to: &[f64]) -> Configuration {
        self.assert_one_each(from);
        self.assert_one_each(to);
        let joints = self.joints.iter().zip(from.iter().zip(to));
        joints.map(|(joint, (&from, &to))| joint.limits.nearest_turn(from, to)).collect()
    }

    /// Length of the shortest straight motion from `from` to `to` in configuration space (rad), as
    /// [`difference`](Self::difference) has it.
    ///
    /// # Panics
    /// Unless both have a position for each joint.
    pub fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        self.assert_one_each(from);
        self.assert_one_each(to);
        let joints = self.joints.iter().zip(from.iter().zip(to));
        let square = |way: f64| way * way;
        let squares = joints.map(|(joint, (&from, &to))| square(joint.limits.difference(from, to)));
        squares.sum::<f64>().sqrt()
    }

    fn assert_one_each(&self, q: &[f64]) {
        assert_eq!(q.len(), self.joints.len(), "a configuration has one position per joint");
    }
}
