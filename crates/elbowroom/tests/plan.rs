//! Posture-true planning: what is handed out is safe by a judge of its own, starts and ends where it was asked to, and
//! never changes posture but in line.

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
mod judge;
mod worlds;

use std::f64::consts::PI;

use build::{with_obstacle, with_task};
use elbowroom::arm::{JointLimits, MotionLimits, Posture};
use elbowroom::geometry::Point;
use elbowroom::planners::{DstarPlanner, DstarPsoPlanner, OptimalPlanner};
use elbowroom::planning::{
    ASSUMED_LIMITS, Objective, Pace, Plan, PlanError, PlanSettings, Planner, SLACK, Unwatched, plan,
};
use elbowroom::scene::{Place, Scene, Task, TaskPosture};
use elbowroom::swarm::GuidedSwarmSettings;

/// The paper's arm among our five circles.
fn standin(first: JointLimits, motion: MotionLimits) -> Scene {
    build::paper(first, 150f64.to_radians(), motion, &build::CIRCLES, 0.01)
}

fn with_stops() -> JointLimits {
    build::stops(0.0, 2.0 * PI)
}

fn run_task(
    scene: &Scene,
    task: usize,
    planner: &dyn Planner,
    settings: &PlanSettings,
) -> Result<Plan, PlanError> {
    plan(scene, &scene.tasks()[task], planner, settings, &Unwatched)
}

fn run(scene: &Scene, planner: &dyn Planner, settings: &PlanSettings) -> Result<Plan, PlanError> {
    run_task(scene, 0, planner, settings)
}

fn by_dstar(scene: &Scene) -> Result<Plan, PlanError> {
    run(scene, &DstarPlanner, &PlanSettings::default())
}

/// Whether the tip or the joints are where `place` says at `q`.
fn is_at(scene: &Scene, place: &Place, q: [f64; 2]) -> bool {
    match place {
        Place::Tip(tip) => {
            let [_, _, [x, y]] = judge::skeleton(scene, q);
            (x - tip.x).hypot(y - tip.y) < 1e-9
        }
        Place::Configuration(asked) => (0..2).all(|j| {
            // A continuous joint may have been counted on by whole turns.
            let off = q[j] - asked[j];
            let off = match scene.arm().joints()[j].limits {
                JointLimits::Continuous => (off / 2.0).sin() * 2.0,
                JointLimits::Range { .. } => off,
            };
            off.abs() < 1e-9
        }),
    }
}

fn two(q: &[f64]) -> [f64; 2] {
    [q[0], q[1]]
}

/// All that is promised of a plan, looked at from outside.
fn assert_true(scene: &Scene, task: &Task, plan: &Plan) {
    let motion = plan.trajectory().motion();
    assert!(plan.trajectory().verdict().is_safe());
    assert_eq!(judge::fault(scene, motion, 200), None);
    let (first, last) = (motion.at(motion.start()), motion.at(motion.end()));
    assert!(is_at(scene, &task.start, two(&first.position)), "{:?} is not {:?}", first.position, task.start);
    assert!(is_at(scene, &task.goal, two(&last.position)), "{:?} is not {:?}", last.position, task.goal);
    for end in [&first, &last] {
        assert!(end.velocity.iter().chain(&end.acceleration).all(|v| v.abs() < 1e-6));
    }
    let goal = Posture::of(&two(&last.position));
    match task.posture {
        TaskPosture::Up => assert_ne!(goal, Some(Posture::ElbowDown)),
        TaskPosture::Down => assert_ne!(goal, Some(Posture::ElbowUp)),
        TaskPosture::Keep => {
            let bends: Vec<f64> = plan.joint_path().0.iter().map(|q| q[1].sin()).collect();
            assert!(bends.iter().all(|b| *b >= -1e-9) || bends.iter().all(|b| *b <= 1e-9), "{bends:?}");
            let looks = (0..=2_000).map(|i| motion.start() + motion.duration() * f64::from(i) / 2_000.0);
            let bends: Vec<f64> = looks.map(|time| motion.at(time).position[1].sin()).collect();
            assert!(
                bends.iter().all(|b| *b >= -1e-9) || bends.iter().all(|b| *b <= 1e-9),
                "the motion flips"
            );
        }
        TaskPosture::Any => {}
    }
}

#[test]
fn motions_in_random_worlds_are_safe_by_another_judge() {
    let (mut planned, mut without_path, mut not_found, mut refused) = (0, 0, 0, 0);
    for seed in 0..900 {
        let Some(scene) = worlds::world(seed) else { continue };
        let objective = [Objective::Tip, Objective::Joint, Objective::Time][seed as usize % 3];
        let swarm = GuidedSwarmSettings { candidates: 10, ..GuidedSwarmSettings::default() };
        let drawn = DstarPsoPlanner { swarm };
        let planner: &dyn Planner = match seed % 20 {
            0 => &OptimalPlanner,
            1..=9 => &DstarPlanner,
            _ => &drawn,
        };
        match run(&scene, planner, &PlanSettings { objective, seed, ..PlanSettings::default() }) {
            Ok(plan) => {
                planned += 1;
                assert_true(&scene, &scene.tasks()[0], &plan);
            }
            Err(PlanError::NoPath(_)) => without_path += 1,
            Err(PlanError::NotFound { .. } | PlanError::NotFoundOverJoints { .. }) => not_found += 1,
            Err(PlanError::GoalPosture { .. } | PlanError::Start(_) | PlanError::Goal(_)) => refused += 1,
            Err(other) => panic!("world {seed}: {other}"),
        }
    }
    assert!(
        planned > 480 && without_path > 12 && not_found > 12,
        "{planned} planned, {without_path} without a path, {not_found} not found, {refused} refused"
    );
}

