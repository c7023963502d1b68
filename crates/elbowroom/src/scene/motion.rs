use thiserror::Error;

use crate::geometry::Vector;
use crate::units::{Told, Units, apart};

/// The most waypoints of one moving obstacle.
pub const MOST_WAYPOINTS: usize = 10_000;

/// Latest time and maximum speed and shift that are served (s, m/s, m): beyond them numbers lose the digits the
/// checks rely on.
const GREATEST: f64 = 1e6;

/// How an obstacle moves, without turning, and since when the arm knows of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleMotion {
    course: Course,
    sight: Sight,
    greatest_speed: f64,
    declared: bool,
}

/// Where a moving obstacle is, as a shift from where the scene has it (m).
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// Straight from waypoint to waypoint; still before the first and after the last.
    Waypoints(Vec<Waypoint>),
    /// Still until `start`, then on and on at one velocity.
    Drift {
        /// When it begins to move (s).
        start: f64,
        /// In m/s.
        velocity: Vector,
    },
    /// Towards the arm's tip, wherever it goes, at the maximum speed, but no nearer to any link than `keep_off` (m);
    /// nobody knows beforehand where that is.
    Chase {
        /// Distance at which it stops (m).
        keep_off: f64,
    },
    /// Not there, as far as anyone knows.
    Absent,
    /// Nobody knows: from where it was seen it may have gone anywhere at its maximum speed.
    Unknown {
        /// When it was seen (s).
        seen: f64,
        /// Where (m).
        shift: Vector,
    },
}

/// A place on a course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// When (s).
    pub time: f64,
    /// Where, as a shift from where the scene has the obstacle (m).
    pub shift: Vector,
}

/// Since when the arm knows of a moving obstacle and its course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sight {
    /// From the beginning.
    Always,
    /// From this time on (s).
    From(f64),
    /// While it is no farther from the arm than this (m).
    Within(f64),
}

/// Why no obstacle moves so.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ObstacleMotionError {
    /// No waypoint, or more than are served.
    #[error("{found} waypoints, 1 to {MOST_WAYPOINTS} are allowed")]
    Waypoints {
        /// How many.
        found: usize,
    },
    /// A waypoint is not after the one before it.
    #[error("waypoint {index} is at {time} s, which is not after the {before} s of the one before")]
    Times {
        /// Which, from 0.
        index: usize,
        /// Its time (s).
        time: f64,
        /// The time before (s).
        before: f64,
    },
    /// A number is not finite, too large, or negative where it must not be.
    #[error("{what} is {value}, it must be finite{}, at most {GREATEST} in size", if *positive { ", not negative" } else { "" })]
    Number {
        /// Of what.
        what: &'static str,
        /// What was given.
        value: f64,
        /// Whether it must not be negative.
        positive: bool,
    },
    /// The course is faster than the maximum speed declared.
    #[error("{}", self.told(Units::SI))]
    TooFast {
        /// Of the course (m/s).
        found: f64,
        /// What was declared (m/s).
        declared: f64,
    },
}

impl Told for ObstacleMotionError {
    fn told(&self, units: Units) -> String {
        match *self {
            Self::TooFast { found, declared } => {
                let unit = units.length.name();
                let [found, declared] = apart(units.of_metres(found), units.of_metres(declared));
                format!(
                    "the obstacle moves at up to {found} {unit}/s, the greatest speed declared is {declared} {unit}/s"
                )
            }
            Self::Waypoints { .. } | Self::Times { .. } | Self::Number { .. } => self.to_string(),
        }
    }
}

impl ObstacleMotion {
    /// Motion on `course`; `greatest_speed` (m/s) is that of the course where none is declared, and has to be for a course
    /// that is unknown.
    ///
    /// # Errors
    /// [`ObstacleMotionError`] names the first thing that is wrong.
    pub fn new(
        course: Course,
        sight: Sight,
        greatest_speed: Option<f64>,
    ) -> Result<Self, ObstacleMotionError> {
        course.check()?;
        match sight {
            Sight::Always => {}
            Sight::From(time) => number("seen_from", time, false)?,
            Sight::Within(radius) => number("sensing radius", radius, true)?,
        }
        let found = course.greatest_speed();
        let declared = greatest_speed.unwrap_or(found);
        number("greatest speed", declared, true)?;
        if found > declared * (1.0 + 1e-9) {
            return Err(ObstacleMotionError::TooFast { found, declared });
        }
        Ok(Self { course, sight, greatest_speed: declared, declared: greatest_speed.is_some() })
    }

