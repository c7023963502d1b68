use thiserror::Error;

use super::joint::{JointLimitsError, MotionLimitError};
use super::measures::{LENGTHS, MOST_LINKS};
use crate::units::{Told, Units};

/// Why no arm has the asked measures.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
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
    /// A joint's range is none.
    #[error("{}", self.told(Units::SI))]
    JointLimits {
        /// 1 for the joint at the base.
        joint: usize,
        /// What is wrong with it.
        error: JointLimitsError,
    },
    /// A joint's greatest velocity, acceleration or jerk is none.
    #[error("joint {joint}: {error}")]
    MotionLimit {
        /// 1 for the joint at the base.
        joint: usize,
        /// What is wrong with it.
        error: MotionLimitError,
    },
    /// The links before and after a link touch whatever the joints do.
    #[error("{}", self.told(Units::SI))]
    AlwaysTouching {
        /// 1 for the link at the base.
        link: usize,
        /// Its length (m).
        length: f64,
        /// Of all links (m).
        half_width: f64,
    },
    /// A link's length is outside what can be served.
    #[error("{}", self.told(Units::SI))]
    Length {
        /// 1 for the link at the base.
        link: usize,
        /// What was asked (m).
        length: f64,
    },
    /// The half width is negative, infinite or not a number.
    #[error("{}", self.told(Units::SI))]
    HalfWidth {
        /// What was asked (m).
        half_width: f64,
    },
    /// The base is too far from the origin for exact enough coordinates, or not a number.
    #[error("{}", self.told(Units::SI))]
    Base {
        /// What was asked (m).
        x: f64,
        /// What was asked (m).
        y: f64,
    },
}

impl Told for ArmError {
    fn told(&self, units: Units) -> String {
        let length = |metres| units.stated_length(metres);
        match *self {
            Self::JointLimits { joint, error } => format!("joint {joint}: {}", error.told(units)),
            Self::AlwaysTouching { link, length: long, half_width } => format!(
                "link {link} is {} long and {} in half width: its neighbours, which have to keep clear of each other, always \
                 touch",
                length(long),
                length(half_width)
            ),
            Self::Length { link, length: long } => format!(
                "link {link} is {} long, {} to {} are allowed",
                length(long),
                length(*LENGTHS.start()),
                length(*LENGTHS.end())
            ),
            Self::HalfWidth { half_width } => {
                format!("half width is {}, 0 to {} are allowed", length(half_width), length(*LENGTHS.end()))
            }
            Self::Base { x, y } => {
                format!(
                    "base is at {}, coordinates up to {} are allowed",
                    units.place(x, y),
                    length(*LENGTHS.end())
                )
            }
            Self::Links { .. } | Self::Joints { .. } | Self::MotionLimit { .. } => self.to_string(),
        }
    }
}
