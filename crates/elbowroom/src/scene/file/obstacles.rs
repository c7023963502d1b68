use std::collections::HashSet;

use super::error::Problem;
use super::keys;
use super::motion;
use super::units::Units;
use super::value::{Fault, Value};
use crate::geometry::{Circle, Point, Polygon, PolygonError};
use crate::scene::problem::MOST_OBSTACLES;
use crate::scene::{Obstacle, SceneProblem, Shape};

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
    let map = value.map(&keys::OBSTACLE)?;
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
    let shape = match (map.optional("circle"), map.optional("polygon")) {
        (Some(circle), None) => Shape::Circle(read_circle(&circle, units)?),
        (None, Some(polygon)) => Shape::Polygon(read_polygon(&polygon, units)?),
        (Some(_), Some(_)) => return Err(value.fault(Problem::OneShape { found: "both" })),
        (None, None) => return Err(value.fault(Problem::OneShape { found: "neither" })),
    };
    Ok(Obstacle { name, shape, motion: motion::read(&map, units)? })
}

fn read_circle(value: &Value<'_>, units: Units) -> Result<Circle, Fault> {
    let map = value.map(&keys::CIRCLE)?;
    let center = map.required("center")?.point(units)?;
    let radius = map.required("radius")?;
    match radius.length(units)? {
        length if length > 0.0 => Circle::new(center, length).map_err(|error| value.fault(error.into())),
        _ => Err(radius.out_of_range("greater than 0")),
    }
}

fn read_polygon(value: &Value<'_>, units: Units) -> Result<Polygon, Fault> {
    let values = value.list("a list of corners [x, y]")?;
    let corners = values.iter().map(|corner| corner.point(units)).collect::<Result<Vec<Point>, Fault>>()?;
    // Common enough for words of its own: other tools write rings that end where they began.
    let count = corners.len();
    let neighbours = (1..count).map(|i| (i - 1, i)).chain([(0, count.saturating_sub(1))]);
    let repeated = neighbours.filter(|_| count >= 3).find(|&(i, j)| corners[i] == corners[j]);
    if let Some((first, second)) = repeated {
        return Err(values[second].fault(Problem::CornerTwice { first, second }));
    }
    Polygon::new(corners).map_err(|error| match error {
        PolygonError::NotFinite { vertex: i } | PolygonError::EdgesMeet { first: i, .. } => {
            values[i].fault(error.into())
        }
        PolygonError::VertexCount { .. } => value.fault(error.into()),
    })
}
