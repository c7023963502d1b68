use thiserror::Error;

use super::doubt::{Allowed, Unjudged};
use super::rate::{Quantity, Rate};
use crate::scene::{Scene, obstacle_in_words};
use crate::units::{Units, apart, seconds};

/// What is penetrated by less (m) is touched: the floor of contact, rounding aside.
const TOUCH: f64 = 1e-8;

/// What the verifier found: it alone makes one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Verdict {
    /// Why the motion is not safe, in order of time; none when it is. Of every kind at most one per joint, or
    /// per link and what it must not touch.
    pub violations: Vec<Violation>,
    /// The nearest that a link comes to what it must not touch; `None` where there is nothing of the kind.
    pub least_clearance: Option<Clearance>,
    /// How near each joint comes to its limits, base first; `None` for a continuous joint.
    pub joint_margins: Vec<Option<JointMargin>>,
    /// The fastest of each joint, base first.
    pub motion_margins: Vec<MotionMargins>,
    /// When the elbow of an arm of two links changes sides (s), ascending; the first
    /// [`super::MOST_POSTURE_CHANGES`] of them. In a continuous motion this happens at full stretch or fold only.
    pub posture_changes: Vec<f64>,
    /// Rates that have a limit and were not judged, as the rows of the motion do not tell them well enough.
    pub unjudged: Vec<Unjudged>,
    /// What is beyond a limit, and passed for the rounding of the rows, their spacing, or the tolerance asked for.
    pub allowed: Vec<Allowed>,
}

impl Verdict {
    /// Whether the motion is proved to be safe, in all that was judged: see [`Verdict::unjudged`].
    pub fn is_safe(&self) -> bool {
        self.violations.is_empty()
    }
}

/// What a link must not touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Against {
    /// An obstacle, by its place among the scene's, from 0.
    Obstacle(usize),
    /// A link that is no neighbour, 1 for the one at the base.
    Link(usize),
}

impl Against {
    /// What texts call it: obstacles by their number from 1 and their name in `scene`, if it is known.
    pub fn in_words(self, scene: Option<&Scene>) -> String {
        match self {
            Self::Obstacle(index) => {
                let obstacle = scene.and_then(|scene| scene.obstacles().get(index));
                obstacle_in_words(index, obstacle.and_then(|obstacle| obstacle.name.as_deref()))
            }
            Self::Link(link) => format!("link {link}"),
        }
    }
}

/// The nearest that a link comes to what it must not touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// Between the link's outside and the other (m); below 0 the depth.
    pub distance: f64,
    /// Proved: at no time is any link nearer to anything it must not touch than this (m). No more than 1e-6 m or 1 % below
    /// `distance`, unless the budget ran out; `None` when the motion touches an obstacle or is not proved not to.
    pub at_least: Option<f64>,
    /// When (s).
    pub time: f64,
    /// 1 for the link at the base.
    pub link: usize,
    /// To what.
    pub against: Against,
}

/// How near a joint comes to its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMargin {
    /// To the nearer limit (rad); below 0 beyond it.
    pub distance: f64,
    /// When (s).
    pub time: f64,
}

/// The greatest absolute rates of one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionMargins {
    /// Of velocity (rad/s).
    pub velocity: MotionMargin,
    /// Of acceleration (rad/s²).
    pub acceleration: MotionMargin,
    /// Of jerk (rad/s³).
    pub jerk: MotionMargin,
}

impl MotionMargins {
    /// That of the rate with this [`Rate::name`].
    pub(crate) fn of(&self, rate: &str) -> Option<&MotionMargin> {
        let all = [
            (Rate::Velocity, &self.velocity),
            (Rate::Acceleration, &self.acceleration),
            (Rate::Jerk, &self.jerk),
        ];
        all.into_iter().find(|(known, _)| known.name() == rate).map(|(_, margin)| margin)
    }
}

/// The greatest absolute value of one rate, beside its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionMargin {
    /// The greatest absolute value.
    pub largest: f64,
    /// When (s).
    pub time: f64,
    /// What is allowed; `None` where the user stated no limit.
    pub limit: Option<f64>,
}

