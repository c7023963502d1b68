//! Scene files: what they say, and what is said of those that are wrong.

mod obstacles;

use elbowroom::arm::{JointLimits, MotionLimits};
use elbowroom::geometry::{Point, Shape, Vector};
use elbowroom::scene::{Course, Location, ObstacleMotion, Place, Sight, TaskPosture, Waypoint, parse};

const SOUND: &str = "\
elbowroom: 1
units: {length: cm, angle: deg}
arm:
  links: [25, 20]
  joints:
    - {continuous: true, velocity: 90}
    - {min: -150, max: 150}
  half_width: 2
  base: [1, -2]
grid: {x: [-50, 50], y: [-40, 40], step: 1}
obstacles:
  - circle: {center: [22, 22], radius: 5}
    name: post
  - polygon: [[0, 30], [5, 30], [0, 35]]
tasks:
  first: {start: [40, 10], goal: {q: [90, -30]}, posture: keep}
";

fn message(text: &str) -> String {
    parse(text, "s.yaml").map(|_| "sound".to_owned()).unwrap_or_else(|error| error.to_string())
}

#[test]
fn every_part_is_read_in_metres_and_radians() {
    let file = parse(SOUND, "s.yaml").unwrap();
    let scene = &file.scene;
    assert_eq!(scene.arm().lengths(), [0.25, 0.2]);
    assert_eq!(scene.arm().half_width(), 0.02);
    assert_eq!(scene.arm().base(), Point::new(0.01, -0.02));
    assert_eq!(scene.arm().joints()[0].limits, JointLimits::Continuous);
    assert_eq!(scene.arm().joints()[0].motion.velocity, Some(90f64.to_radians()));
    let bend = 150f64.to_radians();
    assert_eq!(scene.arm().joints()[1].limits, JointLimits::Range { min: -bend, max: bend });
    assert_eq!((scene.grid().columns(), scene.grid().rows()), (101, 81));
    assert_eq!(scene.obstacles()[0].name.as_deref(), Some("post"));
    let shapes: Vec<&Shape> = scene.obstacles().iter().map(|obstacle| &obstacle.shape).collect();
    assert_eq!((shapes[0].vertices().len(), shapes[0].radius()), (1, 0.05));
    assert_eq!((shapes[1].vertices()[1], shapes[1].radius()), (Point::new(0.05, 0.3), 0.0));
    let task = scene.task("first").unwrap();
    assert_eq!(task.start, Place::Tip(Point::new(0.4, 0.1)));
    assert_eq!(task.goal, Place::Configuration([90f64.to_radians(), -30f64.to_radians()].into()));
    assert_eq!(task.posture, TaskPosture::Keep);
    assert_eq!(file.locations.start("first"), Some(Location { line: 16, column: 18 }));
    assert_eq!(file.locations.goal("first"), Some(Location { line: 16, column: 34 }));
    assert_eq!(file.locations.goal("second"), None);
}

#[test]
fn lengths_and_angles_are_those_nearest_to_what_is_written() {
    for (length, text) in [("m", "0.255"), ("cm", "25.5"), ("mm", "255")] {
        let text = SOUND.replace("cm", length).replace("[25, 20]", &format!("[{text}, {text}]"));
        assert_eq!(parse(&text, "s.yaml").unwrap().scene.arm().lengths(), [0.255; 2], "{length}");
    }
    for number in ["20", "+20", "20.", "2e1", "2.0E+1", "200e-1", "020"] {
        let file = parse(&SOUND.replace("[25, 20]", &format!("[25, {number}]")), "s.yaml");
        assert_eq!(file.unwrap().scene.arm().lengths()[1], 0.2, "{number}");
    }
    let radians = SOUND
        .replace("deg", "rad")
        .replace("150", "1.5")
        .replace("velocity: 90", "velocity: 9, acceleration: 8, jerk: 7");
    let joint = parse(&radians, "s.yaml").unwrap().scene.arm().joints()[0];
    let motion = MotionLimits { velocity: Some(9.0), acceleration: Some(8.0), jerk: Some(7.0) };
    assert_eq!(joint.motion, motion);
}

