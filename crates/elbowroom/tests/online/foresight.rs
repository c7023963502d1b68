//! What the replanner foresees: obstacles that come where the arm would stand, that will leave the way, that close a trap.

use elbowroom::arm::{Joint, JointLimits, MotionLimits};
use elbowroom::geometry::Vector;
use elbowroom::online::{Decision, NoRoute, Replanner, Roadmap, Update, World};
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Scene, Sight, Task, TaskPosture, Waypoint};
use elbowroom::trajectory::{Motion, State};

use crate::{build, judge};

/// Time between two updates (s).
const STEP: f64 = 0.05;

/// Where the first link cannot pass an obstacle (m).
const NEAR: f64 = 0.15;

/// Where no link gets to (m).
const FAR: f64 = 0.8;

/// A disc in the direction of `angle` (rad) from the base, `from` away from it (m), that the arm knows of since `sight`; it
/// goes straight to or from the base, from rest to rest, to be so far away at `places`' times (s, m).
fn disc(angle: f64, sight: Sight, places: &[[f64; 2]]) -> Obstacle {
    let first = places[0][1];
    let waypoints = places
        .iter()
        .map(|&[time, away]| Waypoint { time, shift: Vector::polar(away - first, angle) })
        .collect();
    let motion = ObstacleMotion::new(Course::Waypoints(waypoints), sight, None).unwrap();
    Obstacle { motion: Some(motion), ..build::circle(first * angle.cos(), first * angle.sin(), 0.04) }
}

/// Stops with which the arm cannot go all the way round.
fn wide() -> [JointLimits; 2] {
    [build::stops(-0.4, 4.5), build::stops(-2.6, 2.6)]
}

fn scene(limits: [JointLimits; 2], obstacles: Vec<Obstacle>) -> Scene {
    let motion = MotionLimits { velocity: Some(1.5), acceleration: Some(4.0), jerk: Some(40.0) };
    let joints = limits.map(|limits| Joint { limits, motion });
    let arm = build::arm_of(&[0.25, 0.25], 0.01, &joints);
    Scene::new(arm, build::grid(0.5, 0.02), obstacles, Vec::new()).unwrap()
}

fn replanner(scene: &Scene, start: [f64; 2], goal: [f64; 2]) -> Replanner {
    Replanner::new(scene.clone(), start, &Place::Configuration(goal.into()), 1).unwrap()
}

/// The first update, at 0 s.
fn first_update(scene: &Scene, start: [f64; 2], goal: [f64; 2]) -> (Update, Motion) {
    let mut replanner = replanner(scene, start, goal);
    let known = World::new(scene.clone()).seen_from(&start);
    let update = replanner.update(&known, 0.0, &State::rest(&start), &|| true).unwrap();
    (update, replanner.motion().clone())
}

/// Clearance of an arm that runs `motion` (m), the least until `end` (s).
fn least_clearance(scene: &Scene, motion: &Motion, end: f64) -> f64 {
    let mut world = World::new(scene.clone());
    let looks = (0..=(end / 0.01) as u32).map(|look| {
        let time = 0.01 * f64::from(look);
        let q = motion.at(time).position;
        world.advance(time, &q);
        let now = scene.with_obstacles(world.obstacles()).unwrap();
        judge::clearance(&now, [q[0], q[1]])
    });
    looks.fold(f64::INFINITY, f64::min)
}

#[test]
fn no_motion_is_safe_at_whose_end_something_is_known_to_arrive() {
    let (start, goal) = ([0.3, 0.5], [2.0, 0.5]);
    let (undisturbed, motion) = first_update(&scene(wide(), Vec::new()), start, goal);
    assert!(undisturbed.reaches_goal && undisturbed.verdict.is_safe());
    for after in [1.0, 3.0, 7.0] {
        let touch = motion.end() + after;
        // It goes again: a stay of eight seconds is what is promised, not one for ever.
        let comes = [[0.0, FAR], [touch - 1.0, FAR], [touch, NEAR], [touch + 1.0, FAR]];
        let scene = scene(wide(), vec![disc(goal[0], Sight::Always, &comes)]);
        let (update, motion) = first_update(&scene, start, goal);
        assert!(update.verdict.is_safe(), "{after} s: the arm may stay where it is");
        let clearance = least_clearance(&scene, &motion, motion.end() + 8.0);
        assert!(clearance > 0.0, "{after} s: called safe, {clearance} m");
    }
}

