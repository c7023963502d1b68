//! The scene: which parts make none, whether it is built at once or changed.

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use build::{circle, task, tip};
use elbowroom::arm::{Joint, MotionLimits};
use elbowroom::geometry::{Point, Shape, ShapeError, Vector};
use elbowroom::scene::{
    Course, Obstacle, ObstacleMotion, Place, Scene, SceneProblem, Sight, Task, TaskPosture, TwoLinkError,
};

fn three_links(obstacles: Vec<Obstacle>, tasks: Vec<Task>) -> Result<Scene, SceneProblem> {
    Scene::new(build::arm(&[0.3; 3]), build::grid(1.0, 0.1), obstacles, tasks)
}

fn between(start: Place, goal: Place) -> Task {
    task("there", start, goal, TaskPosture::Any)
}

fn joints(q: &[f64]) -> Place {
    Place::Configuration(q.into())
}

#[test]
fn shapes_that_are_none_are_refused() {
    let at = Point::new;
    for (x, y, radius) in [
        (f64::NAN, 0.0, 0.1),
        (0.0, f64::NAN, 0.1),
        (f64::INFINITY, 0.0, 0.1),
        (0.0, -2e6, 0.1),
        (0.0, 0.0, -0.1),
        (0.0, 0.0, 0.0),
        (0.0, 0.0, f64::NAN),
        (0.0, 0.0, f64::INFINITY),
    ] {
        let refused = Shape::circle(at(x, y), radius);
        assert!(matches!(refused, Err(ShapeError::Circle { .. })), "({x}, {y}), {radius}: {refused:?}");
        if (x, y, radius) != (0.0, 0.0, 0.0) {
            for [from, to] in [[at(x, y), at(1.0, 1.0)], [at(1.0, 1.0), at(x, y)]] {
                let refused = Shape::segment(from, to, radius);
                assert!(matches!(refused, Err(ShapeError::Segment { .. })), "{from:?} {to:?} {radius}");
            }
            let refused = Shape::rounded_polygon(vec![at(x, y), at(1.0, 0.0), at(0.0, 1.0)], radius);
            let known = matches!(refused, Err(ShapeError::Rounding { .. } | ShapeError::NotFinite { .. }));
            assert!(known, "{refused:?}");
        }
    }
    assert!(Shape::segment(at(0.0, 0.0), at(1.0, 1.0), 0.0).is_ok());
    let point = Shape::segment(at(0.5, 0.1), at(0.5, 0.1), 0.1).unwrap_err();
    assert_eq!(
        point.to_string(),
        "both ends are at (0.5 m, 0.1 m); what has one place and a radius is a circle"
    );
    let far = vec![at(2e6, 0.0), at(3e6, 0.0), at(0.0, 1.0)];
    assert!(Shape::rounded_polygon(far.clone(), 0.0).is_ok());
    assert_eq!(Shape::rounded_polygon(far, 0.1), Err(ShapeError::Rounding { radius: 0.1 }));
}

#[test]
fn tasks_of_another_arm_are_refused() {
    let sound = three_links(Vec::new(), vec![between(joints(&[0.1; 3]), tip(0.5, 0.1))]).unwrap();
    for found in [0, 1, 2, 4, 64] {
        let q = vec![0.1; found];
        for task in [between(joints(&q), tip(0.5, 0.1)), between(tip(0.5, 0.1), joints(&q))] {
            for refused in [three_links(Vec::new(), vec![task.clone()]), sound.with_tasks(vec![task])] {
                let task = "there".to_owned();
                assert_eq!(refused, Err(SceneProblem::Joints { task, found, links: 3 }));
            }
        }
    }
    // The same tasks with an arm of fewer links.
    let refused = sound.with_arm(build::arm(&[0.3; 2]));
    assert_eq!(refused, Err(SceneProblem::Joints { task: "there".to_owned(), found: 3, links: 2 }));
    assert!(sound.with_arm(build::arm(&[0.2, 0.3, 0.4])).is_ok());
}

