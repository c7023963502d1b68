use std::collections::BTreeMap;

use super::Location;
use super::keys;
use super::units::Units;
use super::value::{Fault, Value};
use crate::arm::Configuration;
use crate::scene::{Place, Task, TaskPosture};

/// The tasks, and where each has its start and goal.
pub(super) type Tasks = (Vec<Task>, BTreeMap<String, [Location; 2]>);

pub(super) fn read(value: &Value<'_>, units: Units) -> Result<Tasks, Fault> {
    let mut tasks = Vec::new();
    let mut ends = BTreeMap::new();
    for (name, value) in value.named()? {
        let map = value.map(&keys::TASK)?;
        let (start, goal) = (map.required("start")?, map.required("goal")?);
        let posture = match map.optional("posture") {
            Some(value) => match value.word(&["up", "down", "any", "keep"])? {
                "up" => TaskPosture::Up,
                "down" => TaskPosture::Down,
                "keep" => TaskPosture::Keep,
                _ => TaskPosture::Any,
            },
            None => TaskPosture::Any,
        };
        tasks.push(Task {
            name: name.to_owned(),
            start: place(&start, units)?,
            goal: place(&goal, units)?,
            posture,
        });
        ends.insert(name.to_owned(), [start.at(), goal.at()]);
    }
    Ok((tasks, ends))
}

fn place(value: &Value<'_>, units: Units) -> Result<Place, Fault> {
    if value.is_map() {
        let map = value.map(&keys::PLACE)?;
        let [q1, q2] = map.required("q")?.pair("[q1, q2], a joint angle each")?;
        return Ok(Place::Configuration(Configuration([
            units.angle(q1.number()?),
            units.angle(q2.number()?),
        ])));
    }
    let [x, y] = value.pair("[x, y], or {q: [q1, q2]}")?;
    Ok(Place::Tip(crate::geometry::Point::new(x.length(units)?, y.length(units)?)))
}
