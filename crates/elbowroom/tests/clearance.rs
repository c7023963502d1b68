//! Motions that keep a clearance that was asked for, and proofs that none does.

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

use elbowroom::planners::{self, DstarPlanner, DstarPsoPlanner, OptimalPlanner};
use elbowroom::planning::{Objective, Plan, PlanError, PlanSettings, Planner, Unwatched, plan};
use elbowroom::scene::{Place, Scene, SceneProblem};
use elbowroom::units::Told;

fn keeping(
    scene: &Scene,
    planner: &dyn Planner,
    objective: Objective,
    clearance: Option<f64>,
) -> Result<Plan, PlanError> {
    let settings = PlanSettings { objective, clearance, ..PlanSettings::default() };
    plan(scene, &scene.tasks()[0], planner, &settings, &Unwatched)
}

/// The least clearance at many places of the motion, by other distances than the program's.
fn least(scene: &Scene, plan: &Plan) -> f64 {
    let motion = plan.trajectory().motion();
    let at = |i: usize| motion.at(motion.start() + motion.duration() * i as f64 / 4000.0).position;
    (0..=4000).map(|i| judge::clearance(scene, [at(i)[0], at(i)[1]])).fold(f64::INFINITY, f64::min)
}

#[test]
fn motions_keep_the_clearance_that_was_asked_for() {
    let mut kept = 0;
    let mut refused = 0;
    for seed in 0..40 {
        let Some(scene) = worlds::world(seed) else { continue };
        for (planner, objective) in [
            (&DstarPlanner as &dyn Planner, Objective::Tip),
            (&DstarPsoPlanner::default(), Objective::Time),
            (&OptimalPlanner, Objective::Joint),
        ] {
            for clearance in [0.003, 0.02] {
                match keeping(&scene, planner, objective, Some(clearance)) {
                    Ok(plan) => {
                        let found = least(&scene, &plan);
                        assert!(found > clearance, "seed {seed}, {}: {found}", planner.name());
                        let told =
                            plan.trajectory().verdict().least_clearance.map_or(found, |at| at.distance);
                        assert!(
                            told > clearance && (told == found || (told - found).abs() < 1e-4),
                            "{told} {found}"
                        );
                        assert_eq!(plan.record().clearance, clearance);
                        assert!(plan.lower_bound().is_none_or(|bound| bound <= plan.cost()));
                        kept += 1;
                    }
                    Err(PlanError::BelowBound { cost, bound }) => panic!("{cost} {bound}"),
                    Err(_) => refused += 1,
                }
            }
        }
    }
    assert!(kept > 60 && refused > 0, "{kept} {refused}");
}

#[test]
fn a_gap_too_narrow_for_the_clearance_is_a_proof_and_a_start_too_near_is_told() {
    // Two walls with a passage of 0.3 between them, an arm 0.1 wide: 0.1 on each side.
    let walls =
        [[[0.4, 0.15], [2.5, 0.15]], [[0.4, -0.15], [2.5, -0.15]]].map(|ends| build::segment(ends, 0.0));
    let arm = build::arm_of(&[1.0, 1.0], 0.05, &[build::joint(build::stops(-1.5, 1.5)); 2]);
    let scene = build::scene(arm, walls.to_vec());
    let ends = [[1.2, -0.1], [0.0, 0.0]].map(|q| Place::Configuration(q.into()));
    let [start, goal] = ends.clone();
    let scene = scene
        .with_tasks(vec![build::task("in", goal.clone(), start, elbowroom::scene::TaskPosture::Any)])
        .unwrap();
    // Out of the passage the arm does not get, with or without clearance: its links are as long as the walls.
    assert!(matches!(
        keeping(&scene, &OptimalPlanner, Objective::Joint, None),
        Err(PlanError::Start(_) | PlanError::Goal(_) | PlanError::NoPath(_))
    ));
    let Err(PlanError::Start(refused)) = keeping(&scene, &OptimalPlanner, Objective::Joint, Some(0.12))
    else {
        panic!("0.1 m are left on each side")
    };
    let told = refused.told(elbowroom::units::Units::SI);
    assert!(told.contains("link 1 would be 0.1 m from obstacle"), "{told}");
    assert!(told.contains("0.12 m were asked for"), "{told}");
}

