use std::collections::HashSet;

use super::error::ParseProblem;
use super::keys::Keys;
use super::motion;
use super::value::{Fault, Value};
use crate::geometry::{Point, Shape, ShapeError};
use crate::scene::problem::MOST_OBSTACLES;
use crate::scene::{Obstacle, SceneProblem};
use crate::units::Units;

pub(super) const OBSTACLE: Keys = Keys {
    required: &[],
    optional: &[
        "circle",
        "segment",
        "polygon",
        "name",
        "motion",
        "greatest_speed",
        "seen",
        "seen_from",
        "sensing_radius",
    ],
};
pub(super) const CIRCLE: Keys = Keys { required: &["center", "radius"], optional: &[] };
pub(super) const SEGMENT: Keys = Keys { required: &["from", "to"], optional: &["radius"] };

/// What an obstacle may be, by the key that says so.
const SHAPES: [(&str, Reader); 3] = [("circle", circle), ("segment", segment), ("polygon", polygon)];

type Reader = fn(&Value<'_>, Units) -> Result<Shape, Fault>;

/// The obstacles, and how those move that do.
pub(super) fn read(value: &Value<'_>, units: Units) -> Result<Vec<Obstacle>, Fault> {
    let values = value.list("a list of obstacles")?;
    if values.len() > MOST_OBSTACLES {
        return Err(value.fault(SceneProblem::Obstacles { found: values.len() }.into()));
    }
    let mut names = HashSet::new();
    values.iter().map(|value| obstacle(value, units, &mut names)).collect()
}

fn obstacle<'a>(value: &'a Value<'a>, units: Units, names: &mut HashSet<&'a str>) -> Result<Obstacle, Fault> {
    let map = value.map(&OBSTACLE)?;
    let name = match map.optional("name") {
        Some(value) => {
            let name = value.name()?;
            if !names.insert(name) {
                return Err(value.fault(SceneProblem::ObstacleName { name: name.to_owned() }.into()));
            }
            Some(name.to_owned())
        }
        None => None,
    };
    let mut shapes = SHAPES.iter().filter_map(|(key, read)| Some((map.optional(key)?, read)));
    let shape = match (shapes.next(), shapes.next()) {
        (Some((value, read)), None) => read(&value, units)?,
        (Some(_), Some(_)) => return Err(value.fault(one_shape("more than one"))),
        (None, _) => return Err(value.fault(one_shape("none"))),
    };
    Ok(Obstacle { name, shape, motion: motion::read(&map, units)? })
}

fn one_shape(found: &'static str) -> ParseProblem {
    ParseProblem::OneShape { known: SHAPES.iter().map(|(key, _)| *key).collect(), found }
}

fn circle(value: &Value<'_>, units: Units) -> Result<Shape, Fault> {
    let map = value.map(&CIRCLE)?;
    let center = map.required("center")?.point(units)?;
    let radius = map.required("radius")?;
    match radius.length(units)? {
        length if length > 0.0 => Shape::circle(center, length).map_err(|error| value.fault(error.into())),
        _ => Err(radius.out_of_range("greater than 0")),
    }
}

fn segment(value: &Value<'_>, units: Units) -> Result<Shape, Fault> {
    let map = value.map(&SEGMENT)?;
    let [from, to] = [map.required("from")?.point(units)?, map.required("to")?.point(units)?];
    let radius = match map.optional("radius") {
        None => 0.0,
        Some(radius) => match radius.length(units)? {
            length if length >= 0.0 => length,
            _ => return Err(radius.out_of_range("0 or more")),
        },
    };
    Shape::segment(from, to, radius).map_err(|error| value.fault(error.into()))
}

fn polygon(value: &Value<'_>, units: Units) -> Result<Shape, Fault> {
    let values = value.list("a list of corners [x, y]")?;
    let corners = values.iter().map(|corner| corner.point(units)).collect::<Result<Vec<Point>, Fault>>()?;
    // Common enough for words of its own: other tools write rings that end where they began.
    let count = corners.len();
    let neighbours = (1..count).map(|i| (i - 1, i)).chain([(0, count.saturating_sub(1))]);
    let repeated = neighbours.filter(|_| count >= 3).find(|&(i, j)| corners[i] == corners[j]);
    if let Some((first, second)) = repeated {
        return Err(values[second].fault(ParseProblem::CornerTwice { first, second }));
    }
    Shape::polygon(corners).map_err(|error| match error {
        ShapeError::NotFinite { vertex: i } | ShapeError::EdgesMeet { first: i, .. } => {
            values[i].fault(error.into())
        }
        error => value.fault(error.into()),
    })
}
