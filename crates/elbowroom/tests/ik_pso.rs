//! `ik-pso`: what it hands out is safe by a judge of its own, does the task, and keeps to postures and budgets.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
mod chain_judge;
#[path = "judge/distance.rs"]
mod distance;

use std::sync::atomic::{AtomicUsize, Ordering};

use build::{example, with_task};
use chain_judge::assert_true;
use elbowroom::geometry::Point;
use elbowroom::planners::{self, IkPsoPlanner};
use elbowroom::planning::{
    Monitor, Objective, OptionValue, Plan, PlanError, PlanSettings, Stage, Unwatched, plan,
};
use elbowroom::scene::{Place, Scene, TaskPosture};

fn with(evaluations: usize) -> IkPsoPlanner {
    IkPsoPlanner { evaluations }
}

fn run(scene: &Scene, task: usize, evaluations: usize, seed: u64) -> Result<Plan, PlanError> {
    let settings = PlanSettings { seed, ..PlanSettings::default() };
    plan(scene, &scene.tasks()[task], &with(evaluations), &settings, &Unwatched)
}

#[test]
fn the_paper_s_tasks_are_done_with_every_seed() {
    let scene = example("paper-standin");
    for task in scene.tasks() {
        for seed in 0..8 {
            let objective = [Objective::Tip, Objective::Joint, Objective::Time][seed as usize % 3];
            let settings = PlanSettings { objective, seed, ..PlanSettings::default() };
            let plan = plan(&scene, task, &with(60_000), &settings, &Unwatched).unwrap();
            assert_true(&scene, task, &plan);
            let bound = plan.lower_bound().unwrap();
            assert!(bound > 0.0 && bound <= plan.cost(), "{bound}, {}", plan.cost());
            assert!(plan.effort().unwrap().evaluations <= 60_000);
        }
    }
}

#[test]
fn postures_asked_for_are_kept_to() {
    let example = example("paper-standin");
    for posture in [TaskPosture::Up, TaskPosture::Down, TaskPosture::Keep] {
        let mut planned = 0;
        for task in 0..2 {
            let scene = with_task(&example, task, |task| task.posture = posture);
            for seed in 0..3 {
                let plan = match run(&scene, task, 100_000, seed) {
                    Ok(plan) => plan,
                    Err(PlanError::NotFoundInBudget { .. }) => continue,
                    Err(other) => panic!("{posture:?}, {task}: {other}"),
                };
                planned += 1;
                assert_true(&scene, &scene.tasks()[task], &plan);
                let motion = plan.trajectory().motion();
                let bends: Vec<f64> = (0..=1000)
                    .map(|i| {
                        motion.at(motion.start() + motion.duration() * i as f64 / 1000.0).position[1].sin()
                    })
                    .collect();
                let last = bends[1000];
                match posture {
                    TaskPosture::Up => assert!(last <= 1e-9),
                    TaskPosture::Down => assert!(last >= -1e-9),
                    _ => assert!(bends.iter().all(|b| *b > 0.0) || bends.iter().all(|b| *b < 0.0)),
                }
            }
        }
        assert!(planned >= 3, "{posture:?}: {planned}");
    }
}

#[test]
fn a_goal_given_as_a_configuration_is_reached_exactly() {
    let scene = example("paper-standin");
    let there = run(&scene, 0, 60_000, 0).unwrap().joint_path().0.last().unwrap().clone();
    let scene = with_task(&scene, 0, |task| task.goal = Place::Configuration(there));
    for seed in 0..3 {
        let plan = run(&scene, 0, 60_000, seed).unwrap();
        assert_true(&scene, &scene.tasks()[0], &plan);
    }
    let scene = example("five-links");
    let plan = run(&scene, 1, 200_000, 0).unwrap();
    assert_true(&scene, &scene.tasks()[1], &plan);
}

