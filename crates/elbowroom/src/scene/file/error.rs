use std::fmt;

use thiserror::Error;

use super::Location;
use crate::arm::{ArmError, MOST_LINKS};
use crate::geometry::ShapeError;
use crate::grid::GridError;
use crate::scene::{ObstacleMotionError, SceneProblem};
use crate::units::{Told, Units};

/// Why a text is no scene: what is wrong, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError {
    /// What the text is called.
    pub file: String,
    /// Where; `None` when it is about the text as a whole.
    pub location: Option<Location>,
    /// The path to the part, such as `arm.joints[1].min`; empty for the whole.
    pub key: String,
    /// What is wrong.
    pub problem: ParseProblem,
}

impl std::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some(Location { line, column }) = self.location {
            write!(f, ":{line}:{column}")?;
        }
        if !self.key.is_empty() {
            write!(f, ": {}", self.key)?;
        }
        write!(f, ": {}", self.problem)
    }
}

/// What is wrong with a part of a scene file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ParseProblem {
    /// No YAML.
    #[error("not YAML: {message}")]
    Syntax {
        /// In words.
        message: String,
    },
    /// Nothing there.
    #[error("the file is empty")]
    Empty,
    /// A second document begins.
    #[error("a second document begins; a scene file has one")]
    SecondDocument,
    /// More text than is read.
    #[error("{bytes} bytes; a scene file has at most {most}")]
    TooLarge {
        /// How much there is.
        bytes: usize,
        /// How much is allowed.
        most: usize,
    },
    /// More values than are read, or lists in lists in lists.
    #[error("more than {most} {what}")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many are allowed.
        most: usize,
    },
    /// An anchor, an alias or a tag.
    #[error("anchors, aliases and tags are not read; write the value out")]
    NotPlain,
    /// Another version of the format.
    #[error("found {found}; this elbowroom reads version {read} of the format")]
    Version {
        /// What is written.
        found: String,
        /// The one that is read.
        read: &'static str,
    },
    /// A key of a mapping that is no text.
    #[error("a key is {found}; keys are plain text")]
    KeyShape {
        /// What it is.
        found: &'static str,
    },
    /// A key comes twice.
    #[error("the key was given before, in line {}", first.line)]
    DuplicateKey {
        /// Where it came first.
        first: Location,
    },
    /// A key that the format does not have.
    #[error("no such key; known here: {}{}", known.join(", "), in_words(*suggestion))]
    UnknownKey {
        /// Those it has.
        known: Vec<&'static str>,
        /// The one that was meant, probably.
        suggestion: Option<&'static str>,
    },
    /// A key that has to be there.
    #[error("missing: {key}{}", add(key))]
    MissingKey {
        /// Which.
        key: &'static str,
    },
    /// Another kind of value.
    #[error("found {found}; allowed: {allowed}")]
    Shape {
        /// What it is.
        found: String,
        /// What it has to be.
        allowed: String,
    },
    /// Infinite, not a number, or beyond what a number can hold.
    #[error("found {found}; numbers must be finite")]
    NotFinite {
        /// What is written.
        found: String,
    },
    /// A number that is too small or too large.
    #[error("found {found}; allowed: {allowed}")]
    OutOfRange {
        /// What is written.
        found: String,
        /// What it has to be.
        allowed: Box<str>,
    },
    /// Limits more than 20 turns apart, in the file's unit.
    #[error(
        "{min} to {max} {unit} is {turns:.1} revolutions, more than 20: is `units.angle` right? A joint without limits is `continuous: true`"
    )]
    LimitsTooWide {
        /// Lower limit.
        min: f64,
        /// Upper limit.
        max: f64,
        /// The file's unit of angles.
        unit: &'static str,
        /// How many turns that is.
        turns: f64,
    },
    /// The lower limit is above the upper one, in the file's unit.
    #[error("min {min} is above max {max}")]
    LimitsReversed {
        /// Lower limit.
        min: f64,
        /// Upper limit.
        max: f64,
    },
    /// Fewer links than two, or more than are served.
    #[error("{found} given; an arm has 2 to {MOST_LINKS} links")]
    Links {
        /// How many.
        found: usize,
    },
    /// Not one joint per link.
    #[error("{found} given for {links} links; every link has one joint")]
    Joints {
        /// How many joints.
        found: usize,
        /// How many links.
        links: usize,
    },
    /// Two neighbouring corners of a polygon, the last and the first among them, are one.
    #[error(
        "corner {} is corner {} again; all corners differ, and the last is joined to the first",
        second + 1,
        first + 1
    )]
    CornerTwice {
        /// A corner, from 0.
        first: usize,
        /// The same once more.
        second: usize,
    },
    /// No shape, or more than one.
    #[error("an obstacle is one of {}; found {found}", known.join(", "))]
    OneShape {
        /// Those there are.
        known: Vec<&'static str>,
        /// Which are there.
        found: &'static str,
    },
    /// How an obstacle moves.
    #[error("{}", .0.told(*.1))]
    Motion(ObstacleMotionError, Units),
    /// The measures of the arm.
    #[error("{}", .0.told(*.1))]
    Arm(Box<ArmError>, Units),
    /// The measures of an obstacle.
    #[error("{}", .0.told(*.1))]
    Obstacle(ShapeError, Units),
    /// The grid.
    #[error("{}", .0.told(*.1))]
    Grid(GridError, Units),
    /// The parts do not make a scene.
    #[error(transparent)]
    Scene(#[from] SceneProblem),
}

impl ParseProblem {
    /// The same, told in `units`.
    pub(super) fn in_units(self, units: Units) -> Self {
        match self {
            Self::Motion(error, _) => Self::Motion(error, units),
            Self::Arm(error, _) => Self::Arm(error, units),
            Self::Obstacle(error, _) => Self::Obstacle(error, units),
            Self::Grid(error, _) => Self::Grid(error, units),
            other => other,
        }
    }
}

impl From<ObstacleMotionError> for ParseProblem {
    fn from(error: ObstacleMotionError) -> Self {
        Self::Motion(error, Units::SI)
    }
}

impl From<ArmError> for ParseProblem {
    fn from(error: ArmError) -> Self {
        Self::Arm(Box::new(error), Units::SI)
    }
}

impl From<ShapeError> for ParseProblem {
    fn from(error: ShapeError) -> Self {
        Self::Obstacle(error, Units::SI)
    }
}

impl From<GridError> for ParseProblem {
    fn from(error: GridError) -> Self {
        Self::Grid(error, Units::SI)
    }
}

fn in_words(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |key| format!("; did you mean {key}?"))
}

/// What to write where a key is missing that newcomers do not know of.
fn add(key: &str) -> &'static str {
    match key {
        "elbowroom" => "; add the version of the format as the first line, elbowroom: 1",
        "units" => "; add what the numbers mean, such as units: {length: mm, angle: deg}",
        "grid" => {
            "; add the points of the free-space map, such as grid: {x: [-700, 700], y: [-700, 700], step: 10}"
        }
        _ => "",
    }
}
