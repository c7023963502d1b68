//! Motions for which time is what counts: as short as is known to be possible, within all limits, and proved.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
#[path = "judge/mod.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod judge;
#[path = "worlds/mod.rs"]
mod worlds;

use elbowroom::arm::{Arm, Joint, JointLimits, MotionLimits};
use elbowroom::planners::{DstarPlanner, DstarPsoPlanner, GuidedRrtConnectPlanner, OptimalPlanner};
use elbowroom::planning::{ASSUMED_LIMITS, Objective, Pace, Plan, PlanSettings, Planner, Unwatched, plan};
use elbowroom::scene::{Place, Scene, Task, TaskPosture};
use elbowroom::trajectory::Motion;

fn asked(scene: &Scene, task: &str, planner: &dyn Planner) -> Plan {
    let settings = PlanSettings { objective: Objective::Time, ..PlanSettings::default() };
    plan(scene, scene.task(task).unwrap(), planner, &settings, &Unwatched).unwrap()
}

/// Limits of velocity, acceleration and jerk, those that are assumed where none is stated.
fn limits(arm: &Arm) -> Vec<[f64; 3]> {
    let of = |joint: &Joint| {
        let MotionLimits { velocity, acceleration, jerk } = joint.motion;
        [
            velocity.unwrap_or(ASSUMED_LIMITS.velocity),
            acceleration.unwrap_or(ASSUMED_LIMITS.acceleration),
            jerk.unwrap_or(ASSUMED_LIMITS.jerk),
        ]
    };
    arm.joints().iter().map(of).collect()
}

/// The greatest share of a limit that is used, by samples.
fn use_of(motion: &Motion, limits: &[[f64; 3]]) -> f64 {
    let mut most: f64 = 0.0;
    for piece in motion.pieces() {
        for look in 0..=20 {
            let state = piece.at(piece.duration * f64::from(look) / 20.0);
            for (j, [velocity, acceleration, jerk]) in limits.iter().enumerate() {
                most = most
                    .max(state.velocity[j].abs() / velocity)
                    .max(state.acceleration[j].abs() / acceleration)
                    .max(state.jerk[j].abs() / jerk);
            }
        }
    }
    most
}

#[test]
fn motions_come_near_to_the_shortest_known() {
    // The shortest known are by direct collocation with IPOPT from many starts, verified.
    for (scene, task, best) in [
        ("abb-irb-910sc-065", "pick", 1.629),
        ("abb-irb-910sc-065", "place", 1.852),
        ("fanuc-sr-3ia", "shelf", 2.033),
        ("fanuc-sr-3ia", "across", 2.276),
        ("paper-standin", "first", 2.536),
        ("paper-standin", "second", 2.775),
        ("narrow", "first", 3.279),
        ("narrow", "second", 3.014),
    ] {
        let scene_of = build::example(scene);
        for planner in [&DstarPsoPlanner::default() as &dyn Planner, &OptimalPlanner] {
            let plan = asked(&scene_of, task, planner);
            assert!(plan.cost() < 1.02 * best, "{scene}, {task}, {}: {}", planner.name(), plan.cost());
            let used = use_of(plan.trajectory().motion(), &limits(scene_of.arm()));
            assert!(used <= 1.0 + 1e-9 && used > 0.999, "{scene}, {task}: {used}");
        }
    }
}

#[test]
fn where_a_corner_is_touched_between_samples_the_search_goes_on() {
    // With joint 1 between limits six rounds were not enough for `optimal` here; what it begins with takes 5.3 s.
    let scene = build::example("narrow");
    let arm = scene.arm();
    let joints =
        [Joint { limits: build::stops(0.0, std::f64::consts::TAU), ..arm.joints()[0] }, arm.joints()[1]];
    let arm = build::arm_of(arm.lengths(), arm.half_width(), &joints);
    let limited = Scene::new(arm, *scene.grid(), scene.obstacles().to_vec(), scene.tasks().to_vec()).unwrap();
    let plan = asked(&limited, "first", &OptimalPlanner);
    assert!(plan.cost() < 4.5, "{}", plan.cost());
}

#[test]
fn one_joint_alone_moves_in_the_time_of_the_closed_form() {
    // Speeds up with full jerk, acceleration, velocity and slows down likewise; or, for a short way, with full jerk only.
    let motion = MotionLimits { velocity: Some(1.0), acceleration: Some(2.0), jerk: Some(8.0) };
    let joint = Joint { limits: JointLimits::Continuous, motion };
    let arm = build::arm_of(&[0.5, 0.4], 0.0, &[joint; 2]);
    for (turn, least) in [(2.0, 2.0 / 1.0 + 1.0 / 2.0 + 2.0 / 8.0), (0.05, f64::cbrt(32.0 * 0.05 / 8.0))] {
        let at = |first: f64| Place::Configuration([first, 1.0].into());
        let task = build::task("turn", at(0.0), at(turn), TaskPosture::Any);
        let scene = build::scene(arm.clone(), vec![]).with_tasks(vec![task]).unwrap();
        let plan = asked(&scene, "turn", &OptimalPlanner);
        assert!(plan.cost() >= least * (1.0 - 1e-6), "{turn}: {} below {least}", plan.cost());
        assert!(plan.cost() < 1.01 * least, "{turn}: {} above {least}", plan.cost());
    }
}

