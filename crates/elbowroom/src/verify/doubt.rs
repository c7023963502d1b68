//! What a verdict on rows leaves open, and what it lets pass.

use super::rate::{Quantity, Rate};
use crate::units::{Units, seconds, short};

/// A rate that the rows do not tell well enough to be judged against its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unjudged {
    /// Which joint, 1 for the one at the base.
    pub joint: usize,
    /// Of what.
    pub rate: Rate,
    /// What is allowed, without tolerance.
    pub limit: f64,
    /// Any motion through the rows reaches this much somewhere, within their rounding.
    pub at_least: f64,
    /// Why.
    pub cause: Unknown,
}

/// Why a rate is not known well enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unknown {
    /// The rows are rounded.
    Rounding {
        /// What of them matters the most.
        what: Quantity,
        /// To multiples of what it is rounded (rad, rad/s, rad/s²).
        quantum: f64,
        /// How far apart the rows are (s), where it matters the most.
        spacing: f64,
        /// How far off the rate may be for that.
        error: f64,
    },
    /// What the joint does between the rows is a guess, and the guess is beyond the limit.
    Spacing {
        /// How far apart the rows are (s).
        spacing: f64,
        /// What the curve between the rows reaches; `None` where the rate below it jumps.
        reached: Option<f64>,
    },
}

/// What is beyond a limit, and passed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowed {
    /// Which joint, 1 for the one at the base.
    pub joint: usize,
    /// Of what; `None` for its position, against a joint limit.
    pub rate: Option<Rate>,
    /// What the curve between the rows reaches.
    pub value: f64,
    /// What is allowed, without tolerance.
    pub limit: f64,
    /// For what it passed.
    pub by: Allowance,
}

/// For what a value beyond a limit passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Allowance {
    /// The rounding of the rows.
    Rounding,
    /// No motion through the rows has to reach it, and the curve between them that does is a guess.
    Spacing,
    /// The tolerance that was asked for.
    Tolerance,
}

impl Unjudged {
    /// In words and in `units`.
    pub fn told(&self, units: Units) -> String {
        let (joint, rate, order) = (self.joint, self.rate.name(), self.rate.order());
        let limit = units.rate(self.limit, order);
        let known = if self.at_least > 0.0 {
            format!("the rows alone need {} of {limit}", units.rate(self.at_least, order))
        } else {
            format!("{limit} are allowed")
        };
        match self.cause {
            Unknown::Rounding { what, quantum, spacing, error } => {
                let to =
                    if quantum > 0.0 { units.rate(quantum, what.order()) } else { "a double".to_owned() };
                let name = what.plural();
                let (apart, error) = (milliseconds(spacing), units.rate(error, order));
                format!(
                    "{rate} of joint {joint}: {name} rounded to {to}, {apart} apart, leave it uncertain by {error}; {known}"
                )
            }
            Unknown::Spacing { spacing, reached } => {
                let guess = reached.map_or_else(String::new, |reached| {
                    format!(" (the curve between them reaches {})", units.rate(reached, order))
                });
                format!(
                    "{rate} of joint {joint}: rows {} apart do not tell it{guess}; {known}",
                    milliseconds(spacing)
                )
            }
        }
    }
}

impl Allowed {
    /// In words and in `units`.
    pub fn told(&self, units: Units) -> String {
        let name = self.rate.map_or("position", Rate::name);
        let [value, limit] = units.beside_limit(self.value, self.limit, self.rate.map_or(0, Rate::order));
        let why = match self.by {
            Allowance::Rounding => "within the rounding of the rows",
            Allowance::Spacing => "by the curve between the rows alone, which is a guess",
            Allowance::Tolerance => "within the tolerance asked for",
        };
        format!("the {name} of joint {} is up to {value}, {limit} are allowed: {why}", self.joint)
    }
}

impl Unknown {
    /// The word for it.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Rounding { .. } => "rounding",
            Self::Spacing { .. } => "spacing",
        }
    }
}

impl Allowance {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rounding => "rounding",
            Self::Spacing => "spacing",
            Self::Tolerance => "tolerance",
        }
    }
}

fn milliseconds(time: f64) -> String {
    if time < 1.0 { format!("{} ms", short(time * 1e3)) } else { seconds(time) }
}
