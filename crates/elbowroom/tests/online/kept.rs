//! What the replanner keeps stays below what its documentation says, however long an obstacle moves.

use elbowroom::arm::{Joint, JointLimits, MotionLimits};
use elbowroom::geometry::Vector;
use elbowroom::online::{Kept, Replanner, Roadmap, World};
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Scene, Sight, Task, TaskPosture, Waypoint};
use elbowroom::trajectory::State;

use crate::build;

/// Between two updates (s).
const STEP: f64 = 0.4;

/// How long the obstacle takes once round (s), how often it goes round, and where it turns (m).
const ROUND: f64 = 24.0;
const ROUNDS: u32 = 10;
const CORNERS: [[f64; 2]; 4] = [[0.4, 0.0], [0.0, 0.4], [-0.4, 0.0], [0.0, -0.4]];

/// Without goals.
const NODES: usize = 2 * 57 * 57;

/// An arm that reaches 0.5 m, in the middle of 57 x 57 points, and a disc that goes round and round.
fn scene() -> Scene {
    let motion = MotionLimits { velocity: Some(1.5), acceleration: Some(4.0), jerk: Some(40.0) };
    let joint = |limits| Joint { limits, motion };
    let joints = [joint(JointLimits::Continuous), joint(build::stops(-2.6, 2.6))];
    let arm = build::arm_of(&[0.25, 0.25], 0.01, &joints);
    let waypoints = (0..=4 * (ROUNDS + 2)).map(|k| {
        let [x, y] = CORNERS[k as usize % 4];
        Waypoint {
            time: ROUND / 4.0 * f64::from(k),
            shift: Vector::new(x - CORNERS[0][0], y - CORNERS[0][1]),
        }
    });
    let course = Course::Waypoints(waypoints.collect());
    let motion = ObstacleMotion::new(course, Sight::Always, None).unwrap();
    let disc = Obstacle { motion: Some(motion), ..build::circle(CORNERS[0][0], CORNERS[0][1], 0.05) };
    Scene::new(arm, build::grid(0.5, 1.0 / 56.0), vec![disc], Vec::new()).unwrap()
}

fn assert_bounded(kept: Kept) {
    assert!((NODES..NODES + 3).contains(&kept.nodes), "{kept:?}");
    assert!(kept.known <= kept.nodes && kept.open <= kept.nodes && kept.in_buckets <= kept.nodes, "{kept:?}");
}

#[test]
fn what_is_kept_is_bounded_by_the_grid_however_long_an_obstacle_moves() {
    let scene = scene();
    let mut world = World::new(scene.clone());
    let ends = [[2.0, 0.8], [-1.5, 0.8]];
    let replanner = |goal: [f64; 2]| {
        Replanner::new(scene.clone(), ends[0], &Place::Configuration(goal.into()), 0).unwrap()
    };
    // To and fro, as long as the obstacle goes round.
    let mut replanners = ends.map(replanner);
    let mut state = State::rest(&ends[0]);
    let (mut towards, mut arrivals) = (1, 0);
    let mut after_rounds = Vec::new();
    for step in 0..(ROUND * f64::from(ROUNDS) / STEP) as u32 {
        let now = STEP * f64::from(step);
        replanners[towards].update(&world.seen_from(&state.position), now, &state, &|| true).unwrap();
        let kept = replanners.each_ref().map(Replanner::kept);
        kept.into_iter().flatten().for_each(assert_bounded);
        state = replanners[towards].motion().at(now + STEP);
        world.advance(now + STEP, &state.position);
        if replanners[towards].is_at_goal(&state) {
            (towards, arrivals) = (1 - towards, arrivals + 1);
        }
        if (step + 1).is_multiple_of((ROUND / STEP) as u32) {
            after_rounds.push(kept.map(|kept| kept.map(|kept| kept.known)));
        }
    }
    assert!(arrivals > 5);
    let half = after_rounds[after_rounds.len() / 2];
    assert_eq!(after_rounds.last(), Some(&half), "nothing more is kept when all has been seen");
}

#[test]
fn a_grid_that_is_searched_everywhere_has_room_for_its_nodes_and_no_more() {
    let still = scene().with_obstacles(Vec::new()).unwrap();
    let q = |q: [f64; 2]| Place::Configuration(q.into());
    let task = Task {
        name: String::new(),
        start: q([0.3, 0.5]),
        goal: q([2.0, 0.8]),
        posture: TaskPosture::Any,
        clearance: 0.0,
    };
    let mut roadmap = Roadmap::new(still, &task).unwrap();
    let reached = roadmap.whole_field().iter().filter(|cost| cost.is_finite()).count();
    let kept = roadmap.kept();
    assert!((4097..NODES).contains(&reached), "the next power of two is more than there are nodes");
    assert!(kept.known >= reached - 1);
    assert_bounded(kept);
}
