use super::error::ParseProblem;
use super::keys::Keys;
use super::value::{Fault, Map, Value};
use crate::geometry::Vector;
use crate::scene::{Course, ObstacleMotion, ObstacleMotionError, Sight, Waypoint};
use crate::units::Units;

pub(super) const MOTION: Keys =
    Keys { required: &[], optional: &["waypoints", "velocity", "start", "chases", "keep_off"] };
pub(super) const WAYPOINT: Keys = Keys { required: &["time", "shift"], optional: &[] };

/// How the obstacle with these keys moves, if it does.
pub(super) fn read(map: &Map<'_>, units: Units) -> Result<Option<ObstacleMotion>, Fault> {
    let speed = map.optional("greatest_speed");
    let Some(motion) = map.optional("motion") else {
        let stray = ["greatest_speed", "seen", "seen_from", "sensing_radius"];
        return match stray.into_iter().find_map(|key| map.optional(key)) {
            Some(value) => Err(value.shape("only beside motion")),
            None => Ok(None),
        };
    };
    let course = course(&motion, units)?;
    let declared = speed.as_ref().map(|speed| speed.length(units)).transpose()?;
    if matches!(course, Course::Chase { .. }) && declared.is_none() {
        return Err(motion.fault(ParseProblem::MissingKey { key: "greatest_speed, beside chases" }));
    }
    ObstacleMotion::new(course, sight(map, units)?, declared).map(Some).map_err(|error| {
        match (error, speed) {
            (ObstacleMotionError::TooFast { .. }, Some(speed)) => speed.fault(error.into()),
            _ => motion.fault(error.into()),
        }
    })
}

fn course(motion: &Value<'_>, units: Units) -> Result<Course, Fault> {
    let map = motion.map(&MOTION)?;
    let shift = |value: &Value<'_>| value.point(units).map(|shift| Vector::new(shift.x, shift.y));
    let kinds = ["waypoints", "velocity", "chases"].map(|key| map.optional(key));
    let (start, keep_off) = (map.optional("start"), map.optional("keep_off"));
    match (kinds, start, keep_off) {
        ([Some(waypoints), None, None], None, None) => {
            let waypoint = |value: &Value<'_>| {
                let map = value.map(&WAYPOINT)?;
                Ok(Waypoint { time: map.required("time")?.number()?, shift: shift(&map.required("shift")?)? })
            };
            let list = waypoints.list("a list of waypoints {time, shift}")?;
            Ok(Course::Waypoints(list.iter().map(waypoint).collect::<Result<Vec<Waypoint>, Fault>>()?))
        }
        ([None, Some(velocity), None], start, None) => Ok(Course::Drift {
            start: start.map_or(Ok(0.0), |start| start.number())?,
            velocity: shift(&velocity)?,
        }),
        ([None, None, Some(chases)], None, keep_off) => {
            chases.word(&["tip"])?;
            let keep_off = keep_off.map_or(Ok(0.0), |distance| distance.length(units))?;
            Ok(Course::Chase { keep_off })
        }
        _ => Err(motion
            .shape("one of waypoints, velocity (with or without start), chases (with or without keep_off)")),
    }
}

fn sight(map: &Map<'_>, units: Units) -> Result<Sight, Fault> {
    let seen = match map.optional("seen") {
        Some(seen) => seen.word(&["true", "false"])? == "true",
        None => true,
    };
    match (seen, map.optional("seen_from"), map.optional("sensing_radius")) {
        (true, None, None) => Ok(Sight::Always),
        (false, Some(time), None) => Ok(Sight::From(time.number()?)),
        (false, None, Some(radius)) => Ok(Sight::Within(radius.length(units)?)),
        (false, Some(other), Some(_)) => Err(other.shape("seen_from or sensing_radius, not both")),
        (true, Some(other), _) | (true, None, Some(other)) => Err(other.shape("only beside seen: false")),
        (false, None, None) => {
            let key = "seen_from or sensing_radius, beside seen: false";
            match map.optional("seen") {
                Some(seen) => Err(seen.fault(ParseProblem::MissingKey { key })),
                None => Ok(Sight::Always),
            }
        }
    }
}
