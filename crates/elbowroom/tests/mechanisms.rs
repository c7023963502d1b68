//! That each mechanism of the planners does something: without it one of these fails.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use build::{example, tip};
use elbowroom::arm::{Joint, MotionLimits};
use elbowroom::free_space::reason_against;
use elbowroom::planners::{DstarPlanner, DstarPsoPlanner, GuidedRrtConnectPlanner, OptimalPlanner};
use elbowroom::planning::{Endpoints, Objective, Plan, PlanError, PlanSettings, Planner, Unwatched, plan};
use elbowroom::scene::{Place, Scene, TaskPosture};
use elbowroom::trajectory::{Motion, Piece, Via, quintic_through};
use elbowroom::verify::{Quantity, Trajectory, VerifySettings, Violation, verify};

fn asked(scene: &Scene, task: &str, planner: &dyn Planner, objective: Objective, seed: u64) -> Plan {
    let settings = PlanSettings { objective, seed, slack: 0.0, ..PlanSettings::default() };
    plan(scene, scene.task(task).unwrap(), planner, &settings, &Unwatched).unwrap()
}

#[test]
fn a_tip_stands_for_sixteen_different_configurations_of_many_links() {
    let scene = build::scene(build::arm(&[0.3; 5]), vec![build::circle(0.0, 1.0, 0.2)]);
    let task = build::task("far", tip(0.6, 0.1), Place::Configuration([0.1; 5].into()), TaskPosture::Any);
    let ends = Endpoints::new(&scene, &task, 0, &Unwatched).unwrap();
    assert_eq!((ends.starts.len(), ends.goals.len()), (16, 1));
    for (i, q) in ends.starts.iter().enumerate() {
        let off = scene.arm().tip(q).distance(elbowroom::geometry::Point::new(0.6, 0.1));
        assert!(off < 1e-9 && reason_against(&scene, q).is_none(), "{off}");
        assert!(ends.starts[..i].iter().all(|other| scene.arm().distance(other, q) > 0.1));
    }
}

#[test]
fn the_time_bound_counts_speeding_up_and_slowing_down() {
    // One joint turns by 2 rad at up to 0.8 rad/s with 0.4 rad/s²: 2 / 0.8 + 0.8 / 0.4 s, and less way never gets to 0.8.
    let limits = MotionLimits { velocity: Some(0.8), acceleration: Some(0.4), jerk: Some(1e9) };
    let joint = Joint { motion: limits, ..Joint::CONTINUOUS };
    let scene = build::scene(build::arm_of(&[0.5, 0.4], 0.0, &[joint; 2]), vec![]);
    for (turn, least) in [(2.0, 2.0 / 0.8 + 0.8 / 0.4), (0.9, 2.0 * f64::sqrt(0.9 / 0.4))] {
        let at = |first: f64| Place::Configuration([first, 1.0].into());
        let scene =
            scene.clone().with_tasks(vec![build::task("turn", at(0.0), at(turn), TaskPosture::Any)]).unwrap();
        let plan = asked(&scene, "turn", &OptimalPlanner, Objective::Time, 0);
        let bound = plan.lower_bound().unwrap();
        assert!((bound - least).abs() < 1e-6 * least, "{bound} {least}");
    }
}

#[test]
fn stops_are_the_via_points_at_which_the_arm_rests() {
    let places = [[0.0, 0.0], [0.4, 0.1], [0.5, 0.6], [0.2, 0.9], [0.1, 1.0]];
    for stopped in 0..8_u32 {
        let stop = |i: usize| i == 0 || i == 4 || stopped >> (i - 1) & 1 == 1;
        let vias: Vec<Via> = places.iter().enumerate().map(|(i, q)| Via { q, stop: stop(i) }).collect();
        let motion = Motion::new(quintic_through(&vias, &[1.0; 4])).unwrap();
        assert_eq!(motion.stops(), stopped.count_ones() as usize);
    }
}

#[test]
fn dstar_counts_what_is_asked_for() {
    for (scene, task) in [("narrow", "second"), ("paper-standin", "second"), ("abb-irb-910sc-065", "place")] {
        let scene = example(scene);
        let [tip, joint] = [Objective::Tip, Objective::Joint]
            .map(|objective| asked(&scene, task, &DstarPlanner, objective, 0).record().joint_path.clone());
        assert!(joint.length() < tip.length() && tip.tip_travel(scene.arm()) < joint.tip_travel(scene.arm()));
    }
}

#[test]
fn plateaus_bring_ways_that_dstar_alone_does_not_take() {
    // From the other posture, to the other posture: D*'s own path is shorter by a little, its motion takes longer.
    for (scene, task, objective) in
        [("abb-irb-910sc-065", "pick", Objective::Time), ("narrow", "first", Objective::Tip)]
    {
        let scene = example(scene);
        let [own, drawn] = [&DstarPlanner as &dyn Planner, &DstarPsoPlanner::default()]
            .map(|planner| asked(&scene, task, planner, objective, 0).cost());
        assert!(drawn < 0.997 * own, "{own}, {drawn}");
    }
}

