use thiserror::Error;

use super::{Posture, TwoLink};
use crate::geometry::Point;

/// Rounding allowed between a tip and the edge of the reach, as a share of the reach.
const REACH_ROUNDING: f64 = 1e-12;

/// Why a tip has no configuration in a posture.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum InverseError {
    /// The tip is nearer or farther than the links can put it.
    #[error("tip is {distance} m from the base, but the arm reaches {nearest} m to {farthest} m")]
    OutOfReach {
        /// From base to tip (m).
        distance: f64,
        /// The difference of the link lengths (m).
        nearest: f64,
        /// The sum of the link lengths (m).
        farthest: f64,
    },
    /// The links can put the tip there, but a joint may not turn so far.
    #[error("joint {joint} would have to move to {angle} rad, outside its limits")]
    OutsideJointLimits {
        /// 1 for the joint at the base.
        joint: usize,
        /// Where it would have to stand, in (-π, π] (rad).
        angle: f64,
    },
}

impl TwoLink {
    /// Joint angles in (-π, π] that put the tip at `tip` with the elbow on the `posture` side, whatever
    /// the joint limits: eqs (1) to (4) of the paper, with half angles in place of the cosine rule.
    ///
    /// At the ends of the reach the two postures meet. Close to them the answer is ill-conditioned:
    /// moving the tip by `e` turns the elbow by about `sqrt(e)`. For a tip on the base of an arm with
    /// equal links every direction of the first link would do; one of them is returned.
    ///
    /// # Errors
    /// [`InverseError::OutOfReach`] if no configuration puts the tip there.
    pub fn inverse_unlimited(&self, tip: Point, posture: Posture) -> Result<[f64; 2], InverseError> {
        let [l1, l2] = self.lengths();
        let ray = tip - self.base();
        let distance = ray.length();
        let [nearest, farthest] = self.reach();
        let rounding = REACH_ROUNDING * farthest;
        if !(nearest - rounding..=farthest + rounding).contains(&distance) {
            return Err(InverseError::OutOfReach { distance, nearest, farthest });
        }
        // tan²(q2/2) = short_of_farthest / beyond_nearest: no acos, whose argument rounding can push past 1.
        let short_of_farthest = ((farthest - distance) * (farthest + distance)).max(0.0);
        let beyond_nearest = ((distance - nearest) * (distance + nearest)).max(0.0);
        let bend = 2.0 * libm::atan2(short_of_farthest.sqrt(), beyond_nearest.sqrt());
        let q2 = match posture {
            Posture::ElbowUp => -bend,
            Posture::ElbowDown => bend,
        };
        let (sin, cos) = libm::sincos(q2);
        let q1 = crate::geometry::wrap_angle(ray.angle() - libm::atan2(l2 * sin, l1 + l2 * cos));
        Ok([q1, q2])
    }

    /// Every configuration within the joint limits that puts the tip at `tip` in `posture`: one, or
    /// several where a joint with limits can turn more than once round.
    ///
    /// # Errors
    /// [`InverseError::OutOfReach`] if the links cannot put the tip there;
    /// [`InverseError::OutsideJointLimits`] if this posture's configuration breaks a limit.
    ///
    /// # Example
    /// ```
    /// use elbowroom::arm::{Arm, Joint, Posture};
    /// use elbowroom::geometry::Point;
    ///
    /// let arm = Arm::new(Point::new(0.0, 0.0), vec![0.5, 0.4], 0.0, vec![Joint::CONTINUOUS; 2], false)?;
    /// let arm = arm.two_link().ok_or("two links")?;
    /// let tip = Point::new(0.6, 0.2);
    /// let q = arm.inverse(tip, Posture::ElbowUp)?[0];
    /// assert!(q[1] < 0.0);
    /// assert!(arm.tip(&q).distance(tip) < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse(&self, tip: Point, posture: Posture) -> Result<Vec<[f64; 2]>, InverseError> {
        let q = self.inverse_unlimited(tip, posture)?;
        for (j, joint) in self.joints().iter().enumerate() {
            if joint.limits.places(q[j]).next().is_none() {
                return Err(InverseError::OutsideJointLimits { joint: j + 1, angle: q[j] });
            }
        }
        let [first, second] = self.joints();
        let second = second.limits;
        Ok(first.limits.places(q[0]).flat_map(|q1| second.places(q[1]).map(move |q2| [q1, q2])).collect())
    }
}