#[test]
fn no_world_s_motion_breaks_a_limit_or_its_bound() {
    let mut found = 0;
    for seed in 0..60 {
        let Some(scene) = worlds::world(seed) else { continue };
        let settings = PlanSettings { objective: Objective::Time, ..PlanSettings::default() };
        // A cost below the proved bound would be an error.
        let answer = plan(&scene, &scene.tasks()[0], &DstarPlanner, &settings, &Unwatched);
        let Ok(plan) = answer else { continue };
        found += 1;
        let used = use_of(plan.trajectory().motion(), &limits(scene.arm()));
        assert!(used <= 1.0 + 1e-9, "seed {seed}: {used}");
    }
    assert!(found > 20, "{found}");
}

#[test]
fn arms_of_many_links_are_quick_too() {
    // Through via points one piece at a time these take 6.2, 7.8, 8.0 and 7.3 s.
    for (scene, task, most) in [
        ("three-links", "reach", 2.5),
        ("three-links", "withdraw", 4.2),
        ("five-links", "reach", 2.2),
        ("five-links", "withdraw", 3.5),
    ] {
        let scene = build::example(scene);
        let plan = asked(&scene, task, &GuidedRrtConnectPlanner::default());
        assert!(plan.cost() < most, "{task}: {}", plan.cost());
        assert!(use_of(plan.trajectory().motion(), &limits(scene.arm())) <= 1.0 + 1e-9);
    }
}

#[test]
fn motions_are_made_faster_within_joint_limits_and_a_kept_posture_and_from_several_paths() {
    for (seed, posture, most) in [
        // 2.80 s if the posture were looked after only when it is lost.
        (208, TaskPosture::Keep, 2.2),
        // 7.94 s if joint limits were.
        (99, TaskPosture::Any, 4.5),
        // 3.41 s from the best path alone.
        (41, TaskPosture::Any, 2.6),
    ] {
        let scene = worlds::world(seed).unwrap();
        let task = Task { posture, ..scene.tasks()[0].clone() };
        let settings = PlanSettings { objective: Objective::Time, ..PlanSettings::default() };
        let plan = plan(&scene, &task, &DstarPlanner, &settings, &Unwatched).unwrap();
        assert!(plan.cost() < most, "{seed}: {}", plan.cost());
        let changes = &plan.trajectory().verdict().posture_changes;
        assert!(posture == TaskPosture::Any || changes.is_empty(), "{seed}: {changes:?}");
    }
}

#[test]
fn arms_of_more_links_than_twelve_keep_the_motion_along_the_path() {
    for (links, is_shaped) in [(12, true), (13, false)] {
        let at = |angle: f64| Place::Configuration(vec![angle; links].into());
        let task = build::task("bend", at(0.05), at(0.1), TaskPosture::Any);
        let arm = build::arm(&vec![1.0 / links as f64; links]);
        let scene = build::scene(arm, vec![]).with_tasks(vec![task]).unwrap();
        let plan = asked(&scene, "bend", &GuidedRrtConnectPlanner::default());
        let pieces = plan.trajectory().motion().pieces();
        // Along the path pieces last whole ticks.
        let on_ticks = pieces.iter().all(|it| (it.start * 100.0 - (it.start * 100.0).round()).abs() < 1e-6);
        assert_eq!(on_ticks, !is_shaped, "{links} links, {} pieces", pieces.len());
    }
}

/// A plan for the first task, and its duration (s).
fn run(scene: &Scene, planner: &dyn Planner, settings: PlanSettings) -> (Plan, f64) {
    let plan = plan(scene, &scene.tasks()[0], planner, &settings, &Unwatched).unwrap();
    let duration = plan.trajectory().motion().duration();
    (plan, duration)
}

#[test]
fn a_little_slack_in_length_makes_motions_much_faster() {
    for objective in [Objective::Tip, Objective::Joint] {
        for name in ["abb-irb-910sc-065", "fanuc-sr-3ia", "narrow", "three-links"] {
            let scene = build::example(name);
            let planner: &dyn Planner =
                if name == "three-links" { &GuidedRrtConnectPlanner::default() } else { &DstarPlanner };
            let with =
                |slack| run(&scene, planner, PlanSettings { objective, slack, ..PlanSettings::default() });
            let [(shortest, slowest), (default, duration), (_, fastest)] =
                [with(0.0), with(elbowroom::planning::SLACK), with(0.3)];
            assert!(default.cost() <= shortest.cost() * 1.005 * (1.0 + 1e-9), "{name}: {}", default.cost());
            assert!(
                duration < slowest && fastest < duration * 1.01,
                "{name}: {slowest} {duration} {fastest}"
            );
            assert!(use_of(default.trajectory().motion(), &limits(scene.arm())) <= 1.0 + 1e-9);
        }
    }
}

