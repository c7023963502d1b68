use std::f64::consts::TAU;

use super::error::ParseProblem;
use super::keys::Keys;
use super::value::{Fault, Map, Value};
use crate::arm::{Arm, ArmError, Joint, JointLimits, JointLimitsError, LENGTHS, MOST_LINKS, MotionLimits};
use crate::geometry::Point;
use crate::units::Units;

pub(super) const ARM: Keys =
    Keys { required: &["links", "joints"], optional: &["half_width", "base", "self_collision"] };
pub(super) const JOINT: Keys =
    Keys { required: &[], optional: &["continuous", "min", "max", "velocity", "acceleration", "jerk"] };

pub(super) fn read(value: &Value<'_>, units: Units) -> Result<Arm, Fault> {
    let map = value.map(&ARM)?;
    let links_value = map.required("links")?;
    let links = links_value.list("a list of link lengths")?;
    let lengths = links
        .iter()
        .map(|link| match link.length(units)? {
            length if length > 0.0 => Ok(length),
            _ => Err(link.out_of_range("greater than 0")),
        })
        .collect::<Result<Vec<f64>, Fault>>()?;
    let joints_value = map.required("joints")?;
    let joints = joints_value.list("a list of joints")?;
    if !(2..=MOST_LINKS).contains(&lengths.len()) {
        return Err(links_value.fault(ParseProblem::Links { found: lengths.len() }));
    }
    if joints.len() != lengths.len() {
        return Err(joints_value.fault(ParseProblem::Joints { found: joints.len(), links: lengths.len() }));
    }
    let joints = joints.iter().map(|value| joint(value, units)).collect::<Result<Vec<Joint>, Fault>>()?;
    let half_width = match map.optional("half_width") {
        Some(value) => match value.length(units)? {
            half_width if half_width >= 0.0 => half_width,
            _ => return Err(value.out_of_range("0 or more")),
        },
        None => 0.0,
    };
    let base = match map.optional("base") {
        Some(value) => value.point(units)?,
        None => Point::new(0.0, 0.0),
    };
    let self_collision = match map.optional("self_collision") {
        Some(value) => value.word(&["true", "false"])? == "true",
        None => false,
    };
    Arm::new(base, lengths, half_width, joints, self_collision).map_err(|error| match error {
        ArmError::Length { link, .. } => {
            links[link - 1].out_of_range(format!("at least {}", units.stated_length(*LENGTHS.start())))
        }
        ArmError::AlwaysTouching { link, .. } => links[link - 1].fault(error.into()),
        _ => value.fault(error.into()),
    })
}

fn joint(value: &Value<'_>, units: Units) -> Result<Joint, Fault> {
    let map = value.map(&JOINT)?;
    let limits = match (map.optional("continuous"), map.optional("min"), map.optional("max")) {
        (Some(continuous), None, None) => {
            continuous
                .word(&["true"])
                .map_err(|_| continuous.shape("true; a joint with limits has min and max instead"))?;
            JointLimits::Continuous
        }
        (Some(_), ..) => {
            let (found, allowed) = ("continuous beside min or max".to_owned(), "one or the other".to_owned());
            return Err(value.fault(ParseProblem::Shape { found, allowed }));
        }
        (None, Some(min), Some(max)) => range(value, &min, &max, units)?,
        (None, Some(_), None) => return Err(value.fault(ParseProblem::MissingKey { key: "max" })),
        (None, None, Some(_)) => return Err(value.fault(ParseProblem::MissingKey { key: "min" })),
        (None, None, None) => {
            return Err(value.fault(ParseProblem::MissingKey { key: "continuous: true, or min and max" }));
        }
    };
    let motion = MotionLimits {
        velocity: rate(&map, "velocity", units)?,
        acceleration: rate(&map, "acceleration", units)?,
        jerk: rate(&map, "jerk", units)?,
    };
    Ok(Joint { limits, motion })
}

fn range(joint: &Value<'_>, min: &Value<'_>, max: &Value<'_>, units: Units) -> Result<JointLimits, Fault> {
    let (low, high) = (min.number()?, max.number()?);
    let (min_angle, max_angle) = (units.radians(low), units.radians(high));
    JointLimits::range(min_angle, max_angle).map_err(|error| match error {
        JointLimitsError::Reversed { .. } => {
            joint.fault(ParseProblem::LimitsReversed { min: low, max: high })
        }
        JointLimitsError::TooWide { .. } => {
            let turns = (max_angle - min_angle) / TAU;
            joint.fault(ParseProblem::LimitsTooWide { min: low, max: high, unit: units.angle.name(), turns })
        }
        JointLimitsError::OutsideRange { .. } => {
            let far = if JointLimits::range(min_angle, min_angle).is_err() { min } else { max };
            far.out_of_range("within a thousand revolutions of 0")
        }
    })
}

fn rate(map: &Map<'_>, key: &str, units: Units) -> Result<Option<f64>, Fault> {
    map.optional(key)
        .map(|value| match units.radians(value.number()?) {
            limit if limit > 0.0 => Ok(limit),
            _ => Err(value.out_of_range("greater than 0")),
        })
        .transpose()
}
