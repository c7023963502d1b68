//! What files say of obstacles, and of how they move.

use super::*;

#[test]
fn a_segment_is_a_wall_as_thick_as_it_says() {
    for (written, radius) in [("", 0.0), (", radius: 0", 0.0), (", radius: 2.5", 0.025)] {
        let segment = format!("segment: {{from: [-5, 0.5], to: [1, 20]{written}}}");
        let text = SOUND.replace("polygon: [[0, 30], [5, 30], [0, 35]]", &segment);
        let scene = parse(&text, "s.yaml").unwrap().scene;
        assert_eq!(
            scene.obstacles()[1].shape,
            Shape::segment(Point::new(-0.05, 0.005), Point::new(0.01, 0.2), radius).unwrap()
        );
    }
}

#[test]
fn obstacles_that_move_are_read_with_their_units() {
    let entry = |extra: &str| format!("  - {{circle: {{center: [22, 22], radius: 5}}, name: post, {extra}}}");
    let with = |extra: &str| {
        SOUND.replacen("  - circle: {center: [22, 22], radius: 5}\n    name: post", &entry(extra), 1)
    };
    // Of both obstacles: the polygon stands still.
    let motions = |text: &str| {
        let scene = parse(text, "s.yaml").unwrap().scene;
        scene.obstacles().iter().map(|obstacle| obstacle.motion.clone()).collect::<Vec<_>>()
    };
    let first_moves = |extra: &str, course, sight, greatest_speed| {
        let motion = ObstacleMotion::new(course, sight, greatest_speed).unwrap();
        assert_eq!(motions(&with(extra)), [Some(motion), None], "{extra}");
    };
    let waypoints = "motion: {waypoints: [{time: 0, shift: [0, 0]}, {time: 2, shift: [10, -5]}]}";
    let shift = |x, y| Vector::new(x, y);
    let course = Course::Waypoints(vec![
        Waypoint { time: 0.0, shift: shift(0.0, 0.0) },
        Waypoint { time: 2.0, shift: shift(0.1, -0.05) },
    ]);
    first_moves(waypoints, course, Sight::Always, None);
    let drift = Course::Drift { start: 1.5, velocity: shift(0.0, 0.2) };
    let late = "motion: {velocity: [0, 20], start: 1.5}, seen: false, seen_from: 3, greatest_speed: 25";
    first_moves(late, drift, Sight::From(3.0), Some(0.25));
    let near = "motion: {chases: tip, keep_off: 2}, greatest_speed: 5, seen: false, sensing_radius: 30";
    first_moves(near, Course::Chase { keep_off: 0.02 }, Sight::Within(0.3), Some(0.05));
    assert_eq!(motions(SOUND), [None, None]);
    for (extra, wrong) in [
        (
            "motion: {}",
            "motion: found a mapping; allowed: one of waypoints, velocity (with or without start), chases (with or without keep_off)",
        ),
        (
            "motion: {velocity: [1, 0], chases: tip}",
            "motion: found a mapping; allowed: one of waypoints, velocity (with or without start), chases (with or without keep_off)",
        ),
        ("motion: {waypoints: []}", "motion: 0 waypoints, 1 to 10000 are allowed"),
        ("motion: {chases: tip}", "motion: missing: greatest_speed, beside chases"),
        ("motion: {chases: base}, greatest_speed: 1", "motion.chases: found base; allowed: tip"),
        (
            "motion: {velocity: [3, 4]}, greatest_speed: 4",
            "greatest_speed: the obstacle moves at up to 5 cm/s, the greatest speed declared is 4 cm/s",
        ),
        ("seen: false", "seen: found false; allowed: only beside motion"),
        (
            "motion: {velocity: [1, 0]}, seen: false",
            "seen: missing: seen_from or sensing_radius, beside seen: false",
        ),
        ("motion: {velocity: [1, 0]}, seen_from: 3", "seen_from: found 3; allowed: only beside seen: false"),
        (
            "motion: {velocity: [1, 0]}, speed: 3",
            "speed: no such key; known here: circle, segment, polygon, name, motion, greatest_speed, seen, seen_from, sensing_radius",
        ),
        (
            "motion: {waypoints: [{time: 1, shift: [0, 0]}, {time: 1, shift: [1, 0]}]}",
            "motion: waypoint 1 is at 1 s, which is not after the 1 s of the one before",
        ),
    ] {
        let found = after_place(&message(&with(extra)));
        assert!(found.starts_with(&format!("obstacles[0].{wrong}")), "{extra}\n{found}");
    }
}

/// Without file, line and column.
fn after_place(message: &str) -> String {
    message.splitn(4, ':').nth(3).unwrap_or(message).trim_start().to_owned()
}
