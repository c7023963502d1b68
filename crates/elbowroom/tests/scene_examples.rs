//! The example scenes say what their files say.

use std::path::Path;

use elbowroom::arm::JointLimits;
use elbowroom::geometry::{Point, Shape};
use elbowroom::scene::{Place, TaskPosture, parse};

/// The text of an example scene.
fn example(name: &str) -> std::io::Result<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../python/elbowroom/scenes");
    std::fs::read_to_string(folder.join(format!("{name}.yaml")))
}

#[test]
fn all_scenes_of_the_repository_are_sound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../python/elbowroom/scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "yaml") {
            let file = parse(&std::fs::read_to_string(&path).unwrap(), "s.yaml");
            assert!(file.is_ok(), "{}: {}", path.display(), file.unwrap_err());
            seen += 1;
        }
    }
    assert!(seen >= 4);
}

#[test]
fn the_scenes_of_the_paper_are_read_as_they_are_written() {
    let scene = |name: &str| parse(&example(name).unwrap(), name).unwrap().scene;
    let quarter = std::f64::consts::FRAC_PI_2;
    let tasks = [([0.4, 0.1], [-0.45, -0.15]), ([0.3, -0.3], [0.15, 0.45])]
        .map(|(start, goal)| [start, goal].map(|[x, y]: [f64; 2]| Place::Tip(Point::new(x, y))));
    let posts = [[22.0, 22.0], [-8.0, 40.0], [-38.0, 18.0], [-20.0, -42.0], [38.0, -14.0]];
    let bend = 150f64.to_radians();
    for (name, joints, obstacles) in [
        ("paper-standin", [JointLimits::Continuous, JointLimits::Range { min: -bend, max: bend }], 5),
        (
            "paper-table1",
            [
                JointLimits::Range { min: 0.0, max: 4.0 * quarter },
                JointLimits::Range { min: -quarter, max: quarter },
            ],
            5,
        ),
        ("paper-empty", [JointLimits::Continuous, JointLimits::Range { min: -quarter, max: quarter }], 0),
        ("narrow", [JointLimits::Continuous, JointLimits::Range { min: -bend, max: bend }], 12),
    ] {
        let scene = scene(name);
        assert_eq!(scene.arm().lengths(), [0.25, 0.25], "{name}");
        assert_eq!((scene.arm().half_width(), scene.arm().base()), (0.0, Point::new(0.0, 0.0)), "{name}");
        assert!(scene.arm().joints().iter().map(|joint| joint.limits).eq(joints), "{name}");
        assert_eq!(
            (scene.grid().columns(), scene.grid().rows(), scene.grid().step()),
            (101, 101, 0.01),
            "{name}"
        );
        assert_eq!(scene.grid().origin(), Point::new(-0.5, -0.5), "{name}");
        assert_eq!(scene.obstacles().len(), obstacles, "{name}");
        for (task, (name, [start, goal])) in scene.tasks().iter().zip(["first", "second"].iter().zip(&tasks))
        {
            assert_eq!(
                (task.name.as_str(), &task.start, &task.goal, task.posture),
                (*name, start, goal, TaskPosture::Any)
            );
        }
        assert_eq!(scene.tasks().len(), 2);
        if obstacles == 5 {
            for (obstacle, [x, y]) in scene.obstacles().iter().zip(posts) {
                let center = Point::new(x / 100.0, y / 100.0);
                assert_eq!(Ok(&obstacle.shape), Shape::circle(center, 0.05).as_ref());
            }
        }
    }
    let corners = scene("narrow")
        .obstacles()
        .iter()
        .map(|obstacle| obstacle.shape.vertices().len())
        .filter(|&corners| corners > 1)
        .collect::<Vec<_>>();
    assert_eq!(corners, [3, 4, 5, 6]);
}
