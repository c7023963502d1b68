//! The keys of every mapping in a scene file, kept equal to `schema/scene.schema.json` by a test.

/// The keys of one kind of mapping.
pub(super) struct Keys {
    pub(super) required: &'static [&'static str],
    pub(super) optional: &'static [&'static str],
}

impl Keys {
    pub(super) fn known(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.required.iter().chain(self.optional).copied()
    }
}

pub(super) const ROOT: Keys =
    Keys { required: &["elbowroom", "units", "arm", "grid"], optional: &["obstacles", "tasks"] };
pub(super) const UNITS: Keys = Keys { required: &["length", "angle"], optional: &[] };
pub(super) const ARM: Keys =
    Keys { required: &["links", "joints"], optional: &["half_width", "base", "self_collision"] };
pub(super) const JOINT: Keys =
    Keys { required: &[], optional: &["continuous", "min", "max", "velocity", "acceleration", "jerk"] };
pub(super) const GRID: Keys = Keys { required: &["x", "y", "step"], optional: &[] };
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
pub(super) const MOTION: Keys =
    Keys { required: &[], optional: &["waypoints", "velocity", "start", "chases", "keep_off"] };
pub(super) const WAYPOINT: Keys = Keys { required: &["time", "shift"], optional: &[] };
pub(super) const CIRCLE: Keys = Keys { required: &["center", "radius"], optional: &[] };
pub(super) const SEGMENT: Keys = Keys { required: &["from", "to"], optional: &["radius"] };
pub(super) const TASK: Keys = Keys { required: &["start", "goal"], optional: &["posture"] };
pub(super) const PLACE: Keys = Keys { required: &["q"], optional: &[] };

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
            ("/$defs/arm", ARM),
            ("/$defs/joint", JOINT),
            ("/$defs/grid", GRID),
            ("/$defs/obstacle", OBSTACLE),
            ("/$defs/circle", CIRCLE),
            ("/$defs/segment", SEGMENT),
            ("/$defs/motion", MOTION),
            ("/$defs/waypoint", WAYPOINT),
            ("/$defs/task", TASK),
            ("/$defs/configuration", PLACE),
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
