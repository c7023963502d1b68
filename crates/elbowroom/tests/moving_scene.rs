//! Scenes in which something moves: planners refuse them, the verifier sees the motion, nothing is certified.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[expect(dead_code, reason = "shared between tests")]
mod chain_judge;
#[path = "judge/distance.rs"]
mod distance;

use build::example;
use chain_judge::clearance;
use elbowroom::geometry::Vector;
use elbowroom::path::{straight_move_is_free, straight_move_keeps};
use elbowroom::planners::{self, DstarPlanner, DstarPsoPlanner, plan_as_in_paper};
use elbowroom::planning::{Pace, PlanError, PlanSettings, Planner, Unwatched, plan};
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Scene, Sight, TaskPosture};
use elbowroom::trajectory::Motion;
use elbowroom::verify::{Against, Trajectory, Verdict, VerifySettings, Violation, verify};

/// The examples, with the first obstacle that moves in each.
const SCENES: [(&str, usize, &str); 2] = [("moving-one", 2, "shuttle"), ("moving-three", 1, "rising")];

/// The scene as it is before anything moves.
fn still(scene: &Scene) -> Scene {
    let stop = |obstacle: &Obstacle| Obstacle { motion: None, ..obstacle.clone() };
    scene.with_obstacles(scene.obstacles().iter().map(stop).collect()).unwrap()
}

/// The scene with all that moves put where it is at `time` (s).
fn at(scene: &Scene, time: f64) -> Scene {
    let there = |obstacle: &Obstacle| {
        let by = obstacle.motion.as_ref().map_or(Vector::new(0.0, 0.0), |m| m.course().shift_at(time));
        Obstacle::still(obstacle.shape.shifted(by))
    };
    scene.with_obstacles(scene.obstacles().iter().map(there).collect()).unwrap()
}

/// Least clearance at many instants (m).
fn least_clearance(scene: &Scene, motion: &Motion) -> f64 {
    const LOOKS: u32 = 4_000;
    let look = |i: u32| {
        let time = motion.start() + motion.duration() * f64::from(i) / f64::from(LOOKS);
        clearance(&at(scene, time), &motion.at(time).position)
    };
    (0..=LOOKS).map(look).fold(f64::INFINITY, f64::min)
}

/// Every planner by its name says that this obstacle moves.
fn assert_refused(scene: &Scene, obstacle: usize, called: &str) {
    for planner in planners::all() {
        let name = planner.name();
        let task = &scene.tasks()[0];
        let refused = plan(scene, task, &*planner, &PlanSettings::default(), &Unwatched).unwrap_err();
        assert_eq!(refused, PlanError::Moving { obstacle, name: Some(called.to_owned()) }, "{name}");
        assert!(refused.to_string().contains(&format!("obstacle {} ({called})", obstacle + 1)), "{refused}");
    }
}

#[test]
fn every_planner_refuses_them_and_names_what_moves() {
    for (name, obstacle, called) in SCENES {
        let scene = example(name);
        assert_eq!(scene.first_moving(), Some(obstacle), "{name}");
        assert_refused(&scene, obstacle, called);
        let in_paper = plan_as_in_paper(&scene, &scene.tasks()[0], &Default::default(), &Unwatched);
        assert!(in_paper.unwrap_err().to_string().contains(called), "{name}");
    }
}

#[test]
fn every_planner_refuses_them_for_more_links_too() {
    let scene = example("three-links");
    let course = Course::Drift { start: 0.0, velocity: Vector::new(0.1, 0.0) };
    let motion = ObstacleMotion::new(course, Sight::Always, None).unwrap();
    let cart =
        Obstacle { name: Some("cart".to_owned()), motion: Some(motion), ..build::circle(5.0, 5.0, 0.1) };
    assert_refused(&build::with_obstacle(&scene, cart), scene.obstacles().len(), "cart");
}

