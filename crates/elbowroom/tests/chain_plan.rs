//! `dstar-pso` for arms of more than two links: what it hands out is safe by a judge of its own and does the task; what it
//! cannot do it says.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
mod chain_judge;
#[path = "judge/distance.rs"]
mod distance;

use std::sync::atomic::{AtomicUsize, Ordering};

use build::{example, with_task};
use chain_judge::{assert_true, clearance};
use elbowroom::free_space::Reason;
use elbowroom::geometry::Point;
use elbowroom::planners::{DstarPlanner, DstarPsoPlanner, GuidedRrtConnectPlanner, OptimalPlanner};
use elbowroom::planning::{
    Monitor, Objective, Plan, PlanError, PlanSettings, Planner, Stage, Unwatched, plan,
};
use elbowroom::scene::{Place, Scene, Task, TaskPosture};

const SCENES: [&str; 3] = ["three-links", "five-links", "ten-links"];

/// The example's first task.
fn run(scene: &Scene, settings: &PlanSettings) -> Result<Plan, PlanError> {
    plan(scene, &scene.tasks()[0], &GuidedRrtConnectPlanner::default(), settings, &Unwatched)
}

fn with_evaluations(evaluations: usize) -> GuidedRrtConnectPlanner {
    GuidedRrtConnectPlanner { evaluations, ..GuidedRrtConnectPlanner::default() }
}

#[test]
fn narrow_places_are_passed_with_every_seed() {
    for name in SCENES {
        let scene = example(name);
        for task in scene.tasks() {
            for seed in 0..3 {
                let objective = [Objective::Tip, Objective::Joint, Objective::Time][seed as usize % 3];
                let settings = PlanSettings { seed, objective, ..PlanSettings::default() };
                let plan = plan(&scene, task, &GuidedRrtConnectPlanner::default(), &settings, &Unwatched)
                    .unwrap_or_else(|error| panic!("{name}, {}, seed {seed}: {error}", task.name));
                assert_true(&scene, task, &plan);
                // Start and goal alone tell something.
                assert!(plan.lower_bound().is_some() || objective != Objective::Tip);
                assert!(plan.lower_bound().is_none_or(|bound| 0.0 < bound && bound <= plan.cost()));
                assert!(
                    plan.record().paths_to_choose_from >= 1 && !plan.effort().unwrap().convergence.is_empty()
                );
            }
        }
    }
}

#[test]
fn the_examples_begin_and_end_clearly_free_and_lead_through_narrow_places() {
    for name in SCENES {
        let scene = example(name);
        assert_eq!(scene.tasks().len(), 2, "{name}");
        let narrow = 0.1 * scene.arm().reach()[1];
        for task in scene.tasks() {
            for place in [&task.start, &task.goal] {
                if let Place::Configuration(q) = place {
                    let clear = clearance(&scene, q);
                    assert!(clear > 0.02, "{name}, {}: {clear}", task.name);
                }
            }
            let plan =
                plan(&scene, task, &GuidedRrtConnectPlanner::default(), &PlanSettings::default(), &Unwatched)
                    .unwrap();
            let nearest = plan.trajectory().verdict().least_clearance.unwrap().distance;
            assert!(nearest < narrow, "{name}: {nearest}");
        }
    }
}

#[test]
fn same_seed_same_plan_whatever_the_threads() {
    let scene = example("five-links");
    let settings = PlanSettings { seed: 7, ..PlanSettings::default() };
    let once = run(&scene, &settings).unwrap();
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| run(&scene, &settings).unwrap()) == once, "{threads} threads");
    }
    let other = run(&scene, &PlanSettings { seed: 8, ..settings }).unwrap();
    assert!(other != once);
}

#[test]
fn an_arm_that_is_there_already_stands_still() {
    let scene = with_task(&example("three-links"), 0, |task| task.goal = task.start.clone());
    let plan = run(&scene, &PlanSettings::default()).unwrap();
    assert_eq!((plan.cost(), plan.trajectory().motion().duration()), (0.0, 0.0));
}

