//! A roadmap kept while obstacles move, against one from scratch, the planner, the certificate and the dense judge.

use std::f64::consts::PI;

use elbowroom::arm::JointLimits;
use elbowroom::free_space::FreeSpace;
use elbowroom::online::{NoRoute, Roadmap, Route, Upkeep};
use elbowroom::path::straight_move_is_free;
use elbowroom::planners::DstarPlanner;
use elbowroom::planning::{Objective, PlanError, PlanSettings, Unwatched, plan};
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Scene, SceneProblem, Sight, Task};
use elbowroom::trajectory::{Motion, Piece, State};

use crate::{build, judge, moves, worlds};

/// Where the arm is: any configuration within the limits.
fn anywhere(numbers: &mut worlds::Numbers, scene: &Scene) -> [f64; 2] {
    std::array::from_fn(|j| match scene.arm().joints()[j].limits {
        JointLimits::Continuous => numbers.within(-PI, PI),
        JointLimits::Range { min, max } => numbers.within(min, max),
    })
}

fn bits(field: &[f64]) -> Vec<u64> {
    field.iter().map(|cost| cost.to_bits()).collect()
}

/// Every turn is certified in the scene as it is, and the arm that stops at every corner touches nothing.
fn assert_free(scene: &Scene, q: &[f64; 2], Route { path, cost }: &Route) {
    assert_eq!(*path.0[0], *q);
    for pair in path.0.windows(2) {
        let (there, back) = (
            straight_move_is_free(scene, &pair[0], &pair[1]),
            straight_move_is_free(scene, &pair[1], &pair[0]),
        );
        assert!(there || back, "{pair:?} is not free in {scene:#?}");
    }
    // Halved turns bring the tip back to the straight line: the grid's cost is no more than a little below the truth.
    assert!(path.tip_travel(scene.arm()) >= cost * 0.99 - 1e-9, "{} {cost}", path.tip_travel(scene.arm()));
    let turns = path.0.windows(2).enumerate().map(|(i, pair)| {
        Piece::quintic(100.0 * i as f64, 100.0, &State::rest(&pair[0]), &State::rest(&pair[1]))
    });
    if path.0.len() > 1 {
        let motion = Motion::new(turns.collect()).unwrap();
        assert_eq!(judge::fault(scene, &motion, 6), None, "{path:?}");
    }
}

#[derive(Debug, Default)]
struct Tally {
    updates: u32,
    repaired: u32,
    routes: u32,
    goal_blocked: u32,
    start: u32,
    not_found: u32,
    plans: u32,
    untouched: u32,
}

/// One world, many updates: everything after each equals what a roadmap of the new scene alone would have.
fn follow(seed: u64, tally: &mut Tally) {
    let Some(mut scene) = worlds::world(seed) else { return };
    if seed.is_multiple_of(40) {
        let reach: f64 = scene.arm().lengths().iter().sum();
        scene = scene.with_grid(build::grid(reach, reach / 60.0));
    }
    let task = scene.tasks()[0].clone();
    let mut numbers = worlds::Numbers::seeded(seed ^ 0x5a);
    let Ok(kept) = Roadmap::new(scene, &task) else { return };
    let mut kept = match numbers.below(8) {
        0 => kept.with_upkeep(Upkeep::Anew),
        1 => kept,
        _ => kept.with_upkeep(Upkeep::Repair),
    };
    let mut q = anywhere(&mut numbers, kept.scene());
    for update in 0..8 {
        if update > 0 {
            let obstacles = moves::update(&mut numbers, kept.scene());
            let updated = kept.move_obstacles(obstacles).unwrap();
            tally.updates += 1;
            tally.repaired += u32::from(updated.repaired.is_some_and(|nodes| nodes > 0));
            tally.untouched += u32::from(updated.repaired == Some(0));
        }
        let scene = kept.scene().clone();
        assert!(*kept.space() == FreeSpace::of(scene.two_link().unwrap()));
        let mut fresh = Roadmap::new(scene.clone(), &task).unwrap();
        if numbers.below(3) == 0 {
            q = anywhere(&mut numbers, &scene);
        }
        // Not always settled before the next update comes.
        if numbers.below(4) > 0 {
            let (route, judged) = (kept.path_from(&q), fresh.path_from(&q));
            let cost =
                |route: &Result<Route, NoRoute>| route.as_ref().map(|r| r.cost.to_bits()).map_err(|e| *e);
            assert_eq!(cost(&route), cost(&judged), "seed {seed}, update {update}, {scene:#?}");
            match &route {
                Ok(route) => {
                    assert_free(&scene, &q, route);
                    tally.routes += 1;
                }
                Err(NoRoute::Goal) => tally.goal_blocked += 1,
                Err(NoRoute::Start) => tally.start += 1,
                Err(NoRoute::NotFound) => tally.not_found += 1,
                Err(NoRoute::Stopped) => unreachable!(),
            }
            if seed.is_multiple_of(12) {
                compare_with_plan(&scene, &task, &q, &route, tally);
            }
            if let Ok(route) = route {
                // Along the way, as an arm would.
                let along = &route.path.0[numbers.below(route.path.0.len() as u64) as usize];
                q = [along[0], along[1]];
            }
        }
        if numbers.below(2) == 0 {
            assert_eq!(bits(&kept.whole_field()), bits(&fresh.whole_field()), "seed {seed}, update {update}");
        }
    }
}

