use std::f64::consts::{PI, TAU};

use crate::arm::JointLimits;
use crate::geometry::Vector;

/// How near to the end of an arc a direction is left undecided, as the sine of the angle between them: far
/// wider than any rounding.
const UNDECIDED: f64 = 1e-9;

/// The directions a joint may point in, asked without an angle.
pub(super) enum Arc {
    /// All of them.
    Full,
    /// Counter-clockwise from one direction to another.
    Part { from: Vector, to: Vector, wide: bool },
}

impl Arc {
    pub(super) fn of(limits: &JointLimits) -> Self {
        match *limits {
            JointLimits::Range { min, max } if max - min < TAU => Self::Part {
                from: Vector::polar(1.0, min),
                to: Vector::polar(1.0, max),
                wide: max - min > PI,
            },
            _ => Self::Full,
        }
    }

    /// Whether the arc holds the unit vector `direction`; `None` where it points to the arc's very end.
    pub(super) fn holds(&self, direction: Vector) -> Option<bool> {
        let Self::Part { from, to, wide } = self else { return Some(true) };
        let (after_from, before_to) = (from.cross(direction), direction.cross(*to));
        if (after_from.abs() < UNDECIDED && from.dot(direction) > 0.0)
            || (before_to.abs() < UNDECIDED && to.dot(direction) > 0.0)
        {
            return None;
        }
        Some(if *wide { after_from > 0.0 || before_to > 0.0 } else { after_from > 0.0 && before_to > 0.0 })
    }
}