#[test]
fn a_map_alone_needs_neither_obstacles_nor_tasks() {
    let (map, _) = SOUND.split_once("obstacles:").unwrap();
    let scene = parse(map, "s.yaml").unwrap().scene;
    assert!(scene.obstacles().is_empty() && scene.tasks().is_empty());
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_change_nothing() {
    let plain = parse(SOUND, "s.yaml").unwrap();
    assert_eq!(parse(&SOUND.replace('\n', "\r\n"), "s.yaml").unwrap(), plain);
    assert_eq!(parse(&format!("\u{feff}{SOUND}"), "s.yaml").unwrap().scene, plain.scene);
}

#[test]
fn whatever_is_wrong_is_named_with_its_place_and_what_is_allowed() {
    let mut wrong = Vec::new();
    for (old, new, expected) in [
        (
            "elbowroom: 1",
            "elbowroom: 2",
            "s.yaml:1:12: elbowroom: found 2; this elbowroom reads version 1 of the format",
        ),
        (
            "elbowroom: 1\n",
            "",
            "s.yaml:1:1: missing: elbowroom; add the version of the format as the first line, elbowroom: 1",
        ),
        (
            "{length: cm, angle: deg}",
            "{length: inch, angle: deg}",
            "s.yaml:2:17: units.length: found inch; allowed: m, cm, mm",
        ),
        ("{length: cm, angle: deg}", "{length: cm}", "s.yaml:2:8: units: missing: angle"),
        (
            "units: {length: cm, angle: deg}\n",
            "",
            "s.yaml:1:1: missing: units; add what the numbers mean, such as units: {length: mm, angle: deg}",
        ),
        (
            "links:",
            "lniks:",
            "s.yaml:4:3: arm.lniks: no such key; known here: links, joints, half_width, base, self_collision; did you mean links?",
        ),
        ("[25, 20]", "[25, 20, 15]", "s.yaml:6:5: arm.joints: 2 given for 3 links; every link has one joint"),
        ("[25, 20]", "[25]", "s.yaml:4:10: arm.links: 1 given; an arm has 2 to 64 links"),
        ("[25, 20]", "[25, 0]", "s.yaml:4:15: arm.links[1]: found 0; allowed: greater than 0"),
        ("[25, 20]", "[25, -20]", "s.yaml:4:15: arm.links[1]: found -20; allowed: greater than 0"),
        ("[25, 20]", "[25, .nan]", "s.yaml:4:15: arm.links[1]: found .nan; numbers must be finite"),
        ("[25, 20]", "[25, -.Inf]", "s.yaml:4:15: arm.links[1]: found -.Inf; numbers must be finite"),
        ("[25, 20]", "[25, 1e999]", "s.yaml:4:15: arm.links[1]: found 1e999; numbers must be finite"),
        (
            "[25, 20]",
            "[25, 1e12]",
            "s.yaml:4:15: arm.links[1]: found 1e12; allowed: at most 100000000 cm in size",
        ),
        ("[25, 20]", "[25, 1e-5]", "s.yaml:4:15: arm.links[1]: found 1e-5; allowed: at least 0.0001 cm"),
        ("[25, 20]", "[25, \"20\"]", "s.yaml:4:15: arm.links[1]: found the text \"20\"; allowed: a number"),
        ("[25, 20]", "[25, 0x14]", "s.yaml:4:15: arm.links[1]: found 0x14; allowed: a number"),
        ("[25, 20]", "[25, infinity]", "s.yaml:4:15: arm.links[1]: found infinity; allowed: a number"),
        ("[25, 20]", "[25, ]", "s.yaml:4:10: arm.links: 1 given; an arm has 2 to 64 links"),
        ("[25, 20]", "long", "s.yaml:4:10: arm.links: found long; allowed: a list of link lengths"),
        (
            "    - {min: -150, max: 150}\n",
            "",
            "s.yaml:6:5: arm.joints: 1 given for 2 links; every link has one joint",
        ),
        (
            "{min: -150, max: 150}",
            "{min: 150, max: -150}",
            "s.yaml:7:7: arm.joints[1]: min 150 is above max -150",
        ),
        ("{min: -150, max: 150}", "{min: -150}", "s.yaml:7:7: arm.joints[1]: missing: max"),
        (
            "{min: -150, max: 150}",
            "{}",
            "s.yaml:7:7: arm.joints[1]: missing: continuous: true, or min and max",
        ),
        (
            "{min: -150, max: 150}",
            "{continuous: false}",
            "s.yaml:7:20: arm.joints[1].continuous: found false; allowed: true; a joint with limits has min and max instead",
        ),
        (
            "{min: -150, max: 150}",
            "{continuous: true, max: 1}",
            "s.yaml:7:7: arm.joints[1]: found continuous beside min or max; allowed: one or the other",
        ),
        (
            "{min: -150, max: 150}",
            "{min: -1e9, max: 150}",
            "s.yaml:7:13: arm.joints[1].min: found -1e9; allowed: within a thousand revolutions of 0",
        ),
        (
            "{min: -150, max: 150}",
            "{min: -8000, max: 150}",
            "s.yaml:7:7: arm.joints[1]: -8000 to 150 deg is 22.6 revolutions, more than 20: is `units.angle` right? A joint without limits is `continuous: true`",
        ),
        (
            "velocity: 90",
            "velocity: 0",
            "s.yaml:6:36: arm.joints[0].velocity: found 0; allowed: greater than 0",
        ),
        ("half_width: 2", "half_width: -2", "s.yaml:8:15: arm.half_width: found -2; allowed: 0 or more"),
        ("base: [1, -2]", "base: [1]", "s.yaml:9:9: arm.base: found a list of 1; allowed: [x, y]"),
        ("step: 1", "step: 0", "s.yaml:10:42: grid.step: step is 0 cm, it must be finite and greater than 0"),
        (
            "step: 1",
            "step: 1e-9",
            "s.yaml:10:7: grid: 100000000001 x 80000000001 points are more than the 33554432 allowed; make the step larger",
        ),
        (
            "x: [-50, 50]",
            "x: [50, -50]",
            "s.yaml:10:11: grid.x: range x is 50 cm to -50 cm, it must be finite and must not end before it begins",
        ),
        (
            "radius: 5",
            "radius: 0",
            "s.yaml:12:40: obstacles[0].circle.radius: found 0; allowed: greater than 0",
        ),
        (
            "radius: 5",
            "radius: 5, color: red",
            "s.yaml:12:43: obstacles[0].circle.color: no such key; known here: center, radius",
        ),
        (
            "name: post",
            "name: post\n    polygon: [[0, 0], [1, 0], [0, 1]]",
            "s.yaml:12:5: obstacles[0]: an obstacle is one of circle, segment, polygon; found more than one",
        ),
        (
            "circle: {center: [22, 22], radius: 5}",
            "segment: {from: [1, 2], to: [1, 2], radius: 5}",
            "s.yaml:12:14: obstacles[0].segment: both ends are at (1 cm, 2 cm); what has one place and a radius is a circle",
        ),
        (
            "circle: {center: [22, 22], radius: 5}",
            "segment: {from: [1, 2], to: [1, 3], radius: -5}",
            "s.yaml:12:49: obstacles[0].segment.radius: found -5; allowed: 0 or more",
        ),
        (
            "circle: {center: [22, 22], radius: 5}",
            "segment: {from: [1, 2], to: [1]}",
            "s.yaml:12:33: obstacles[0].segment.to: found a list of 1; allowed: [x, y]",
        ),
        (
            "circle: {center: [22, 22], radius: 5}",
            "segment: {from: [1, 2], radius: 5}",
            "s.yaml:12:14: obstacles[0].segment: missing: to",
        ),
        (
            "circle: {center: [22, 22], radius: 5}",
            "box: {center: [22, 22], size: 5}",
            "s.yaml:12:5: obstacles[0].box: no such key; known here: circle, segment, polygon, name, motion, greatest_speed, seen, seen_from, sensing_radius; did you mean polygon?",
        ),
        (
            "radius: 5",
            "radius: 5 mm",
            "s.yaml:12:40: obstacles[0].circle.radius: found 5 mm; allowed: a number alone, its unit stands under units",
        ),
        (
            "circle: {center: [22, 22], radius: 5}",
            "segment: {from: [1, 2], end: [1, 3]}",
            "s.yaml:12:29: obstacles[0].segment.end: no such key; known here: from, to, radius",
        ),
        (
            "  - polygon: [[0, 30], [5, 30], [0, 35]]",
            "  - name: nothing",
            "s.yaml:14:5: obstacles[1]: an obstacle is one of circle, segment, polygon; found none",
        ),
        (
            "[[0, 30], [5, 30], [0, 35]]",
            "[[0, 30], [5, 35], [5, 30], [0, 35]]",
            "s.yaml:14:15: obstacles[1].polygon[0]: the edge from corner 1 crosses or touches the edge from corner 3",
        ),
        (
            "[[0, 30], [5, 30], [0, 35]]",
            "[[0, 30], [5, 30]]",
            "s.yaml:14:14: obstacles[1].polygon: 2 corners, 3 to 10000 are allowed",
        ),
        (
            "  - polygon: [[0, 30], [5, 30], [0, 35]]",
            "  - circle: {center: [0, 0], radius: 1}\n    name: post",
            "s.yaml:15:11: obstacles[1].name: two obstacles are called 'post'",
        ),
        (
            "start: [40, 10]",
            "start: [40, ten]",
            "s.yaml:16:23: tasks.first.start[1]: found ten; allowed: a number",
        ),
        (
            "start: [40, 10]",
            "start: {p: [1, 2]}",
            "s.yaml:16:18: tasks.first.start: found a mapping; allowed: [x, y], or {q: [q1, q2]}",
        ),
        (
            "posture: keep",
            "posture: left",
            "s.yaml:16:59: tasks.first.posture: found left; allowed: up, down, any, keep",
        ),
        (
            "tasks:",
            "task:",
            "s.yaml:15:1: task: no such key; known here: elbowroom, units, arm, grid, obstacles, tasks; did you mean tasks?",
        ),
        (
            "half_width: 2",
            "half_width: 2\n  half_width: 3",
            "s.yaml:9:3: arm.half_width: the key was given before, in line 8",
        ),
        (
            "[25, 20]",
            "&a [25, 20]",
            "s.yaml:4:10: arm.links: anchors, aliases and tags are not read; write the value out",
        ),
        (
            "elbowroom: 1",
            "elbowroom: 2\nfuture: 1",
            "s.yaml:1:12: elbowroom: found 2; this elbowroom reads version 1 of the format",
        ),
        ("[25, 20]", "[25, 1_0]", "s.yaml:4:15: arm.links[1]: found 1_0; allowed: a number"),
        ("[25, 20]", "[25, 1e-300]", "s.yaml:4:15: arm.links[1]: found 1e-300; allowed: at least 0.0001 cm"),
        ("[25, 20]", "[25, *b]", "s.yaml:4:15: anchors, aliases and tags are not read; write the value out"),
        (
            "[25, 20]",
            "[25, !!int 20]",
            "s.yaml:4:15: arm.links[1]: anchors, aliases and tags are not read; write the value out",
        ),
        (
            "{min: -150, max: 150}",
            "{min: -150, max: 1e9}",
            "s.yaml:7:24: arm.joints[1].max: found 1e9; allowed: within a thousand revolutions of 0",
        ),
        (
            "base: [1, -2]",
            "base: [1, 1e9]",
            "s.yaml:9:13: arm.base[1]: found 1e9; allowed: at most 100000000 cm in size",
        ),
        ("y: [-40, 40]", "y: [-40, 40, 1]", "s.yaml:10:25: grid.y: found a list of 3; allowed: [min, max]"),
        (
            "y: [-40, 40]",
            "y: [40, -40]",
            "s.yaml:10:25: grid.y: range y is 40 cm to -40 cm, it must be finite and must not end before it begins",
        ),
        (
            "step: 1",
            "step: 1e-300",
            "s.yaml:10:7: grid: 1e302 x 8e301 points are more than the 33554432 allowed; make the step larger",
        ),
        ("name: post", "name:", "s.yaml:13:9: obstacles[0].name: found nothing; allowed: a name"),
        ("name: post", "name: ~", "s.yaml:13:11: obstacles[0].name: found nothing; allowed: a name"),
        ("name: post", "name: \"\"", "s.yaml:13:11: obstacles[0].name: found the text \"\"; allowed: a name"),
        (
            "name: post",
            "moves: 1",
            "s.yaml:13:5: obstacles[0].moves: no such key; known here: circle, segment, polygon, name, motion, greatest_speed, \
             seen, seen_from, sensing_radius",
        ),
        (
            "[[0, 30], [5, 30], [0, 35]]",
            "[[0, 30], [5, 30], [0, 35], [0, 30]]",
            "s.yaml:14:42: obstacles[1].polygon[3]: corner 4 is corner 1 again; all corners differ, and the last is joined to the first",
        ),
        (
            "[[0, 30], [5, 30], [0, 35]]",
            "[[0, 30], [5, 30], [5, 30], [0, 35]]",
            "s.yaml:14:33: obstacles[1].polygon[2]: corner 3 is corner 2 again; all corners differ, and the last is joined to the first",
        ),
        (
            "[[0, 30], [5, 30], [0, 35]]",
            "[[0, 30], [5, .inf], [0, 35]]",
            "s.yaml:14:28: obstacles[1].polygon[1][1]: found .inf; numbers must be finite",
        ),
        ("first: {start", "\"\": {start", "s.yaml:16:3: tasks: found an empty name; allowed: a name"),
        (
            "first: {start: [40, 10]",
            "\"a\\nb\": {start: [40]",
            "s.yaml:16:19: tasks.a\\nb.start: found a list of 1; allowed: [x, y], or {q: [q1, q2]}",
        ),
        (
            "{q: [90, -30]}",
            "{q: [90, 1e300]}",
            "s.yaml:16:43: tasks.first.goal.q[1]: found 1e300; allowed: at most 572958 deg in size",
        ),
        (
            "{q: [90, -30]}",
            "{q: 90}",
            "s.yaml:16:38: tasks.first.goal.q: found 90; allowed: [q1, q2], a joint angle each",
        ),
        ("[25, 20]", "[25, 20", "s.yaml:5:9: not YAML: a '[' or '{' in the lines before is not closed"),
    ] {
        assert!(SOUND.contains(old), "{old}");
        let found = message(&SOUND.replacen(old, new, 1));
        assert!(found.lines().count() <= 3);
        if found != expected {
            wrong.push(format!("{new}\nfound    {found}\nexpected {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_that_are_no_scene_at_all_are_refused() {
    for (text, expected) in [
        ("", "s.yaml: the file is empty"),
        ("# nothing\n", "s.yaml: the file is empty"),
        ("42", "s.yaml:1:1: found 42; allowed: a mapping with elbowroom, units, arm, grid, obstacles, tasks"),
        ("- 1\n- 2\n", "s.yaml:1:1: found a list of 2; allowed: a mapping"),
        ("a: *b\n", "s.yaml:1:4: "),
        ("? [1]\n: 2\n", "s.yaml:1:3: a key is a list; keys are plain text"),
        ("\t", "s.yaml: the file is empty"),
        ("a: [1, 2\n", "s.yaml:2:1: not YAML: "),
        ("[[[[[[[[[[[[[[[[[", "s.yaml:1:17: "),
    ] {
        let found = message(text);
        assert!(found.starts_with(expected), "{text:?}\nfound    {found}\nexpected {expected}");
    }
    assert!(message(&format!("{SOUND}---\n{SOUND}")).contains("a second document begins"));
}