#[test]
fn near_the_base_no_step_goes_the_wrong_way_round() {
    // Folded, with the tip beside the base, a small step of the tip turns joint 1 by about half a turn.
    for seed in [9_469, 10_596, 67_408, 77_231, 35_036] {
        let scene = worlds::world(seed).unwrap();
        let objective = [Objective::Tip, Objective::Joint, Objective::Time][seed as usize % 3];
        let swarm = GuidedSwarmSettings { candidates: 10, ..GuidedSwarmSettings::default() };
        let drawn = DstarPsoPlanner { swarm };
        let planner: &dyn Planner = if seed % 2 == 0 { &DstarPlanner } else { &drawn };
        let plan =
            run(&scene, planner, &PlanSettings { objective, seed, ..PlanSettings::default() }).unwrap();
        assert_true(&scene, &scene.tasks()[0], &plan);
    }
}

#[test]
fn the_papers_tasks_are_planned_for_both_kinds_of_joint_1() {
    for first in [JointLimits::Continuous, with_stops()] {
        for index in 0..2 {
            let scene = standin(first, MotionLimits::default());
            for planner in [&DstarPlanner as &dyn Planner, &DstarPsoPlanner::default()] {
                let plan = run_task(&scene, index, planner, &PlanSettings::default()).unwrap();
                assert_true(&scene, &scene.tasks()[index], &plan);
                assert!((plan.cost() - plan.trajectory().motion().tip_length(scene.arm())).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn the_swarm_does_no_worse_than_dstar_by_what_it_was_asked_for() {
    for index in 0..2 {
        let scene = standin(JointLimits::Continuous, MotionLimits::default());
        for objective in [Objective::Tip, Objective::Joint, Objective::Time] {
            let of = |seed: u64| PlanSettings { objective, seed, ..PlanSettings::default() };
            let alone = run_task(&scene, index, &DstarPlanner, &of(0)).unwrap();
            assert_eq!(alone.record().paths_to_choose_from, 1);
            let costs: Vec<f64> = (0..4)
                .map(|seed| run_task(&scene, index, &DstarPsoPlanner::default(), &of(seed)).unwrap().cost())
                .collect();
            assert!(
                costs.iter().all(|cost| *cost <= alone.cost() * (1.0 + SLACK)),
                "{costs:?} {}",
                alone.cost()
            );
        }
    }
}

#[test]
fn optimal_comes_within_a_percent_of_the_best_joint_travel_known() {
    // Joint 1 continuous, then between stops: found by a 0.2 degree joint grid with shortcuts.
    let known =
        [("paper-standin", [[PI, 3.4454], [PI, 4.8746]]), ("narrow", [[4.1906, 3.5240], [4.9238, 5.7470]])];
    for (name, known) in known {
        for (limits, known) in [JointLimits::Continuous, with_stops()].into_iter().zip(known) {
            let scene = build::example(name);
            let mut joints = scene.arm().joints().to_vec();
            joints[0].limits = limits;
            let scene = scene.with_arm(build::arm_of(scene.arm().lengths(), 0.0, &joints)).unwrap();
            for (index, known) in known.into_iter().enumerate() {
                let settings =
                    PlanSettings { objective: Objective::Joint, slack: 0.0, ..PlanSettings::default() };
                let plan = run_task(&scene, index, &OptimalPlanner, &settings).unwrap();
                assert!(plan.cost() <= 1.01 * known, "{} for {known}", plan.cost());
            }
        }
    }
}

#[test]
fn optimal_follows_the_hole_of_the_paper_s_ring_by_a_tangent_and_an_arc() {
    let scene = build::example("paper-empty");
    for (index, length) in [1.16287, 0.80496].into_iter().enumerate() {
        let plan = run_task(&scene, index, &OptimalPlanner, &PlanSettings::default()).unwrap();
        assert!((length - 1e-5..=1.005 * length).contains(&plan.cost()), "{}", plan.cost());
        assert_true(&scene, &scene.tasks()[index], &plan);
    }
}

#[test]
fn motion_limits_are_kept_and_missing_ones_are_named() {
    let motion = MotionLimits { velocity: Some(2.0), acceleration: Some(8.0), jerk: None };
    let scene = standin(JointLimits::Continuous, motion);
    let plan = by_dstar(&scene).unwrap();
    assert_true(&scene, &scene.tasks()[0], &plan);
    let assumed: Vec<_> = plan.record().assumed_limits.iter().map(|a| (a.joint, a.rate, a.value)).collect();
    assert_eq!(assumed, [(1, "jerk", ASSUMED_LIMITS.jerk), (2, "jerk", ASSUMED_LIMITS.jerk)]);
    let margins = &plan.trajectory().verdict().motion_margins;
    let used = margins.iter().flat_map(|m| [m.velocity.largest / 2.0, m.acceleration.largest / 8.0]);
    let used = used.chain(margins.iter().map(|m| m.jerk.largest / ASSUMED_LIMITS.jerk)).fold(0.0, f64::max);
    assert!((0.9..=1.0).contains(&used), "the fastest motion uses {used} of a limit");
}

#[test]
fn a_duration_is_kept_or_refused() {
    let motion = MotionLimits { velocity: Some(2.0), acceleration: Some(8.0), jerk: Some(80.0) };
    let scene = standin(JointLimits::Continuous, motion);
    let lasting = |seconds: f64| PlanSettings { pace: Pace::Duration(seconds), ..PlanSettings::default() };
    let at = |seconds: f64| run(&scene, &DstarPlanner, &lasting(seconds));
    let slow = at(30.0).unwrap();
    assert!((slow.trajectory().motion().duration() - 30.0).abs() < 1e-9);
    assert_true(&scene, &scene.tasks()[0], &slow);
    let Err(PlanError::TooFast { duration, fastest }) = at(0.1) else { panic!("0.1 s is too fast") };
    assert_eq!(duration, 0.1);
    assert!(at(fastest * 1.0001).is_ok());
    for seconds in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(at(seconds), Err(PlanError::Duration { .. })));
    }
    let unlimited = standin(JointLimits::Continuous, MotionLimits::default());
    assert!(run(&unlimited, &DstarPlanner, &lasting(0.1)).is_ok(), "no stated limit forbids it");
}

#[test]
fn postures_asked_for_are_kept_to() {
    for posture in [TaskPosture::Up, TaskPosture::Down, TaskPosture::Keep] {
        for first in [JointLimits::Continuous, with_stops()] {
            let scene = with_task(&standin(first, MotionLimits::default()), 0, |task| task.posture = posture);
            let plan = by_dstar(&scene).unwrap();
            assert_true(&scene, &scene.tasks()[0], &plan);
        }
    }
    // A circle where the elbow-down arm has its elbow: only elbow-up is left.
    let scene = standin(JointLimits::Continuous, MotionLimits::default());
    let goal = Point::new(-0.45, -0.15);
    let arm = scene.arm().two_link().unwrap();
    let elbow = arm.elbow(&arm.inverse(goal, Posture::ElbowDown).unwrap()[0]);
    let scene = with_obstacle(&scene, build::circle(elbow.x, elbow.y, 0.01));
    let scene = with_task(&scene, 0, |task| task.posture = TaskPosture::Down);
    let refused = by_dstar(&scene).unwrap_err();
    assert_eq!(refused, PlanError::GoalPosture { wanted: Posture::ElbowDown });
}

#[test]
fn a_flip_passes_through_full_stretch() {
    let scene = standin(JointLimits::Continuous, MotionLimits::default());
    let scene = scene.with_obstacles(Vec::new()).unwrap();
    let ends = [[0.3, 1.2], [1.5, -1.2]].map(|q| Place::Configuration(q.into()));
    let scene = with_task(&scene, 0, |task| [task.start, task.goal] = ends);
    let plan = by_dstar(&scene).unwrap();
    assert_true(&scene, &scene.tasks()[0], &plan);
    let changes = &plan.trajectory().verdict().posture_changes;
    assert_eq!(changes.len(), 1);
    let there = plan.trajectory().motion().at(changes[0]);
    assert!(there.position[1].abs() < 1e-6, "{there:?}");
    let scene = with_task(&scene, 0, |task| task.posture = TaskPosture::Keep);
    assert!(matches!(by_dstar(&scene), Err(PlanError::NoPath(_))));
}

#[test]
fn an_arm_that_is_there_already_stands_still() {
    let scene = standin(JointLimits::Continuous, MotionLimits::default());
    let scene = with_task(&scene, 0, |task| task.goal = task.start.clone());
    let plan = run(&scene, &DstarPsoPlanner::default(), &PlanSettings::default()).unwrap();
    assert_eq!((plan.cost(), plan.trajectory().motion().duration()), (0.0, 0.0));
    let pace = Pace::Duration(10.0);
    let waiting = run(&scene, &DstarPlanner, &PlanSettings { pace, ..PlanSettings::default() }).unwrap();
    assert_eq!(waiting.cost(), 0.0);
}

#[test]
fn same_seed_same_plan() {
    let scene = standin(JointLimits::Continuous, MotionLimits::default());
    let settings = PlanSettings { objective: Objective::Joint, seed: 5, ..PlanSettings::default() };
    let planned = || run(&scene, &DstarPsoPlanner::default(), &settings).unwrap();
    assert_eq!(planned(), planned());
}