#[test]
fn the_arm_sees_that_the_way_will_be_free() {
    let (start, goal) = ([0.3, 0.5], [2.8, -0.5]);
    let door = std::f64::consts::FRAC_PI_2;
    let leaves = [[0.0, NEAR], [1.0, NEAR], [3.0, FAR]];
    let scene = scene(wide(), vec![disc(door, Sight::Always, &leaves)]);
    let task = Task {
        name: "through".to_owned(),
        start: Place::Configuration(start.into()),
        goal: Place::Configuration(goal.into()),
        posture: TaskPosture::Any,
        clearance: 0.0,
    };
    let now = scene.with_obstacles(World::new(scene.clone()).obstacles()).unwrap();
    let mut roadmap = Roadmap::new(now, &task).unwrap();
    assert_eq!(roadmap.path_from(&start), Err(NoRoute::NotFound), "the door is shut now");
    let (update, motion) = first_update(&scene, start, goal);
    assert!(update.reaches_goal && update.verdict.is_safe());
    assert!(least_clearance(&scene, &motion, motion.end() + 8.0) > 0.0);
}

#[test]
fn an_arm_that_cannot_get_away_for_eight_seconds_is_told_so() {
    // It can come to rest at once, but not stay anywhere.
    let comes = disc(0.3, Sight::Always, &[[0.0, FAR], [3.0, FAR], [5.0, NEAR]]);
    let scene = scene([build::stops(0.2, 0.4), build::stops(0.4, 0.6)], vec![comes]);
    let (update, _) = first_update(&scene, [0.3, 0.5], [0.35, 0.5]);
    assert!(!update.verdict.is_safe() && !matches!(update.decision, Decision::New(_)));
}

/// Runs the replanner for 25 s: every motion is safe, and the arm touches nothing; where it was at each update.
fn followed(scene: &Scene, start: [f64; 2], goal: [f64; 2]) -> (Replanner, Vec<[f64; 2]>) {
    let mut replanner = replanner(scene, start, goal);
    let mut world = World::new(scene.clone());
    let mut state = State::rest(&start);
    let mut places = Vec::new();
    for step in 0..500 {
        let now = STEP * f64::from(step);
        let update = replanner.update(&world.seen_from(&state.position), now, &state, &|| true).unwrap();
        assert!(update.verdict.is_safe(), "{now} s: {:?}", update.verdict.violations);
        places.push([state.position[0], state.position[1]]);
        state = replanner.motion().at(now + STEP);
        world.advance(now + STEP, &state.position);
        let there = scene.with_obstacles(world.obstacles()).unwrap();
        assert!(judge::clearance(&there, [state.position[0], state.position[1]]) > 0.0, "{now} s");
    }
    (replanner, places)
}

/// What comes for an arm at 0.3 rad does so at 20 s, too late to matter for eight seconds; before that the only way out is shut, at
/// 10 s. The arm knows since `sight`.
fn trap(sight: Sight) -> Vec<Obstacle> {
    let comes = [[0.0, FAR], [18.0, FAR], [20.0, NEAR]];
    let mut obstacles: Vec<Obstacle> =
        [-0.1, 0.5, 1.1].into_iter().map(|angle| disc(angle, sight, &comes)).collect();
    obstacles.push(disc(std::f64::consts::FRAC_PI_2, sight, &[[0.0, FAR], [5.0, FAR], [10.0, NEAR]]));
    obstacles
}

#[test]
fn an_arm_at_rest_leaves_a_trap_that_it_hears_of_before_it_is_shut() {
    let (start, goal) = ([0.3, 0.5], [4.2, 0.5]);
    let mut obstacles = trap(Sight::From(1.0));
    // At the goal something stands all the time.
    obstacles.push(disc(goal[0], Sight::Always, &[[0.0, NEAR]]));
    let (replanner, places) = followed(&scene(wide(), obstacles), start, goal);
    assert!(places.iter().take(18).all(|place| *place == start), "nothing is known yet");
    assert!(!replanner.reaches_goal());
}

#[test]
fn an_arm_at_its_goal_leaves_before_it_is_caught_there() {
    let (goal, elsewhere) = ([0.3, 0.5], [3.5, 0.5]);
    // It stands there, or it would go there.
    for start in [goal, elsewhere] {
        let (_, places) = followed(&scene(wide(), trap(Sight::Always)), start, goal);
        assert!(places[199..].iter().all(|place| place[0] > 1.6), "{start:?}: out when the way is shut");
    }
    // What comes while the way out stays open is no reason to leave yet.
    let comes = disc(goal[0], Sight::Always, &[[0.0, FAR], [18.0, FAR], [20.0, NEAR]]);
    let (_, places) = followed(&scene(wide(), vec![comes]), goal, goal);
    assert!(places[..220].iter().all(|place| *place == goal), "at the goal for eleven seconds");
}
