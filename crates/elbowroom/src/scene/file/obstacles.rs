use super::error::Problem;
use super::keys;
use super::units::Units;
use super::value::{Fault, Value};
use crate::geometry::{Circle, Polygon};
use crate::scene::{Obstacle, Shape};

pub(super) fn read(value: &Value<'_>, units: Units) -> Result<Vec<Obstacle>, Fault> {
    value.list("a list of obstacles")?.iter().map(|value| obstacle(value, units)).collect()
}

fn obstacle(value: &Value<'_>, units: Units) -> Result<Obstacle, Fault> {
    let map = value.map(&keys::OBSTACLE)?;
    let name = map.optional("name").map(|name| name.name()).transpose()?;
    let shape = match (map.optional("circle"), map.optional("polygon")) {
        (Some(circle), None) => Shape::Circle(read_circle(&circle, units)?),
        (None, Some(polygon)) => {
            let corners = polygon.list("a list of corners [x, y]")?;
            let corners = corners.iter().map(|corner| corner.point(units)).collect::<Result<_, _>>()?;
            Shape::Polygon(Polygon::new(corners).map_err(|error| polygon.fault(error.into()))?)
        }
        (Some(_), Some(_)) => return Err(value.fault(Problem::OneShape { found: "both" })),
        (None, None) => return Err(value.fault(Problem::OneShape { found: "neither" })),
    };
    Ok(Obstacle { name, shape })
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
