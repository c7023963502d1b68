//! The JSON Schema of scene files says what the parser does.
//!
//! That both know the same keys is tested beside the parser's own table of keys; here are the values.

use elbowroom::geometry::MAX_VERTICES;
use elbowroom::scene::{ParseProblem, parse};
use serde_json::Value;

const SOUND: &str = "\
elbowroom: 1
units: {length: cm, angle: deg}
arm:
  links: [25, 20]
  joints: [{continuous: true, velocity: 90, acceleration: 90, jerk: 90}, {min: -50, max: 50}]
  half_width: 2
grid: {x: [-50, 50], y: [-40, 40], step: 1}
obstacles:
  - circle: {center: [22, 22], radius: 5}
  - segment: {from: [-22, 22], to: [-22, 10], radius: 3}
tasks:
  first: {start: [40, 10], goal: [30, 10], posture: any}
";

fn schema() -> Result<Value, Box<dyn std::error::Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../schema/scene.schema.json");
    Ok(serde_json::from_str(&std::fs::read_to_string(path)?)?)
}

/// What is wrong with `SOUND` once `old` is `new`.
fn problem(old: &str, new: &str) -> Option<ParseProblem> {
    assert!(SOUND.contains(old), "{old}");
    parse(&SOUND.replacen(old, new, 1), "s.yaml").err().map(|error| error.problem)
}

#[test]
fn it_lists_the_very_words_the_parser_takes() {
    let schema = schema().unwrap();
    for (pointer, key, written) in [
        ("/$defs/units/properties/length", "length", "length: cm"),
        ("/$defs/units/properties/angle", "angle", "angle: deg"),
        ("/$defs/task/properties/posture", "posture", "posture: any"),
    ] {
        let listed = schema.pointer(pointer).unwrap()["enum"].as_array().unwrap();
        let words: Vec<&str> = listed.iter().map(|word| word.as_str().unwrap()).collect();
        for word in &words {
            assert_eq!(problem(written, &format!("{key}: {word}")), None, "{key}: {word}");
        }
        let expected = ParseProblem::Shape { found: "nonsense".to_owned(), allowed: words.join(", ") };
        assert_eq!(problem(written, &format!("{key}: nonsense")), Some(expected));
    }
    assert_eq!(schema["properties"]["elbowroom"]["const"], 1);
    assert!(matches!(problem("elbowroom: 1", "elbowroom: 2"), Some(ParseProblem::Version { read: "1", .. })));
    assert_eq!(schema.pointer("/$defs/joint/properties/continuous/const"), Some(&Value::Bool(true)));
    assert!(problem("continuous: true", "continuous: false").is_some());
}

#[test]
fn it_bounds_numbers_where_the_parser_does() {
    let schema = schema().unwrap();
    for (pointer, key, written) in [
        ("/$defs/joint/properties/velocity", "velocity", "velocity: 90"),
        ("/$defs/joint/properties/acceleration", "acceleration", "acceleration: 90"),
        ("/$defs/joint/properties/jerk", "jerk", "jerk: 90"),
        ("/$defs/grid/properties/step", "step", "step: 1"),
        ("/$defs/circle/properties/radius", "radius", "radius: 5"),
        ("/$defs/segment/properties/radius", "radius", "radius: 3"),
        ("/$defs/arm/properties/half_width", "half_width", "half_width: 2"),
    ] {
        let bounded = schema.pointer(pointer).unwrap();
        let zero_allowed = match (bounded.get("exclusiveMinimum"), bounded.get("minimum")) {
            (Some(bound), None) | (None, Some(bound)) => {
                assert_eq!(bound, 0, "{key}");
                bounded.get("minimum").is_some()
            }
            _ => panic!("{key}: one bound"),
        };
        assert_eq!(problem(written, &format!("{key}: 0")).is_none(), zero_allowed, "{key}");
        assert!(problem(written, &format!("{key}: -1")).is_some(), "{key}");
    }
}

#[test]
fn it_counts_as_the_parser_does() {
    let schema = schema().unwrap();
    let count = |pointer: &str| schema.pointer(pointer).unwrap().as_u64().unwrap() as usize;
    let circle = "  - circle: {center: [22, 22], radius: 5}\n";
    let most = count("/properties/obstacles/maxItems");
    // The segment is one of them.
    assert_eq!(problem(circle, &circle.repeat(most - 1)), None);
    assert!(problem(circle, &circle.repeat(most)).is_some());

    let tasks = |count: usize| {
        (0..count)
            .fold("tasks:\n".to_owned(), |text, i| format!("{text}  t{i}: {{start: [1, 1], goal: [1, 2]}}\n"))
    };
    let (sound, _) = SOUND.split_once("tasks:").unwrap();
    let most = count("/properties/tasks/maxProperties");
    assert!(parse(&format!("{sound}{}", tasks(most)), "s.yaml").is_ok());
    assert!(parse(&format!("{sound}{}", tasks(most + 1)), "s.yaml").is_err());

    assert_eq!(count("/$defs/obstacle/properties/polygon/maxItems"), MAX_VERTICES);
    assert_eq!(count("/$defs/obstacle/properties/polygon/minItems"), 3);
    let point = "circle: {center: [22, 22], radius: 5}";
    assert_eq!(problem(point, "polygon: [[0, 0], [1, 0], [0, 1]]"), None);
    assert!(problem(point, "polygon: [[0, 0], [1, 0]]").is_some());
    let shapes = schema.pointer("/$defs/obstacle/oneOf").unwrap().as_array().unwrap();
    let shapes: Vec<&str> = shapes.iter().map(|shape| shape["required"][0].as_str().unwrap()).collect();
    let Some(ParseProblem::OneShape { known, found: "none" }) = problem(point, "name: none") else {
        panic!("no shape at all")
    };
    assert_eq!(shapes, known);
    assert_eq!(schema.pointer("/$defs/segment/properties/radius/default"), Some(&Value::from(0)));
    assert_eq!(problem(", radius: 3", ""), None);
}

#[test]
fn every_mapping_and_key_of_it_is_described() {
    let schema = schema().unwrap();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let kinds = schema["$defs"].as_object().unwrap();
    for (name, kind) in kinds.iter().map(|(name, kind)| (name.as_str(), kind)).chain([("the whole", &schema)])
    {
        assert!(kind["description"].is_string(), "{name}");
        for (key, value) in kind.get("properties").and_then(Value::as_object).into_iter().flatten() {
            assert!(value["description"].is_string() || value["$ref"].is_string(), "{name}.{key}");
        }
    }
}