#[test]
fn paths_of_many_links_are_made_shorter() {
    // Trees alone wander: without shortcuts these cost 3.76 m, 7.41 rad and 3.83 rad.
    for (scene, objective, most) in [
        ("five-links", Objective::Tip, 2.2),
        ("five-links", Objective::Joint, 6.5),
        ("ten-links", Objective::Joint, 2.6),
    ] {
        let plan = asked(&example(scene), "withdraw", &GuidedRrtConnectPlanner::default(), objective, 0);
        assert!(plan.cost() < most, "{scene}: {}", plan.cost());
    }
}

#[test]
fn optimal_tries_several_clearances() {
    // With the first of its margins alone these cost 8.85 s, 6.47 s, 3.465 rad, 1.583 rad and 0.32863 m.
    for (scene, task, objective, most) in [
        ("paper-standin", "second", Objective::Joint, 3.457),
        ("fanuc-sr-3ia", "shelf", Objective::Joint, 1.576),
        ("fanuc-sr-3ia", "shelf", Objective::Tip, 0.3284),
    ] {
        let plan = asked(&example(scene), task, &OptimalPlanner, objective, 0);
        assert!(plan.cost() < most, "{scene}, {task}: {}", plan.cost());
    }
}

#[test]
fn the_swarm_hands_on_more_than_its_best_path() {
    // The best drawn path alone becomes motions of 0.8172 m and 0.8278 m.
    for (scene, most) in [("narrow", 0.812), ("paper-standin", 0.815)] {
        let plan = asked(&example(scene), "second", &DstarPsoPlanner::default(), Objective::Tip, 1);
        assert!(plan.cost() < most, "{scene}: {}", plan.cost());
    }
}

#[test]
fn optimal_goes_on_until_the_gap_is_as_small_as_asked_for() {
    let scene = example("paper-standin");
    let task = scene.task("first").unwrap();
    for gap in [0.05, 0.01, 0.001] {
        let settings =
            PlanSettings { objective: Objective::Joint, gap: Some(gap), ..PlanSettings::default() };
        let plan = plan(&scene, task, &OptimalPlanner, &settings, &Unwatched).unwrap();
        assert!(plan.gap().unwrap() <= gap, "{gap}: {:?}", plan.gap());
    }
}

#[test]
fn walls_of_any_thickness_are_a_proof_that_there_is_no_path() {
    // Bent by no more than 0.8 rad, link 2 sweeps over a post at 0.7 m wherever joint 1 turns past it.
    let joints = [build::joint(build::stops(-1.5, 1.5)), build::joint(build::stops(-0.8, 0.8))];
    let at = |first: f64| Place::Configuration([first, 0.3].into());
    for radius in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let scene =
            build::scene(build::arm_of(&[0.5, 0.5], 0.0, &joints), vec![build::circle(0.7, 0.0, radius)]);
        let task = build::task("across", at(-1.2), at(1.2), TaskPosture::Any);
        for planner in [&DstarPlanner as &dyn Planner, &OptimalPlanner] {
            let answer = plan(&scene, &task, planner, &PlanSettings::default(), &Unwatched);
            assert!(
                matches!(answer, Err(PlanError::NoPath(_))),
                "{}, {radius} m: {answer:?}",
                planner.name()
            );
        }
    }
}

#[test]
fn a_trajectory_has_no_jump_in_acceleration_whatever_is_asked_for() {
    let scene = build::scene(build::arm(&[1.0, 0.5]), vec![]);
    // Straight out and back: the velocity jumps; a cubic from rest to rest: the acceleration jumps where two meet.
    let straight = |start: f64, from: [f64; 2], to: [f64; 2]| Piece {
        start,
        duration: 1.0,
        coefficients: [0, 1].map(|j| [from[j], to[j] - from[j], 0.0, 0.0, 0.0, 0.0]).to_vec(),
    };
    let corner =
        Motion::new(vec![straight(0.0, [0.0, 0.0], [0.5, 0.2]), straight(1.0, [0.5, 0.2], [0.0, 0.0])]);
    let cubic = |start: f64, from: f64, to: f64| Piece {
        start,
        duration: 1.0,
        coefficients: vec![[from, 0.0, 3.0 * (to - from), -2.0 * (to - from), 0.0, 0.0], [0.0; 6]],
    };
    let cubics = Motion::new(vec![cubic(0.0, 0.0, 0.4), cubic(1.0, 0.4, 0.3)]);
    for (motion, allowed) in [(corner, Quantity::Position), (cubics, Quantity::Velocity)] {
        let motion = motion.unwrap();
        let settings = VerifySettings { continuous: allowed, ..VerifySettings::default() };
        assert!(verify(&scene, &motion, &settings).is_safe(), "a curve of this kind may do so");
        let refused = Trajectory::certify(&scene, motion, &settings).unwrap_err();
        assert!(
            refused.violations.iter().any(|violation| matches!(violation, Violation::Discontinuity { .. })),
            "{refused:?}"
        );
    }
}
