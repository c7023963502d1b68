use thiserror::Error;

use super::joint::{JointLimitsError, MotionLimitError};
use super::measures::{LENGTHS, MOST_LINKS};

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
    #[error("joint {joint}: {error}")]
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