    /// With the same maximum speed, but the course known otherwise.
    #[must_use]
    pub fn on(&self, course: Course) -> Self {
        Self { course, declared: true, ..self.clone() }
    }

    /// Where the obstacle is at which time.
    pub fn course(&self) -> &Course {
        &self.course
    }

    /// Since when the arm knows of it.
    pub fn sight(&self) -> Sight {
        self.sight
    }

    /// It is never faster (m/s).
    pub fn greatest_speed(&self) -> f64 {
        self.greatest_speed
    }

    /// The maximum speed if it was declared (m/s); `None` where it is that of the course.
    pub fn declared_speed(&self) -> Option<f64> {
        self.declared.then_some(self.greatest_speed)
    }
}

impl Course {
    /// How far the obstacle is from where the scene has it at `time` (s) (m); of an unknown course, where it was seen
    /// or, to chase, began.
    pub fn shift_at(&self, time: f64) -> Vector {
        match self {
            Self::Waypoints(waypoints) => {
                let after = waypoints.partition_point(|waypoint| waypoint.time <= time);
                match (after.checked_sub(1).map(|i| waypoints[i]), waypoints.get(after)) {
                    (Some(a), Some(b)) => {
                        let fraction = (time - a.time) / (b.time - a.time);
                        a.shift + (b.shift + -a.shift) * fraction
                    }
                    (Some(only), None) => only.shift,
                    (None, first) => first.map_or(Vector::new(0.0, 0.0), |first| first.shift),
                }
            }
            Self::Drift { start, velocity } => *velocity * (time - start).max(0.0),
            Self::Chase { .. } | Self::Absent => Vector::new(0.0, 0.0),
            Self::Unknown { shift, .. } => *shift,
        }
    }

    /// Whether nobody knows where the obstacle will be.
    pub fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown { .. } | Self::Chase { .. })
    }

    /// The fastest that the course is (m/s); 0 where it is unknown.
    pub fn greatest_speed(&self) -> f64 {
        match self {
            Self::Waypoints(waypoints) => waypoints
                .windows(2)
                .map(|pair| (pair[1].shift + -pair[0].shift).length() / (pair[1].time - pair[0].time))
                .fold(0.0, f64::max),
            Self::Drift { velocity, .. } => velocity.length(),
            Self::Chase { .. } | Self::Absent | Self::Unknown { .. } => 0.0,
        }
    }

    fn check(&self) -> Result<(), ObstacleMotionError> {
        let vector = |what, v: Vector| number(what, v.x, false).and_then(|()| number(what, v.y, false));
        match self {
            Self::Waypoints(waypoints) => {
                if !(1..=MOST_WAYPOINTS).contains(&waypoints.len()) {
                    return Err(ObstacleMotionError::Waypoints { found: waypoints.len() });
                }
                for waypoint in waypoints {
                    number("time of a waypoint", waypoint.time, false)?;
                    vector("shift of a waypoint", waypoint.shift)?;
                }
                let late = (1..waypoints.len()).find(|&i| waypoints[i].time <= waypoints[i - 1].time);
                late.map_or(Ok(()), |index| {
                    let (time, before) = (waypoints[index].time, waypoints[index - 1].time);
                    Err(ObstacleMotionError::Times { index, time, before })
                })
            }
            Self::Drift { start, velocity } => {
                number("start", *start, false).and(vector("velocity", *velocity))
            }
            Self::Chase { keep_off } => number("keep_off", *keep_off, true),
            Self::Absent => Ok(()),
            Self::Unknown { seen, shift } => number("time", *seen, false).and(vector("shift", *shift)),
        }
    }
}

fn number(what: &'static str, value: f64, positive: bool) -> Result<(), ObstacleMotionError> {
    let least = if positive { 0.0 } else { -GREATEST };
    if (least..=GREATEST).contains(&value) {
        Ok(())
    } else {
        Err(ObstacleMotionError::Number { what, value, positive })
    }
}