#[test]
fn places_that_are_no_numbers_are_refused() {
    let good = tip(0.5, 0.1);
    for bad in [
        tip(f64::NAN, 0.0),
        tip(0.0, f64::INFINITY),
        tip(2e6, 0.0),
        joints(&[0.0, f64::NAN, 0.0]),
        joints(&[f64::NEG_INFINITY, 0.0, 0.0]),
        joints(&[0.0, 0.0, 1e5]),
    ] {
        for task in [between(bad.clone(), good.clone()), between(good.clone(), bad.clone())] {
            let refused = three_links(Vec::new(), vec![task]);
            assert_eq!(refused, Err(SceneProblem::Place { task: "there".to_owned() }), "{bad:?}");
        }
    }
}

#[test]
fn names_that_come_twice_are_refused() {
    let named = |name: &str| Obstacle { name: Some(name.to_owned()), ..circle(0.5, 0.5, 0.1) };
    assert!(three_links(vec![named("a"), circle(0.1, 0.1, 0.1), named("b")], Vec::new()).is_ok());
    assert!(three_links(vec![circle(0.1, 0.1, 0.1); 2], Vec::new()).is_ok());
    let twice = three_links(vec![named("a"), named("b"), named("a")], Vec::new());
    assert_eq!(twice, Err(SceneProblem::ObstacleName { name: "a".to_owned() }));
    let asked = |name: &str| task(name, tip(0.5, 0.1), tip(0.1, 0.5), TaskPosture::Any);
    let twice = three_links(Vec::new(), vec![asked("a"), asked("a")]);
    assert_eq!(twice, Err(SceneProblem::TaskName { name: "a".to_owned() }));
    assert!(matches!(three_links(Vec::new(), vec![asked("")]), Err(SceneProblem::TaskName { .. })));
}

#[test]
fn closed_forms_are_of_two_links_among_what_stands_still() {
    let still = build::scene(build::arm(&[0.3; 2]), vec![circle(0.5, 0.5, 0.1), circle(0.9, 0.9, 0.1)]);
    let two = still.two_link().unwrap();
    assert_eq!((two.arm().lengths(), two.obstacles().len(), still.first_moving()), ([0.3; 2], 2, None));
    assert_eq!(two.scene(), &still);
    let three = still.with_arm(build::arm(&[0.3; 3])).unwrap();
    assert!(matches!(three.two_link(), Err(TwoLinkError::Links { found: 3 })));

    let drift = Course::Drift { start: 0.0, velocity: Vector::new(0.1, 0.0) };
    for course in [drift, Course::Absent] {
        let motion = ObstacleMotion::new(course, Sight::Always, None).unwrap();
        let mut obstacles = still.obstacles().to_vec();
        obstacles[1].motion = Some(motion);
        let moving = still.with_obstacles(obstacles.clone()).unwrap();
        assert_eq!(moving.first_moving(), Some(1));
        let refused = moving.two_link().unwrap_err();
        assert_eq!(refused, TwoLinkError::Moving { obstacle: 1, name: None });
        assert!(refused.to_string().contains("obstacle 2 moves"), "{refused}");
        obstacles[1].name = Some("cart".to_owned());
        let refused = still.with_obstacles(obstacles).unwrap().two_link().unwrap_err();
        assert!(refused.to_string().contains("obstacle 2 (cart) moves"), "{refused}");
    }
}

#[test]
fn a_changed_scene_is_the_same_but_for_what_was_changed() {
    let motion = MotionLimits::default();
    let scene = build::paper(build::stops(0.0, 3.0), 2.0, motion, &build::CIRCLES, 0.01);
    let arm = build::arm_of(&[0.2, 0.3], 0.01, &[Joint::CONTINUOUS; 2]);
    let other = scene.with_arm(arm.clone()).unwrap();
    assert_eq!((other.arm(), other.grid()), (&arm, scene.grid()));
    assert_eq!((other.obstacles(), other.tasks()), (scene.obstacles(), scene.tasks()));
    let other = scene.with_grid(build::grid(1.0, 0.5));
    assert_eq!((other.arm(), other.grid()), (scene.arm(), &build::grid(1.0, 0.5)));
    let other = scene.with_obstacles(vec![circle(0.1, 0.2, 0.3)]).unwrap();
    assert_eq!((other.obstacles(), other.tasks()), (&[circle(0.1, 0.2, 0.3)][..], scene.tasks()));
    let other = scene.with_tasks(Vec::new()).unwrap();
    assert_eq!((other.obstacles(), other.tasks().len()), (scene.obstacles(), 0));
    assert_eq!(scene.task("second"), scene.tasks().get(1));
    assert_eq!(scene.task("third"), None);
}