#[test]
fn what_is_shortened_comes_near_to_the_lower_bound_whichever_path_it_was() {
    // Along D*'s zigzag on the grid these were 1.8 to 72 % above the bound.
    for (name, objective, most) in [
        ("abb-irb-910sc-065", Objective::Tip, 0.01),
        ("fanuc-sr-3ia", Objective::Tip, 0.01),
        ("paper-standin", Objective::Tip, 0.01),
        ("abb-irb-910sc-065", Objective::Joint, 0.02),
        ("fanuc-sr-3ia", Objective::Joint, 0.02),
        ("paper-standin", Objective::Joint, 0.02),
    ] {
        let settings = PlanSettings { objective, ..PlanSettings::default() };
        let gap = run(&build::example(name), &DstarPlanner, settings).0.gap().unwrap();
        assert!(gap < most, "{name}: {gap}");
    }
}

#[test]
fn the_gap_that_was_asked_for_counts_before_the_slack() {
    let settings =
        PlanSettings { objective: Objective::Joint, gap: Some(0.002), slack: 0.1, ..PlanSettings::default() };
    let (plan, _) = run(&build::example("paper-standin"), &OptimalPlanner, settings);
    assert!(plan.gap().unwrap() <= 0.002, "{:?}", plan.gap());
}

/// The integral of jerk squared over all joints (rad²/s⁵).
fn roughness(motion: &Motion) -> f64 {
    let of = |i: usize| {
        let piece = &motion.pieces()[i];
        let at = |k: i32| piece.at(piece.duration * (f64::from(k) + 0.5) / 200.0).jerk;
        (0..200).map(|k| at(k).iter().map(|jerk| jerk * jerk).sum::<f64>()).sum::<f64>() * piece.duration
            / 200.0
    };
    (0..motion.pieces().len()).map(of).sum()
}

#[test]
fn a_motion_of_a_given_duration_is_smoother_than_the_fastest_slowed_down() {
    let scene = build::example("abb-irb-910sc-065");
    let of = |pace| PlanSettings { objective: Objective::Time, pace, ..PlanSettings::default() };
    let (fastest, least) = run(&scene, &DstarPlanner, of(Pace::Fastest));
    for seconds in [least * 1.05, 3.0, 30.0] {
        let (plan, duration) = run(&scene, &DstarPlanner, of(Pace::Duration(seconds)));
        assert!((duration - seconds).abs() < 1e-9);
        let slowed = fastest.trajectory().motion().lasting(seconds).unwrap();
        let (smooth, rough) = (roughness(plan.trajectory().motion()), roughness(&slowed));
        assert!(smooth < 0.95 * rough, "{seconds}: {smooth} {rough}");
        assert!(use_of(plan.trajectory().motion(), &limits(scene.arm())) <= 1.0 + 1e-9);
    }
    // Alone in the world the smoothest is a polynomial: of the sixth degree in time, least for jerk from rest to rest.
    let joint = elbowroom::arm::Joint::CONTINUOUS;
    let empty = build::scene(build::arm_of(&[0.5, 0.5], 0.0, &[joint; 2]), vec![]);
    let [start, goal] = [[0.0, 0.5], [1.0, 0.9]].map(|q| Place::Configuration(q.into()));
    let empty = empty.with_tasks(vec![build::task("turn", start, goal, TaskPosture::Any)]).unwrap();
    let (plan, _) = run(&empty, &DstarPlanner, of(Pace::Duration(4.0)));
    // Least jerk: 720 d² / T⁵ for each joint.
    let least = 720.0 * (1.0 + 0.4 * 0.4) / 4.0_f64.powi(5);
    let found = roughness(plan.trajectory().motion());
    assert!(found > least * (1.0 - 1e-6) && found < least * 1.02, "{found} {least}");
}

#[test]
fn a_motion_slowed_down_is_the_same_in_more_time() {
    let scene = build::example("narrow");
    let (plan, duration) = run(&scene, &DstarPlanner, PlanSettings::default());
    let motion = plan.trajectory().motion();
    let slowed = motion.lasting(3.0 * duration).unwrap();
    for i in 0..=1000 {
        let t = duration * f64::from(i) / 1000.0;
        let (a, b) = (motion.at(t), slowed.at(3.0 * t));
        for j in 0..2 {
            assert!((a.position[j] - b.position[j]).abs() < 1e-9);
            assert!((a.velocity[j] - 3.0 * b.velocity[j]).abs() < 1e-8);
            assert!((a.acceleration[j] - 9.0 * b.acceleration[j]).abs() < 1e-6);
        }
    }
}

#[test]
fn what_is_fast_is_made_short_rather_than_what_is_short_made_fast() {
    // The other way round these take 5.7 and 5.0 s.
    for (name, task, most) in [("paper-standin", "second", 3.3), ("narrow", "first", 4.2)] {
        let scene = build::example(name);
        let settings = PlanSettings { objective: Objective::Joint, ..PlanSettings::default() };
        let plan = plan(&scene, scene.task(task).unwrap(), &OptimalPlanner, &settings, &Unwatched).unwrap();
        let duration = plan.trajectory().motion().duration();
        assert!(duration < most, "{name}: {duration} s");
    }
}
