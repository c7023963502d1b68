use std::collections::BTreeMap;

use super::Location;
use super::keys::Keys;
use super::value::{Fault, Value};
use crate::scene::problem::{GREATEST_ANGLE, MOST_TASKS};
use crate::scene::{Place, SceneProblem, Task, TaskPosture};
use crate::units::Units;

pub(super) const TASK: Keys = Keys { required: &["start", "goal"], optional: &["posture", "clearance"] };
pub(super) const PLACE: Keys = Keys { required: &["q"], optional: &[] };

/// The tasks, and where each has its start and goal.
pub(super) type Tasks = (Vec<Task>, BTreeMap<String, [Location; 2]>);

/// The tasks of an arm of so many `joints`.
pub(super) fn read(value: &Value<'_>, units: Units, joints: usize) -> Result<Tasks, Fault> {
    let mut tasks = Vec::new();
    let mut ends = BTreeMap::new();
    let named = value.named()?;
    if named.len() > MOST_TASKS {
        return Err(value.fault(SceneProblem::Tasks { found: named.len() }.into()));
    }
    for (name, value) in named {
        let map = value.map(&TASK)?;
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
            start: place(&start, units, joints)?,
            goal: place(&goal, units, joints)?,
            posture,
            clearance: match map.optional("clearance") {
                Some(value) => clearance(&value, units)?,
                None => 0.0,
            },
        });
        ends.insert(name.to_owned(), [start.at(), goal.at()]);
    }
    Ok((tasks, ends))
}

fn clearance(value: &Value<'_>, units: Units) -> Result<f64, Fault> {
    let clearance = value.length(units)?;
    if clearance < 0.0 {
        return Err(value.out_of_range("0 or greater".to_owned()));
    }
    Ok(clearance)
}

fn place(value: &Value<'_>, units: Units, joints: usize) -> Result<Place, Fault> {
    let either = format!("[x, y], or {{q: [{}]}}", names(joints));
    if value.is_map() {
        if value.peek("q").is_none() {
            return Err(value.shape(either));
        }
        let map = value.map(&PLACE)?;
        let allowed = format!("[{}], a joint angle each", names(joints));
        let q = map.required("q")?;
        let angles = q.list(&allowed)?;
        if angles.len() != joints {
            return Err(q.shape(allowed));
        }
        let angles = angles.iter().map(|angle| joint(angle, units)).collect::<Result<Vec<f64>, Fault>>()?;
        return Ok(Place::Configuration(angles.into()));
    }
    let [x, y] = value.pair(&either)?;
    Ok(Place::Tip(crate::geometry::Point::new(x.length(units)?, y.length(units)?)))
}

/// `q1, q2` or, for more joints than three, `q1, ..., q5`.
fn names(joints: usize) -> String {
    match joints {
        0..=3 => (1..=joints).map(|j| format!("q{j}")).collect::<Vec<_>>().join(", "),
        _ => format!("q1, ..., q{joints}"),
    }
}

fn joint(value: &Value<'_>, units: Units) -> Result<f64, Fault> {
    let angle = units.radians(value.number()?);
    if angle.abs() > GREATEST_ANGLE {
        return Err(value.out_of_range(format!("at most {} in size", units.stated_angle(GREATEST_ANGLE))));
    }
    Ok(angle)
}
