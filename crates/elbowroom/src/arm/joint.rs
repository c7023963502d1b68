use std::f64::consts::TAU;

use thiserror::Error;

use crate::geometry::{angle_difference, wrap_angle};
use crate::units::{Told, Units};

/// Rounding that inverse kinematics may put between an angle and the limit it lies on (rad).
const LIMIT_ROUNDING: f64 = 1e-12;

/// Widest range of a joint with limits (rad); beyond it angles lose the digits the checks rely on.
const WIDEST_RANGE: f64 = 1e3 * TAU;

/// Most turns that a range may hold: more is angles in another unit, or a joint without limits, and planning time grows with it.
const MOST_TURNS: f64 = 20.0;

/// Where a joint may turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointLimits {
    /// All the way round, again and again: a circle.
    Continuous,
    /// Between two limits, both included: a line. 0 and 2π are then different places.
    Range {
        /// Lower limit (rad).
        min: f64,
        /// Upper limit (rad).
        max: f64,
    },
}

/// Why two numbers are no joint range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum JointLimitsError {
    /// Infinite, not a number, or further than a thousand turns from 0.
    #[error("{}", self.told(Units::SI))]
    OutsideRange {
        /// Lower limit (rad).
        min: f64,
        /// Upper limit (rad).
        max: f64,
    },
    /// More than 20 turns apart.
    #[error("{}", self.told(Units::SI))]
    TooWide {
        /// Lower limit (rad).
        min: f64,
        /// Upper limit (rad).
        max: f64,
    },
    /// The lower limit is above the upper one.
    #[error("{}", self.told(Units::SI))]
    Reversed {
        /// Lower limit (rad).
        min: f64,
        /// Upper limit (rad).
        max: f64,
    },
}

impl Told for JointLimitsError {
    fn told(&self, units: Units) -> String {
        match *self {
            Self::OutsideRange { min, max } => format!(
                "limits are {} to {}, they must lie within a thousand revolutions of 0",
                units.stated_angle(min),
                units.stated_angle(max)
            ),
            Self::TooWide { min, max } => format!(
                "limits from {} to {} are {:.1} revolutions apart, more than 20: are they degrees? A joint without limits is continuous",
                units.stated_angle(min),
                units.stated_angle(max),
                (max - min) / TAU
            ),
            Self::Reversed { min, max } => format!(
                "lower limit {} is above upper limit {}",
                units.stated_angle(min),
                units.stated_angle(max)
            ),
        }
    }
}

impl JointLimits {
    /// The closed range from `min` to `max` (rad).
    ///
    /// # Errors
    /// [`JointLimitsError`] for a reversed range or one that is not finite.
    pub fn range(min: f64, max: f64) -> Result<Self, JointLimitsError> {
        let limits = Self::Range { min, max };
        limits.check().map(|()| limits)
    }

    /// What is wrong with it, if anything: every arm asks.
    pub(super) fn check(&self) -> Result<(), JointLimitsError> {
        match *self {
            Self::Continuous => Ok(()),
            Self::Range { min, max } if !(min.abs() <= WIDEST_RANGE && max.abs() <= WIDEST_RANGE) => {
                Err(JointLimitsError::OutsideRange { min, max })
            }
            Self::Range { min, max } if min > max => Err(JointLimitsError::Reversed { min, max }),
            // 20 turns written in degrees are 20 turns, rounding or not.
            Self::Range { min, max } if (max - min) / TAU > MOST_TURNS + 1e-9 => {
                Err(JointLimitsError::TooWide { min, max })
            }
            Self::Range { .. } => Ok(()),
        }
    }

    /// How far the joint turns from `from` to `to` (rad): along the shorter direction if it is continuous, in (-π, π], else the
    /// plain difference.
    pub fn difference(&self, from: f64, to: f64) -> f64 {
        match self {
            Self::Continuous => angle_difference(from, to),
            Self::Range { .. } => to - from,
        }
    }

    /// `to`, counted on by whole revolutions to where it is nearest to `from` if the joint is continuous (rad).
    pub fn nearest_turn(&self, from: f64, to: f64) -> f64 {
        match self {
            Self::Continuous => from + angle_difference(from, to),
            Self::Range { .. } => to,
        }
    }

    /// Whether the joint may stand at `angle` (rad).
    pub fn contains(&self, angle: f64) -> bool {
        match *self {
            Self::Continuous => angle.is_finite(),
            Self::Range { min, max } => (min..=max).contains(&angle),
        }
    }

    /// Every place where the joint may stand to point in direction `angle` (rad), lowest first.
    ///
    /// A continuous joint has one, in (-π, π]; one with limits has one for each turn that fits between
    /// them. An angle beyond a stop by no more than rounding is put on the stop.
    pub fn places(&self, angle: f64) -> impl ExactSizeIterator<Item = f64> + use<> {
        let (min, max) = match *self {
            Self::Continuous => (-std::f64::consts::PI, std::f64::consts::PI),
            Self::Range { min, max } => (min, max),
        };
        let direction = wrap_angle(angle);
        let single = matches!(self, Self::Continuous);
        let first = if single { 0.0 } else { ((min - LIMIT_ROUNDING - direction) / TAU).ceil() };
        let last = if single { 0.0 } else { ((max + LIMIT_ROUNDING - direction) / TAU).floor() };
        let count = (last - first + 1.0).max(0.0) as usize;
        (0..count).map(move |turn| (direction + TAU * (first + turn as f64)).clamp(min, max))
    }
}

/// The fastest a joint may move; `None` where the user stated no limit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionLimits {
    /// Maximum speed (rad/s).
    pub velocity: Option<f64>,
    /// Maximum acceleration (rad/s²).
    pub acceleration: Option<f64>,
    /// Maximum jerk (rad/s³).
    pub jerk: Option<f64>,
}

/// A limit of a joint's motion that is none.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("limit on {rate} is {value:?}, it must be finite and greater than 0: from 1e-6 to 1e12")]
pub struct MotionLimitError {
    /// `velocity`, `acceleration` or `jerk`.
    pub rate: &'static str,
    /// As given (rad/s, rad/s², rad/s³).
    pub value: f64,
}

impl MotionLimits {
    /// What a limit may be (rad/s, rad/s², rad/s³): beyond it no motor is, and times and their powers lose their digits.
    pub const RATES: std::ops::RangeInclusive<f64> = 1e-6..=1e12;

    /// Refuses rates that are none: every arm asks.
    ///
    /// # Errors
    /// [`MotionLimitError`] names the first that is not finite, or not within [`RATES`](Self::RATES).
    pub fn check(&self) -> Result<(), MotionLimitError> {
        let rates = [("velocity", self.velocity), ("acceleration", self.acceleration), ("jerk", self.jerk)];
        let wrong = |(rate, limit): (&'static str, Option<f64>)| {
            limit.filter(|value| !Self::RATES.contains(value)).map(|value| (rate, value))
        };
        match rates.into_iter().find_map(wrong) {
            Some((rate, value)) => Err(MotionLimitError { rate, value }),
            None => Ok(()),
        }
    }
}

/// One joint of an arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Where it may stand.
    pub limits: JointLimits,
    /// How fast it may move.
    pub motion: MotionLimits,
}

impl Joint {
    /// One that turns without limits, with no limit on its motion stated.
    pub const CONTINUOUS: Self = Self {
        limits: JointLimits::Continuous,
        motion: MotionLimits { velocity: None, acceleration: None, jerk: None },
    };
}