#[test]
fn arms_of_more_links_pass_narrow_places() {
    let mut planned = 0;
    for name in ["three-links", "five-links", "ten-links"] {
        let scene = example(name);
        for seed in 0..3 {
            match run(&scene, 0, 150_000, seed) {
                Ok(plan) => {
                    planned += 1;
                    assert_true(&scene, &scene.tasks()[0], &plan);
                    assert!(plan.lower_bound().is_none_or(|bound| bound <= plan.cost()));
                }
                Err(PlanError::NotFoundInBudget { evaluations }) => assert!(evaluations <= 150_000),
                Err(other) => panic!("{name}, seed {seed}: {other}"),
            }
        }
    }
    assert!(planned >= 7, "{planned} of 9");
}

#[test]
fn same_seed_same_plan_whatever_the_threads() {
    let scene = example("three-links");
    let once = run(&scene, 0, 60_000, 3).unwrap();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| run(&scene, 0, 60_000, 3).unwrap()) == once, "{threads} threads");
    }
}

#[test]
fn budgets_are_kept_to() {
    for name in ["paper-standin", "ten-links"] {
        let scene = example(name);
        for evaluations in [0, 1, 10, 300, 3_000] {
            match run(&scene, 0, evaluations, 1) {
                Err(PlanError::NotFoundInBudget { evaluations: made }) => assert!(made <= evaluations),
                other => panic!("{name}, {evaluations}: {:?}", other.map(|plan| plan.cost())),
            }
        }
    }
}

#[test]
fn no_path_is_said_where_it_is_proved_and_bad_tasks_are_refused() {
    let example = example("paper-standin");
    // A ring of discs around the goal that the tip cannot leave.
    let mut scene = example.clone();
    for i in 0..24 {
        let angle = f64::from(i) * std::f64::consts::TAU / 24.0;
        let [x, y] = [-0.45 + 0.04 * angle.cos(), -0.15 + 0.04 * angle.sin()];
        scene = build::with_obstacle(&scene, build::circle(x, y, 0.006));
    }
    let walled = run(&scene, 0, 50_000, 0).unwrap_err();
    assert!(matches!(walled, PlanError::NoPath(_) | PlanError::Goal(_)), "{walled}");

    let to = |goal: Point| with_task(&example, 0, |task| task.goal = Place::Tip(goal));
    let scene = to(Point::new(0.6, 0.0));
    assert!(matches!(run(&scene, 0, 50_000, 0), Err(PlanError::Goal(_))));
    let scene = to(Point::new(0.22, 0.22));
    assert!(matches!(run(&scene, 0, 50_000, 0), Err(PlanError::Goal(_))));
    let scene = with_task(&example, 0, |task| task.goal = task.start.clone());
    let stays = run(&scene, 0, 0, 0).unwrap();
    assert_eq!((stays.cost(), stays.lower_bound()), (0.0, Some(0.0)));

    let five = with_task(&build::example("five-links"), 0, |task| task.posture = TaskPosture::Up);
    assert_eq!(run(&five, 0, 1_000, 0), Err(PlanError::PostureOfMany { links: 5 }));
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
    let scene = example("five-links");
    for questions in [0, 1, 3, 10, 30, 100, 200] {
        let monitor = Until(AtomicUsize::new(questions));
        let stopped = plan(&scene, &scene.tasks()[0], &with(10_000_000), &PlanSettings::default(), &monitor);
        assert!(matches!(stopped, Err(PlanError::Stopped)), "{questions}");
    }
}

#[test]
fn it_goes_by_its_name() {
    let options = [("evaluations".to_owned(), OptionValue::Count(5))];
    let planner = planners::by_name("ik-pso", &options).unwrap();
    assert_eq!(planner.options(), [("evaluations", OptionValue::Count(5))]);
    assert_eq!(planner.budget(), Some("evaluations"));
    assert!(planners::by_name("ik-pso", &[("candidates".to_owned(), OptionValue::Count(5))]).is_err());
}