/// Motions planned among what stands still, faster and slower, so that what moves meets the arm at different places.
fn planned(still: &Scene) -> Vec<(String, Motion)> {
    // The second one leads below the base, where most of what moves passes.
    let below = build::task("below", build::tip(0.35, -0.25), build::tip(-0.3, -0.3), TaskPosture::Any);
    let mut motions = Vec::new();
    for task in [&still.tasks()[0], &below] {
        for seconds in [4.0, 5.0, 6.0, 8.0, 10.0, 12.0] {
            for planner in [&DstarPlanner as &dyn Planner, &DstarPsoPlanner::default()] {
                let case = format!("{}, {}, {seconds} s", task.name, planner.name());
                let settings = PlanSettings { pace: Pace::Duration(seconds), ..PlanSettings::default() };
                match plan(still, task, planner, &settings, &Unwatched) {
                    Ok(plan) => motions.push((case, plan.trajectory().motion().clone())),
                    Err(PlanError::TooFast { .. }) => {}
                    Err(other) => panic!("{case}: {other}"),
                }
            }
        }
    }
    motions
}

/// That the verdict tells the first contact there is, and none but with what moves.
fn assert_tells_the_contact(scene: &Scene, motion: &Motion, verdict: &Verdict, case: &str) {
    let clear_at = |time: f64| clearance(&at(scene, time), &motion.at(time).position);
    let [Violation::Contact { time: first, .. }, ..] = verdict.violations[..] else {
        panic!("{case}: {verdict:?}")
    };
    assert!(clear_at(first).abs() < 1e-6, "{case}: {} m at {first} s", clear_at(first));
    let mut before = (0..1_000).map(|i| clear_at(first * f64::from(i) / 1_000.0));
    assert!(before.all(|clear| clear > 0.0), "{case}: earlier than {first} s");
    for violation in &verdict.violations {
        let Violation::Contact { time, against: Against::Obstacle(obstacle), .. } = *violation else {
            panic!("{case}: {violation:?}")
        };
        assert!(
            scene.obstacles()[obstacle].motion.is_some() && clear_at(time) < 1e-6,
            "{case}: {violation:?}"
        );
    }
}

#[test]
fn what_was_planned_among_what_stands_still_is_refused_where_it_moves() {
    for (name, ..) in SCENES {
        let (scene, still) = (example(name), still(&example(name)));
        let (mut refused, mut safe) = (0, 0);
        for (case, motion) in planned(&still) {
            let (case, ask) = (format!("{name}, {case}"), VerifySettings::default());
            assert!(Trajectory::certify(&still, motion.clone(), &ask).is_ok(), "{case}");
            let verdict = verify(&scene, &motion, &ask);
            let certified = Trajectory::certify(&scene, motion.clone(), &ask);
            let nearest = least_clearance(&scene, &motion);
            assert!(nearest.abs() > 1e-6, "{case} is too close a call: {nearest} m");
            if nearest > 0.0 {
                assert!(verdict.is_safe() && certified.is_ok(), "{case}: {nearest} m, {verdict:?}");
                safe += 1;
            } else {
                assert_tells_the_contact(&scene, &motion, &verdict, &case);
                let found = certified.map_err(|verdict| verdict.violations);
                assert_eq!(found, Err(verdict.violations), "{case}");
                refused += 1;
            }
        }
        assert!(refused > 2 && safe > 2, "{name}: {refused} refused, {safe} safe");
    }
}

#[test]
fn no_straight_move_is_certified_where_something_moves() {
    for (name, ..) in SCENES {
        let (scene, still) = (example(name), still(&example(name)));
        let (from, to) = ([0.0, 0.3], [0.1, 0.4]);
        assert!(straight_move_is_free(&still, &from, &to) && straight_move_keeps(&still, &from, &to, 0.001));
        assert!(
            !straight_move_is_free(&scene, &from, &to) && !straight_move_keeps(&scene, &from, &to, 0.001)
        );
    }
    // However far away it is, and even where it is not there as far as anyone knows.
    for course in [Course::Absent, Course::Drift { start: 0.0, velocity: Vector::new(1.0, 0.0) }] {
        let motion = ObstacleMotion::new(course, Sight::Always, None).unwrap();
        let far = Obstacle { motion: Some(motion), ..build::circle(1e5, 1e5, 0.1) };
        for links in [2, 3] {
            let still = build::scene(build::arm(&vec![0.3; links]), Vec::new());
            let (from, to) = (vec![0.1; links], vec![0.2; links]);
            assert!(straight_move_is_free(&still, &from, &to));
            assert!(!straight_move_is_free(&build::with_obstacle(&still, far.clone()), &from, &to));
        }
    }
}