/// A reason why a motion is not safe. Joints and links count from 1 at the base, obstacles from 0 (in texts
/// from 1), times are in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum Violation {
    /// A link comes as near to what it must not touch as the margin, or touches it.
    #[error("{}", self.told_of(None, Units::SI, 0.0))]
    Contact {
        /// When first.
        time: f64,
        /// Which link.
        link: usize,
        /// What it touches.
        against: Against,
        /// By how much the clearance falls short of the margin (m), at the worst of this contact; how far a
        /// centre line is inside a polygon does not count.
        depth: f64,
    },
    /// It was not decided whether a link stays clear of something: the budget ran out, or the clearance
    /// cannot be told from the floor in the arithmetic used.
    #[error("{}", self.told_of(None, Units::SI, 0.0))]
    Undecided {
        /// When first.
        time: f64,
        /// Which link.
        link: usize,
        /// What it touches.
        against: Against,
    },
    /// A joint moves beyond a limit.
    #[error("{}", self.told_of(None, Units::SI, 0.0))]
    JointLimit {
        /// Which joint.
        joint: usize,
        /// When it is the farthest beyond.
        time: f64,
        /// Where it then stands (rad).
        angle: f64,
        /// The limit (rad).
        limit: f64,
    },
    /// A joint moves faster, or changes its speed faster, than allowed.
    #[error("{}", self.told_of(None, Units::SI, 0.0))]
    MotionLimit {
        /// Which joint.
        joint: usize,
        /// Of what.
        rate: Rate,
        /// When it is the greatest.
        time: f64,
        /// The greatest absolute value.
        value: f64,
        /// What is allowed.
        limit: f64,
    },
    /// Two pieces do not join.
    #[error("{}", self.told_of(None, Units::SI, 0.0))]
    Discontinuity {
        /// Which joint.
        joint: usize,
        /// What jumps.
        what: Quantity,
        /// When it jumps the most.
        time: f64,
        /// By how much.
        jump: f64,
    },
    /// A joint is not at rest where the motion begins or ends, and was to be.
    #[error("{}", self.told_of(None, Units::SI, 0.0))]
    NotAtRest {
        /// Which joint.
        joint: usize,
        /// Whether at the end, or at the start.
        at_end: bool,
        /// Of what.
        what: Quantity,
        /// How much of it.
        value: f64,
        /// When (s).
        time: f64,
    },
    /// The motion begins later than it was said to: what the arm does until then is not in it.
    #[error("how the arm gets to the first row in the {} before it was not judged", seconds(*lead))]
    NotJudged {
        /// How long before (s).
        lead: f64,
        /// When the motion begins (s).
        time: f64,
    },
    /// The motion is that of an arm with another number of joints.
    #[error("the motion moves {found} joints, the arm has {joints}")]
    OtherArm {
        /// How many joints the motion moves.
        found: usize,
        /// How many the arm has.
        joints: usize,
        /// When the motion begins.
        time: f64,
    },
    /// The numbers of a piece are too large for the arithmetic.
    #[error("the numbers of joint {joint} are too large in the piece that begins at {}", seconds(*time))]
    TooLarge {
        /// Which joint.
        joint: usize,
        /// When the first such piece begins.
        time: f64,
    },
    /// The verifier was told to stop before it was done.
    #[error("the verifier was stopped before it was done with the motion")]
    Stopped {
        /// When the first piece begins that was not examined in full.
        time: f64,
    },
}

impl Violation {
    /// In words and in `units`: of a motion in `scene`, if it is known, that was to keep a clearance of `margin` (m).
    pub fn told_of(&self, scene: Option<&Scene>, units: Units, margin: f64) -> String {
        match *self {
            Self::Contact { time, link, against, depth } => {
                let other = against.in_words(scene);
                let from = seconds(time);
                let inside = depth - margin;
                if inside > TOUCH {
                    format!(
                        "link {link} touches {other} from {from} on and penetrates it by {}",
                        units.length(inside)
                    )
                } else if margin > 0.0 && inside < 0.0 {
                    let [nearest, asked] = apart(units.of_metres(-inside), units.of_metres(margin));
                    let unit = units.length.name();
                    format!(
                        "link {link} comes within {nearest} {unit} of {other}; a clearance of {asked} {unit} is asked for, and missed \
                         from {from} on"
                    )
                } else {
                    format!("link {link} touches {other} from {from} on")
                }
            }
            Self::Undecided { time, link, against } => {
                let other = against.in_words(scene);
                format!(
                    "whether link {link} stays clear of {other} could not be decided from {} on",
                    seconds(time)
                )
            }
            Self::JointLimit { joint, time, angle, limit } => {
                let [angle, limit] = units.beside_limit(angle, limit, 0);
                format!("joint {joint} moves to {angle} at {}, beyond its limit of {limit}", seconds(time))
            }
            Self::MotionLimit { joint, rate, time, value, limit } => {
                let [value, limit] = units.beside_limit(value, limit, rate.order());
                let at = seconds(time);
                format!("the {} of joint {joint} reaches {value} at {at}, {limit} are allowed", rate.name())
            }
            Self::Discontinuity { joint, what, time, jump } => {
                let jump = units.rate(jump, what.order());
                format!("the {} of joint {joint} jumps by {jump} at {}", what.name(), seconds(time))
            }
            Self::NotAtRest { joint, at_end, what, value, time } => {
                let value = units.rate(value, what.order());
                let moves = if at_end {
                    "does not come to rest where the motion ends"
                } else {
                    "is not at rest where the motion begins"
                };
                format!("joint {joint} {moves}, at {}: its {} is {value} there", seconds(time), what.name())
            }
            Self::NotJudged { .. } | Self::OtherArm { .. } | Self::TooLarge { .. } | Self::Stopped { .. } => {
                self.to_string()
            }
        }
    }

    /// When (s).
    pub fn time(&self) -> f64 {
        match *self {
            Self::Contact { time, .. }
            | Self::Undecided { time, .. }
            | Self::JointLimit { time, .. }
            | Self::MotionLimit { time, .. }
            | Self::Discontinuity { time, .. }
            | Self::NotAtRest { time, .. }
            | Self::NotJudged { time, .. }
            | Self::OtherArm { time, .. }
            | Self::TooLarge { time, .. }
            | Self::Stopped { time } => time,
        }
    }
}
