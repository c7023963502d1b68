use std::fmt;

use thiserror::Error;

use super::Location;
use crate::arm::{ArmError, MOST_LINKS};
use crate::geometry::ShapeError;
use crate::grid::GridError;
use crate::scene::{ObstacleMotionError, SceneProblem};

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
        /// In the parser's words.
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
    #[error("missing: {key}")]
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
        allowed: &'static str,
    },
    /// Stops more than 20 turns apart, in the file's unit.
    #[error(
        "{min} to {max} {unit} is {turns:.1} turns, more than 20: is `units.angle` right? A joint without stops is `continuous: true`"
    )]
    LimitsTooWide {
        /// Lower stop.
        min: f64,
        /// Upper stop.
        max: f64,
        /// The file's unit of angles.
        unit: &'static str,
        /// How many turns that is.
        turns: f64,
    },
    /// The lower stop is above the upper one, in the file's unit.
    #[error("min {min} is above max {max}")]
    LimitsReversed {
        /// Lower stop.
        min: f64,
        /// Upper stop.
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
        "corner {second} is corner {first} again; all corners differ, and the last is joined to the first"
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
    #[error(transparent)]
    Motion(#[from] ObstacleMotionError),
    /// The measures of the arm.
    #[error(transparent)]
    Arm(#[from] ArmError),
    /// The measures of an obstacle.
    #[error(transparent)]
    Obstacle(#[from] ShapeError),
    /// The grid.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The parts do not make a scene.
    #[error(transparent)]
    Scene(#[from] SceneProblem),
}

fn in_words(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |key| format!("; did you mean {key}?"))
}