/// The planner, which keeps nothing, finds a path of the same cost.
fn compare_with_plan(
    scene: &Scene,
    task: &Task,
    q: &[f64; 2],
    route: &Result<Route, NoRoute>,
    tally: &mut Tally,
) {
    let task = Task { start: Place::Configuration((*q).into()), ..task.clone() };
    let settings = PlanSettings { objective: Objective::Tip, ..PlanSettings::default() };
    match plan(scene, &task, &DstarPlanner, &settings, &Unwatched) {
        Ok(found) => {
            let cost = route.as_ref().unwrap().cost;
            assert!(
                (found.record().path_cost - cost).abs() <= 1e-9 * cost + 1e-12,
                "{} {cost}",
                found.record().path_cost
            );
            tally.plans += 1;
        }
        Err(PlanError::Start(_) | PlanError::Goal(_) | PlanError::GoalPosture { .. }) => {
            assert!(route.is_err());
        }
        Err(PlanError::NotFound { .. } | PlanError::NoPath(_)) => assert!(route.is_err()),
        Err(_) => {}
    }
}

#[test]
fn what_is_kept_equals_what_is_found_from_scratch() {
    let mut tally = Tally::default();
    for seed in 0..500 {
        follow(seed, &mut tally);
    }
    assert!(tally.updates > 2_500 && tally.repaired > 500 && tally.routes > 1_000, "{tally:?}");
    assert!(
        tally.goal_blocked > 20 && tally.not_found > 20 && tally.start > 20 && tally.plans > 50,
        "{tally:?}"
    );
}

#[test]
fn a_roadmap_is_for_two_links_among_obstacles_that_stand_still() {
    let scene = (0..).find_map(|seed| worlds::world(seed).filter(|s| s.obstacles().len() > 1)).unwrap();
    let task = scene.tasks()[0].clone();
    let moving = || {
        let motion = ObstacleMotion::new(Course::Absent, Sight::Always, None).unwrap();
        let moving = |obstacle: &Obstacle| Obstacle { motion: Some(motion.clone()), ..obstacle.clone() };
        scene.obstacles().iter().map(moving).collect::<Vec<_>>()
    };
    let refused = Roadmap::new(scene.with_obstacles(moving()).unwrap(), &task).err();
    assert!(matches!(refused, Some(PlanError::Moving { obstacle: 0, .. })), "{refused:?}");
    let three = build::scene(build::arm(&[0.2, 0.2, 0.2]), Vec::new());
    let refused = Roadmap::new(three, &task).err();
    assert!(matches!(refused, Some(PlanError::OtherArm { links: 3, .. })), "{refused:?}");

    let mut roadmap = Roadmap::new(scene.clone(), &task).unwrap();
    let alike: Vec<Obstacle> =
        scene.obstacles().iter().map(|o| Obstacle { name: Some("one".to_owned()), ..o.clone() }).collect();
    let refused = roadmap.move_obstacles(alike);
    assert_eq!(refused, Err(SceneProblem::ObstacleName { name: "one".to_owned() }));
    assert_eq!(*roadmap.scene(), scene);
    // Where they are is what counts, not how they move.
    assert_eq!(roadmap.move_obstacles(moving()).map(|updated| updated.cells), Ok(0));
    assert_eq!(*roadmap.scene(), scene);
}
