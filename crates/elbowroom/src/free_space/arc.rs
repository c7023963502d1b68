use std::f64::consts::{PI, TAU};

use crate::arm::JointLimits;
use crate::geometry::Vector;

/// The directions a joint with limits may point in, less than a whole revolution, asked without an angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    from: Vector,
    to: Vector,
    wide: bool,
}

impl Arc {
    /// The arc of `limits`; `None` where they allow every direction.
    pub(super) fn of(limits: &JointLimits) -> Option<Self> {
        match *limits {
            JointLimits::Range { min, max } if max - min < TAU => Some(Self {
                from: Vector::polar(1.0, min),
                to: Vector::polar(1.0, max),
                wide: max - min > PI,
            }),
            _ => None,
        }
    }

    /// How far inside the arc the unit vector (`x`, `y`) points, negative outside.
    ///
    /// Above `s`, for any `s` of 0 to 1, every direction within `s` (rad) of it is inside; below `-s`, outside.
    #[inline(always)]
    pub(super) fn measure(&self, x: f64, y: f64) -> f64 {
        let after_from = self.from.x * y - self.from.y * x;
        let before_to = x * self.to.y - y * self.to.x;
        if (after_from < before_to) == self.wide { before_to } else { after_from }
    }
}