#[test]
fn what_separates_start_and_goal_with_a_clearance_may_not_without() {
    // The arm, nearly straight, passes by a post just beyond its reach; bent as far as it can it keeps 0.035 m.
    let joints = [build::joint(build::stops(-1.2, 1.2)), build::joint(build::stops(-0.2, 0.2))];
    let scene = build::scene(build::arm_of(&[0.5, 0.5], 0.0, &joints), vec![build::circle(1.05, 0.0, 0.02)]);
    let [start, goal] = [[-0.8, 0.0], [0.8, 0.0]].map(|q| Place::Configuration(q.into()));
    let task = build::task("past", start, goal, elbowroom::scene::TaskPosture::Any);
    let scene = scene.with_tasks(vec![task]).unwrap();
    let of = |clearance| keeping(&scene, &OptimalPlanner, Objective::Joint, clearance);
    let farthest = 1.03 - (0.5 + 0.5 * 0.2_f64.cos()).hypot(0.5 * 0.2_f64.sin());
    let free = of(None).unwrap();
    assert_eq!(free, of(Some(0.0)).unwrap());
    let kept = of(Some(farthest - 1e-4)).unwrap();
    assert!(kept.cost() > free.cost() && least(&scene, &kept) > farthest - 1e-4);
    let Err(PlanError::NoPath(proof)) = of(Some(farthest + 1e-4)) else { panic!("nothing keeps that") };
    assert_eq!(proof.clearance, farthest + 1e-4);
    assert!(proof.to_string().starts_with("no path with a clearance of 0.03"), "{proof}");
}

#[test]
fn a_task_says_its_own_clearance_and_who_asks_overrules_it() {
    let scene = build::with_task(&build::example("paper-standin"), 0, |task| task.clearance = 0.01);
    let by_task = keeping(&scene, &DstarPlanner, Objective::Time, None).unwrap();
    assert!(least(&scene, &by_task) > 0.01);
    let by_hand = keeping(&scene, &DstarPlanner, Objective::Time, Some(0.0)).unwrap();
    assert!(least(&scene, &by_hand) < 0.01 && by_hand.record().clearance == 0.0);
    for clearance in [-1.0, f64::NAN, f64::INFINITY] {
        let mut tasks = scene.tasks().to_vec();
        tasks[0].clearance = clearance;
        assert!(matches!(scene.with_tasks(tasks), Err(SceneProblem::Clearance { .. })));
        let refused = keeping(&scene, &DstarPlanner, Objective::Time, Some(clearance));
        assert!(matches!(refused, Err(PlanError::Clearance { .. })), "{clearance}");
    }
}

#[test]
fn links_keep_it_from_each_other_too() {
    let scene = build::example("three-links");
    let arm = scene.arm();
    let folding = elbowroom::arm::Arm::new(
        arm.base(),
        arm.lengths().to_vec(),
        arm.half_width(),
        arm.joints().to_vec(),
        true,
    );
    let scene = scene.with_arm(folding.unwrap()).unwrap();
    let planner = planners::default_for(scene.arm());
    let plan = keeping(&scene, &*planner, Objective::Joint, Some(0.01)).unwrap();
    let motion = plan.trajectory().motion();
    for i in 0..=2000 {
        let q = motion.at(motion.start() + motion.duration() * f64::from(i) / 2000.0).position;
        assert!(elbowroom::path::self_clearance(&scene, &q) > 0.01);
        assert!(elbowroom::path::link_clearances(&scene, &q).into_iter().all(|it| it > 0.01));
    }
}
