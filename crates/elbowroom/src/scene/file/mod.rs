//! Scene files: YAML with the units stated.
//!
//! The text is read from the parser's events into a small tree of marked nodes, under budgets, instead of through
//! serde: so every complaint, also one about meaning, names line, column and key, what was found and what is allowed.

mod arm;
mod error;
mod grid;
mod keys;
mod location;
mod motion;
mod node;
mod obstacles;
mod syntax;
mod tasks;
mod tree;
mod value;

pub use error::{ParseProblem, SceneError};
pub use location::{Location, Locations};

use super::Scene;
use crate::units::{AngleUnit, LengthUnit, Units};
use keys::Keys;
use value::{Fault, Value};

/// The version of the format that is read.
const VERSION: &str = "1";

const ROOT: Keys =
    Keys { required: &["elbowroom", "units", "arm", "grid"], optional: &["obstacles", "tasks"] };
const UNITS: Keys = Keys { required: &["length", "angle"], optional: &[] };

/// What a scene file says, and where it says it.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// Where its tasks are.
    pub locations: Locations,
    /// What it is written in.
    pub units: Units,
}

/// Reads a scene from `text`; errors call it `file`.
///
/// # Errors
/// [`SceneError`] for the first thing that is wrong, with its place.
///
/// # Example
/// ```
/// let text = "
/// elbowroom: 1
/// units: {length: mm, angle: deg}
/// arm: {links: [400, 250], joints: [{min: -140, max: 140}, {min: -150, max: 150}]}
/// grid: {x: [-700, 700], y: [-700, 700], step: 10}
/// ";
/// let file = elbowroom::scene::parse(text, "cell.yaml")?;
/// assert_eq!(file.scene.arm().lengths(), [0.4, 0.25]);
/// # Ok::<(), elbowroom::scene::SceneError>(())
/// ```
pub fn parse(text: &str, file: &str) -> Result<SceneFile, SceneError> {
    let mut units = Units::SI;
    let root = tree::tree(text).map_err(|fault| fault.in_file(file, units))?;
    scene(&Value::root(&root), &mut units).map_err(|fault| fault.in_file(file, units))
}

/// The scene; its units are `known` as soon as they are read, so that errors can be told in them.
fn scene(root: &Value<'_>, known: &mut Units) -> Result<SceneFile, Fault> {
    // Before all else: keys that are unknown here may be known to another version.
    if let Some(version) = root.peek("elbowroom") {
        version
            .word(&[VERSION])
            .map_err(|_| version.fault(ParseProblem::Version { found: version.in_words(), read: VERSION }))?;
    }
    let map = root.map(&ROOT)?;
    let units = units(&map.required("units")?)?;
    *known = units;
    let arm = arm::read(&map.required("arm")?, units)?;
    let grid = grid::read(&map.required("grid")?, units)?;
    let obstacles = match map.optional("obstacles") {
        Some(value) => obstacles::read(&value, units)?,
        None => Default::default(),
    };
    let (tasks, ends) = match map.optional("tasks") {
        Some(value) => tasks::read(&value, units, arm.links())?,
        None => Default::default(),
    };
    let scene = Scene::new(arm, grid, obstacles, tasks).map_err(|problem| root.fault(problem.into()))?;
    Ok(SceneFile { scene, locations: Locations { ends }, units })
}

fn units(value: &Value<'_>) -> Result<Units, Fault> {
    let map = value.map(&UNITS)?;
    let length = map.required("length")?.word(&LengthUnit::ALL.map(LengthUnit::name))?;
    let angle = map.required("angle")?.word(&AngleUnit::ALL.map(AngleUnit::name))?;
    Ok(Units {
        length: LengthUnit::ALL.into_iter().find(|unit| unit.name() == length).unwrap_or_default(),
        angle: AngleUnit::ALL.into_iter().find(|unit| unit.name() == angle).unwrap_or_default(),
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn the_schema_has_the_same_keys() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../schema/scene.schema.json");
        let schema: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        for (pointer, keys) in [
            ("", ROOT),
            ("/$defs/units", UNITS),
            ("/$defs/arm", arm::ARM),
            ("/$defs/joint", arm::JOINT),
            ("/$defs/grid", grid::GRID),
            ("/$defs/obstacle", obstacles::OBSTACLE),
            ("/$defs/circle", obstacles::CIRCLE),
            ("/$defs/segment", obstacles::SEGMENT),
            ("/$defs/motion", motion::MOTION),
            ("/$defs/waypoint", motion::WAYPOINT),
            ("/$defs/task", tasks::TASK),
            ("/$defs/configuration", tasks::PLACE),
        ] {
            let mapping = schema.pointer(pointer).unwrap();
            let known: BTreeSet<&str> =
                mapping["properties"].as_object().unwrap().keys().map(String::as_str).collect();
            assert_eq!(known, keys.known().collect(), "{pointer}");
            let required: BTreeSet<&str> = mapping
                .get("required")
                .map(|list| list.as_array().unwrap().iter().map(|key| key.as_str().unwrap()).collect())
                .unwrap_or_default();
            assert_eq!(required, keys.required.iter().copied().collect(), "{pointer}");
            assert_eq!(mapping["additionalProperties"], false, "{pointer}");
        }
    }
}
