//! `pso`, `cbpso` and `nsc-pso`: what they hand out is safe by a judge of its own and does the task; budgets, options and
//! seeds are kept to.

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
use elbowroom::planners::{self, NameError};
use elbowroom::planning::{
    Monitor, Objective, OptionValue, Pace, PlanError, PlanSettings, Planner, Stage, Unwatched, plan,
};
use elbowroom::scene::TaskPosture;

fn planner(name: &str, options: &[(&str, OptionValue)]) -> Box<dyn Planner> {
    let options: Vec<_> = options.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    planners::by_name(name, &options).unwrap()
}

fn count(count: usize) -> OptionValue {
    OptionValue::Count(count)
}

fn word(word: &str) -> OptionValue {
    OptionValue::Word(word.to_owned())
}

#[test]
fn both_tasks_of_the_paper_are_done_safely() {
    let scene = example("paper-standin");
    for name in ["pso", "cbpso", "nsc-pso"] {
        let mut solved = 0;
        for (seed, task) in scene.tasks().iter().cycle().take(4).enumerate() {
            let objective = [Objective::Tip, Objective::Joint, Objective::Time][seed % 3];
            let settings = PlanSettings { seed: seed as u64, objective, ..PlanSettings::default() };
            match plan(&scene, task, &*planner(name, &[]), &settings, &Unwatched) {
                Ok(plan) => {
                    assert_true(&scene, task, &plan);
                    let effort = plan.effort().unwrap();
                    let falls = |pair: &[(usize, f64)]| pair[0].0 < pair[1].0 && pair[0].1 > pair[1].1;
                    assert!(effort.convergence.windows(2).all(falls), "{effort:?}");
                    assert!(effort.convergence.iter().all(|(made, _)| *made <= effort.evaluations));
                    solved += 1;
                }
                Err(PlanError::NotFoundInBudget { .. }) => {}
                Err(other) => panic!("{name}: {other}"),
            }
        }
        assert!(solved >= 2, "{name}: {solved} of 4");
    }
}

#[test]
fn a_cultural_swarm_reaches_through_narrow_places_with_many_links() {
    for name in ["three-links", "five-links"] {
        let scene = example(name);
        let found = (0..4).find_map(|seed| {
            let settings = PlanSettings { seed, ..PlanSettings::default() };
            plan(&scene, &scene.tasks()[0], &*planner("cbpso", &[]), &settings, &Unwatched).ok()
        });
        assert_true(&scene, &scene.tasks()[0], &found.unwrap());
    }
}

#[test]
fn budgets_are_kept_and_a_seed_is_a_plan() {
    let scene = example("paper-standin");
    for name in ["pso", "cbpso", "nsc-pso"] {
        let run = |seed: u64, evaluations: usize| {
            let planner = planner(name, &[("evaluations", count(evaluations))]);
            let settings = PlanSettings { seed, ..PlanSettings::default() };
            plan(&scene, &scene.tasks()[0], &*planner, &settings, &Unwatched)
        };
        assert_eq!(run(3, 6000), run(3, 6000), "{name}");
        assert_ne!(run(3, 6000).ok(), run(4, 6000).ok(), "{name}");
        assert!(run(3, 6000).is_ok_and(|plan| plan.effort().unwrap().evaluations == 6000), "{name}");
        assert_eq!(run(0, 1).err(), Some(PlanError::NotFoundInBudget { evaluations: 1 }), "{name}");
    }
}

#[test]
fn a_posture_is_kept_and_a_duration_met() {
    let scene = with_task(&example("paper-standin"), 0, |task| task.posture = TaskPosture::Keep);
    for name in ["pso", "cbpso"] {
        let settings = PlanSettings { pace: Pace::Duration(12.0), ..PlanSettings::default() };
        let plan = plan(&scene, &scene.tasks()[0], &*planner(name, &[]), &settings, &Unwatched).unwrap();
        assert_true(&scene, &scene.tasks()[0], &plan);
        assert!((plan.trajectory().motion().duration() - 12.0).abs() < 1e-9, "{name}");
        assert!(plan.trajectory().verdict().posture_changes.is_empty(), "{name}");
    }
}

#[test]
fn options_are_read_and_what_is_none_is_refused() {
    for planner in planners::all() {
        let options: Vec<_> = planner.options().into_iter().map(|(n, v)| (n.to_owned(), v)).collect();
        assert_eq!(planners::by_name(planner.name(), &options).unwrap().options(), planner.options());
        let budget = planner.budget();
        assert!(budget.is_none_or(|name| planner.options().iter().any(|(option, _)| *option == name)));
    }
    let refused = |name: &str, option: &str, value: OptionValue| {
        planners::by_name(name, &[(option.to_owned(), value)]).unwrap_err().to_string()
    };
    assert_eq!(
        refused("pso", "neighbourhood", word("star")),
        "option neighbourhood of planner pso is 'star', it must be global or ring"
    );
    assert_eq!(
        refused("nsc-pso", "waypoints", count(0)),
        "option waypoints of planner nsc-pso is 0, it must be a whole number from 1 to 64"
    );
    assert_eq!(
        refused("cbpso", "via", count(1)),
        "planner cbpso has no option 'via'; known: vias, evaluations"
    );
    assert_eq!(refused("dstar", "vias", count(1)), "planner dstar has no option 'vias'; known: it has none");
    let Err(NameError::Planner { known, .. }) = planners::by_name("rrt", &[]) else { panic!() };
    assert_eq!(known.len(), planners::all().len());
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
fn a_planner_that_is_stopped_says_so_or_hands_out_what_it_has() {
    let scene = example("paper-standin");
    for name in ["pso", "cbpso", "nsc-pso"] {
        for questions in [0, 1, 5, 60] {
            let until = Until(AtomicUsize::new(questions));
            match plan(&scene, &scene.tasks()[0], &*planner(name, &[]), &PlanSettings::default(), &until) {
                Err(PlanError::Stopped) => {}
                Ok(plan) => assert_true(&scene, &scene.tasks()[0], &plan),
                Err(other) => panic!("{name}, {questions}: {other}"),
            }
        }
    }
}

#[test]
fn an_arm_that_is_there_already_stands_still_and_bounds_are_told() {
    let scene = example("paper-standin");
    for name in ["pso", "cbpso", "nsc-pso"] {
        let found =
            plan(&scene, &scene.tasks()[0], &*planner(name, &[]), &PlanSettings::default(), &Unwatched);
        if let Ok(plan) = found {
            assert!(plan.lower_bound().unwrap() <= plan.cost(), "{name}");
        }
    }
    let scene = with_task(&scene, 0, |task| task.goal = task.start.clone());
    for name in ["pso", "cbpso", "nsc-pso"] {
        let plan =
            plan(&scene, &scene.tasks()[0], &*planner(name, &[]), &PlanSettings::default(), &Unwatched)
                .unwrap();
        assert_eq!((plan.cost(), plan.gap()), (0.0, Some(0.0)), "{name}");
    }
}
