//! What a replanner is told and made for: what does not fit its scene is refused, what moves does not count for the goal.

use elbowroom::arm::Joint;
use elbowroom::free_space::Reason;
use elbowroom::geometry::Vector;
use elbowroom::online::{
    Decision, KnownError, KnownMotion, ReplanError, Replanner, World, goal_configurations,
};
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Scene, Sight, TwoLinkError};
use elbowroom::trajectory::State;

use crate::build;

fn motion(course: Course) -> ObstacleMotion {
    ObstacleMotion::new(course, Sight::Always, Some(0.5)).unwrap()
}

fn chasing(x: f64, y: f64) -> Obstacle {
    Obstacle { motion: Some(motion(Course::Chase { keep_off: 0.02 })), ..build::circle(x, y, 0.05) }
}

/// The first two obstacles chase, the last one stands still at an angle of 2 rad.
fn scene(links: usize) -> Scene {
    let arm = build::arm_of(&vec![0.25; links], 0.01, &vec![Joint::CONTINUOUS; links]);
    let still = build::circle(0.3 * 2.0_f64.cos(), 0.3 * 2.0_f64.sin(), 0.05);
    let obstacles = vec![chasing(-0.3, 0.0), chasing(0.0, -0.3), still];
    Scene::new(arm, build::grid(0.5, 0.05), obstacles, Vec::new()).unwrap()
}

fn at(q: [f64; 2]) -> Place {
    Place::Configuration(q.into())
}

#[test]
fn motions_of_obstacles_that_stand_still_or_are_not_there_are_refused() {
    let start = [0.0, 0.5];
    let mut replanner = Replanner::new(scene(2), start, &at([1.0, 0.5]), 1).unwrap();
    let absent = |obstacle| KnownMotion { obstacle, motion: motion(Course::Absent) };
    let mut update = |known: &[KnownMotion]| replanner.update(known, 0.0, &State::rest(&start), &|| true);
    for obstacle in [2, 3, usize::MAX] {
        assert_eq!(update(&[absent(0), absent(obstacle)]), Err(KnownError::StandsStill { obstacle }));
    }
    assert_eq!(update(&[absent(1), absent(0), absent(1)]), Err(KnownError::Twice { obstacle: 1 }));
    // A refusal leaves nothing behind.
    let update = update(&[absent(0), absent(1)]).unwrap();
    assert!(update.reaches_goal && update.verdict.is_safe());
}

#[test]
fn obstacles_that_are_left_out_stand_where_the_scene_has_them() {
    let start = [0.0, 0.5];
    // The goal lies under the first obstacle.
    let mut replanner = Replanner::new(scene(2), start, &at([std::f64::consts::PI, 0.5]), 1).unwrap();
    let update = replanner.update(&[], 0.0, &State::rest(&start), &|| true).unwrap();
    assert!(!update.reaches_goal && update.verdict.is_safe());
    let gone = [0, 1].map(|obstacle| KnownMotion { obstacle, motion: motion(Course::Absent) });
    let update = replanner.update(&gone, 0.0, &State::rest(&start), &|| true).unwrap();
    assert!(update.reaches_goal && matches!(update.decision, Decision::New(_)));
}

#[test]
fn among_obstacles_of_unknown_course_a_new_motion_is_certified_among_all() {
    let start = [0.0, 0.5];
    let mut replanner = Replanner::new(scene(2), start, &at([1.0, 0.5]), 1).unwrap();
    let unknown = Course::Unknown { seen: 0.0, shift: Vector::new(0.0, 0.0) };
    let known = [0, 1].map(|obstacle| KnownMotion { obstacle, motion: motion(unknown.clone()) });
    let update = replanner.update(&known, 0.0, &State::rest(&start), &|| true).unwrap();
    let Decision::New(trajectory) = update.decision else { panic!("{:?}", update.decision) };
    assert!(trajectory.verdict().is_safe() && update.verdict.is_safe());
    assert_eq!(trajectory.motion(), replanner.motion());
}

#[test]
fn an_arm_rests_at_the_goal_however_its_joints_count() {
    let start = [0.0, 0.5];
    let replanner = Replanner::new(scene(2), start, &at([1.0, 0.5]), 1).unwrap();
    assert!(!replanner.reaches_goal() && !replanner.is_at_goal(&State::rest(&start)));
    let turned = [1.0 + std::f64::consts::TAU, 0.5 - std::f64::consts::TAU];
    assert!(replanner.is_at_goal(&State::rest(&turned)));
    let passing = State { velocity: vec![0.1, 0.0], ..State::rest(&[1.0, 0.5]) };
    assert!(!replanner.is_at_goal(&passing));
    assert!(!replanner.is_at_goal(&State::rest(&[1.0, 0.5, 0.0])));
    let there = Replanner::new(scene(2), turned, &at([1.0, 0.5]), 1).unwrap();
    assert!(there.reaches_goal());
}

#[test]
fn no_replanner_for_other_arms_and_for_goals_that_are_blocked_for_good() {
    let made = |scene: Scene, goal: Place| Replanner::new(scene, [0.0, 0.5], &goal, 1).map(|_| ());
    let three = Place::Configuration([0.0, 0.5, 0.0].into());
    assert_eq!(made(scene(3), three), Err(ReplanError::Arm(TwoLinkError::Links { found: 3 })));
    let under_a_chaser = at([std::f64::consts::PI, 0.5]);
    assert_eq!(goal_configurations(&scene(2), &under_a_chaser), Ok(vec![[std::f64::consts::PI, 0.5]]));
    assert_eq!(made(scene(2), under_a_chaser), Ok(()));
    let Err(ReplanError::Goal(refused)) = made(scene(2), at([2.0, 0.0])) else { panic!("it is blocked") };
    // By the obstacle's number in the scene.
    assert!(matches!(refused.reasons[..], [(None, Reason::Collision { obstacle: 2, .. })]), "{refused}");
}

#[test]
fn a_world_of_many_links_goes_on_too() {
    let mut world = World::new(scene(3));
    let q = [0.0, 0.5, 0.0];
    world.advance(0.1, &q);
    let tip = world.scene().arm().tip(&q);
    for (known, obstacle) in world.seen_from(&q).iter().zip(0..) {
        assert_eq!(known.obstacle, obstacle);
        let Course::Unknown { seen, shift } = *known.motion.course() else { panic!("{known:?}") };
        assert_eq!((seen, shift), (0.1, world.shifts()[obstacle]));
        assert!((shift.length() - 0.05).abs() < 1e-12, "as fast as it may, towards {tip:?}");
    }
    assert!(world.obstacles().iter().all(|obstacle| obstacle.motion.is_none()));
}