#[test]
fn from_configuration_to_configuration_through_the_window() {
    let scene = example("three-links");
    let there = run(&scene, &PlanSettings::default()).unwrap().joint_path().0.last().unwrap().clone();
    let scene = with_task(&scene, 0, |task| task.goal = Place::Configuration(there));
    for seed in 0..3 {
        let plan = run(&scene, &PlanSettings { seed, ..PlanSettings::default() }).unwrap();
        assert_true(&scene, &scene.tasks()[0], &plan);
    }
}

#[test]
fn what_cannot_be_asked_of_the_arm_is_said() {
    let scene = example("five-links");
    let with = |change: &dyn Fn(&mut Task)| {
        run(&with_task(&scene, 0, change), &PlanSettings::default()).unwrap_err()
    };
    let far = with(&|task| task.goal = Place::Tip(Point::new(1.2, 0.0)));
    let PlanError::Goal(not_free) = far else { panic!("{far}") };
    assert!(matches!(not_free.reasons[..], [(None, Reason::OutOfReach { .. })]));

    let blocked = with(&|task| task.goal = Place::Configuration([0.0; 5].into()));
    let PlanError::Goal(not_free) = blocked else { panic!("{blocked}") };
    assert!(matches!(not_free.reasons[..], [(None, Reason::Collision { .. })]));

    let inside = with(&|task| task.goal = Place::Tip(Point::new(0.52, 0.3)));
    assert!(matches!(inside, PlanError::EndNotFound { end: "goal", .. }), "{inside}");

    for posture in [TaskPosture::Up, TaskPosture::Down, TaskPosture::Keep] {
        let posture = with(&|task| task.posture = posture);
        assert_eq!(posture, PlanError::PostureOfMany { links: 5 });
    }
    for planner in [&DstarPlanner as &dyn Planner, &OptimalPlanner, &DstarPsoPlanner::default()] {
        let other =
            plan(&scene, &scene.tasks()[0], planner, &PlanSettings::default(), &Unwatched).unwrap_err();
        assert_eq!(
            other,
            PlanError::OtherArm { planner: planner.name().to_owned(), least: 2, most: 2, links: 5 }
        );
    }
}

#[test]
fn a_budget_that_is_too_small_is_kept_to() {
    // The tip is led around the wall's end first, which takes some thousand evaluations to unlearn.
    let scene = example("three-links");
    for seed in 0..3 {
        let settings = PlanSettings { seed, ..PlanSettings::default() };
        match plan(&scene, &scene.tasks()[1], &with_evaluations(2_000), &settings, &Unwatched) {
            Err(PlanError::NotFoundInBudget { evaluations }) => assert!(evaluations <= 2_000),
            other => panic!("{:?}", other.map(|plan| plan.cost())),
        }
    }
    let none = plan(&scene, &scene.tasks()[0], &with_evaluations(0), &PlanSettings::default(), &Unwatched);
    assert_eq!(none.unwrap_err(), PlanError::NotFoundInBudget { evaluations: 0 });
}

/// Says no after so many questions.
struct Until(AtomicUsize);

impl Monitor for Until {
    fn stage(&self, _stage: Stage) {}

    fn keep_going(&self) -> bool {
        self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_ok()
    }
}

#[test]
fn a_monitor_that_says_no_is_obeyed() {
    let scene = example("ten-links");
    let mut stopped = 0;
    for questions in [0, 1, 2, 3, 5, 8, 20, 50, 100, 200] {
        let monitor = Until(AtomicUsize::new(questions));
        match plan(
            &scene,
            &scene.tasks()[0],
            &GuidedRrtConnectPlanner::default(),
            &PlanSettings::default(),
            &monitor,
        ) {
            Err(PlanError::Stopped) => stopped += 1,
            Ok(_) => {}
            Err(other) => panic!("{questions}: {other}"),
        }
    }
    assert!(stopped >= 8, "{stopped}");
}
