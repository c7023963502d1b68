//! The paper's system: its arm and tasks among our five circles, with Table 1's limits, and with no obstacle.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::cell::Cell;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use build::{CIRCLES, joint, stops, with_task};
use elbowroom::arm::{Arm, JointLimits, MotionLimits, joint_distance};
use elbowroom::free_space::{FreeSpace, configurations};
use elbowroom::geometry::{Point, Vector};
use elbowroom::path::{Jump, JumpKind, TipPath, follow};
use elbowroom::planners::{Method, PaperError, PaperPlan, PaperSettings, plan_as_in_paper};
use elbowroom::planning::{Monitor, Stage, Unwatched};
use elbowroom::scene::{Place, Scene};

/// The paper's arm; joint 2 within `bend` degrees.
fn scene(first: JointLimits, bend: f64, circles: &[[f64; 2]], step: f64) -> Scene {
    build::paper(first, bend.to_radians(), MotionLimits::default(), circles, step)
}

/// The paper's arm with stops at 0 and 360 degrees, and joint 2 never negative. With the tip 40 cm out, link 1
/// points 36.87 degrees (0.6435 rad) to the right of it.
fn elbow_down_only() -> Arm {
    let limits = [stops(0.0, 360f64.to_radians()), stops(0.1, 150f64.to_radians())];
    build::arm_of(&[0.25, 0.25], 0.0, &limits.map(joint))
}

fn standin() -> Scene {
    scene(JointLimits::Continuous, 150.0, &CIRCLES, 0.01)
}

fn table1(step: f64) -> Scene {
    scene(stops(0.0, 360f64.to_radians()), 90.0, &CIRCLES, step)
}

fn plan(scene: &Scene, task: usize, settings: &PaperSettings) -> Result<PaperPlan, PaperError> {
    plan_as_in_paper(scene, &scene.tasks()[task], settings, &Unwatched)
}

fn dstar() -> PaperSettings {
    PaperSettings { method: Method::Dstar, ..PaperSettings::default() }
}

fn to_micrometres(cost: f64) -> f64 {
    (cost * 1e6).round()
}

/// Octile distance of `long` and `short` steps of 1 cm (µm, rounded).
fn octile(straight: f64, diagonal: f64) -> f64 {
    to_micrometres(0.01 * (straight + diagonal * std::f64::consts::SQRT_2))
}

#[test]
fn on_the_stand_in_scene_the_swarm_meets_the_optimum_of_dstar_for_95_of_100_seeds() {
    let scene = standin();
    // 85 columns and 25 rows apart; 15 and 75: nothing is in the way of an octile path.
    for (task, optimum) in [(0, octile(60.0, 25.0)), (1, octile(60.0, 15.0))] {
        let plain = plan(&scene, task, &dstar()).unwrap();
        assert_eq!(to_micrometres(plain.cost), optimum);
        assert_eq!(plain.equal_paths.len(), 1);
        let met = (0..100)
            .filter(|&seed| {
                let settings = PaperSettings { seed, ..PaperSettings::default() };
                let drawn = plan(&scene, task, &settings).unwrap();
                assert!(to_micrometres(drawn.cost) >= optimum);
                assert!((drawn.tip_path.length() - drawn.cost).abs() < 1e-9);
                to_micrometres(drawn.cost) == optimum
            })
            .count();
        assert!(met >= 95, "task {task}: {met} of 100 seeds");
    }
}

#[test]
fn among_the_equal_paths_none_comes_twice_and_all_cost_the_same() {
    let scene = standin();
    let drawn = plan(&scene, 1, &PaperSettings::default()).unwrap();
    assert!(drawn.equal_paths.len() > 10, "{} paths", drawn.equal_paths.len());
    for (i, path) in drawn.equal_paths.iter().enumerate() {
        assert!((path.length() - drawn.cost).abs() < 1e-9);
        assert!(!drawn.equal_paths[..i].contains(path));
        for tip in &path.0 {
            assert!(configurations(scene.two_link().unwrap(), &Place::Tip(*tip)).is_ok());
        }
    }
}

#[test]
fn with_no_obstacle_the_cost_is_that_of_the_annulus() {
    let scene = scene(JointLimits::Continuous, 90.0, &[], 0.01);
    for (task, cost) in [(0, 1.24468), (1, 0.86184)] {
        let found = plan(&scene, task, &dstar()).unwrap().cost;
        assert!((found - cost).abs() < 5e-6, "{found}");
    }
}

#[test]
fn with_table_1_nothing_is_found_at_a_centimetre_and_the_first_task_at_a_finer_step() {
    for task in 0..2 {
        for settings in [dstar(), PaperSettings::default()] {
            let refused = plan(&table1(0.01), task, &settings).unwrap_err();
            assert_eq!(refused, PaperError::NotFound { step: 0.01 });
        }
    }
    // The gap between a circle and the inner end of the reach is 0.14 cm.
    let found = plan(&table1(0.001), 0, &dstar()).unwrap();
    assert!(found.cost > 1.16287, "{}", found.cost);
}

#[test]
fn the_motion_goes_through_its_vias_in_the_time_asked_for() {
    let scene = standin();
    for seed in 0..20 {
        let settings = PaperSettings { seed, vias: 4, duration: 10.0, ..PaperSettings::default() };
        let plan = plan(&scene, 0, &settings).unwrap();
        assert_eq!(plan.vias.len(), 6);
        assert_eq!((plan.motion.start(), plan.motion.pieces().len()), (0.0, 5));
        assert!((plan.motion.end() - 10.0).abs() < 1e-12);
        for (piece, &via) in plan.motion.pieces().iter().zip(&plan.vias) {
            assert!(joint_distance(&piece.at(0.0).position, &plan.joint_path.0[via]) < 1e-12);
        }
        let last = plan.motion.at(10.0);
        assert!(joint_distance(&last.position, plan.joint_path.0.last().unwrap()) < 1e-9);
        assert!(last.velocity.iter().chain(&last.acceleration).all(|v| v.abs() < 1e-9));
    }
}

#[test]
fn same_seed_same_plan() {
    let scene = standin();
    let settings = PaperSettings { seed: 7, ..PaperSettings::default() };
    assert_eq!(plan(&scene, 1, &settings).unwrap(), plan(&scene, 1, &settings).unwrap());
    let other = PaperSettings { seed: 8, ..settings };
    assert_ne!(plan(&scene, 1, &settings).unwrap().vias, plan(&scene, 1, &other).unwrap().vias);
}

#[test]
fn a_path_that_must_change_posture_off_the_stretch_is_said_to_jump() {
    // With the tip 33 cm out the elbow is 48.7 degrees to its side: one circle is in the elbow-up arm's way at
    // the path's beginning, the other in the elbow-down arm's at its end.
    let on_ring = |degree: f64| [0.2 * degree.to_radians().cos(), 0.2 * degree.to_radians().sin()];
    let scene = scene(JointLimits::Continuous, 150.0, &[on_ring(48.7), on_ring(11.3)], 0.01);
    let path = |points: &[[f64; 2]]| TipPath(points.iter().map(|p| Point::new(p[0], p[1])).collect());
    let straight = path(&[[-0.4, 0.0], [-0.39, 0.0], [-0.38, 0.0]]);
    assert!(follow(scene.two_link().unwrap(), &straight).is_ok_and(|followed| followed.jumps.is_empty()));
    let arc: Vec<[f64; 2]> = (0..=60)
        .map(|degree| f64::from(degree).to_radians())
        .map(|angle| [0.33 * angle.cos(), 0.33 * angle.sin()])
        .collect();
    let followed = follow(scene.two_link().unwrap(), &path(&arc)).unwrap();
    assert_eq!(followed.jumps.len(), 1);
    for jump in &followed.jumps {
        assert_eq!(jump.kind, JumpKind::Posture);
        let (a, b) = (&followed.joints.0[jump.index], &followed.joints.0[jump.index + 1]);
        assert!(a[1] * b[1] < 0.0);
    }
}

#[test]
fn joint_1_with_stops_jumps_where_the_path_crosses_them() {
    let with_stops = scene(stops(0.0, 360f64.to_radians()), 150.0, &[], 0.01);
    let crossing = plan(&with_stops, 1, &dstar()).unwrap();
    // Whether it changes its posture at the same time or not, joint 1 would have to turn most of the way round.
    assert_eq!(crossing.jumps.len(), 1);
    let at = crossing.jumps[0].index;
    let turn = crossing.joint_path.0[at + 1][0] - crossing.joint_path.0[at][0];
    assert!(turn.abs() > std::f64::consts::PI, "{turn}");
    // One posture only: then it is the stop and nothing else.
    let one_posture = with_stops.with_arm(elbow_down_only()).unwrap();
    let path = [-5.0, -2.0, 2.0, 5.0]
        .map(|degree: f64| Point::new(0.0, 0.0) + Vector::polar(0.4, degree.to_radians() + 0.6435));
    let followed = follow(one_posture.two_link().unwrap(), &TipPath(path.to_vec())).unwrap();
    assert_eq!(followed.jumps, [Jump { index: 1, kind: JumpKind::Stop { joint: 1 } }]);
    let continuous = scene(JointLimits::Continuous, 150.0, &[], 0.01);
    assert!(plan(&continuous, 1, &dstar()).unwrap().jumps.is_empty());
}

#[test]
fn a_place_off_the_grid_is_reached_exactly() {
    let scene = with_task(&standin(), 0, |task| {
        task.start = build::tip(0.4034, 0.1051);
        task.goal = build::tip(-0.4498, -0.1503);
    });
    let plan = plan(&scene, 0, &PaperSettings::default()).unwrap();
    assert_eq!(plan.tip_path.0.first(), Some(&Point::new(0.4034, 0.1051)));
    assert_eq!(plan.tip_path.0.last(), Some(&Point::new(-0.4498, -0.1503)));
    assert!((plan.cost - plan.cost_to_go).abs() < 1e-9);
}

#[test]
fn standing_still_is_a_plan() {
    let scene = with_task(&standin(), 0, |task| task.goal = task.start.clone());
    let plan = plan(&scene, 0, &PaperSettings::default()).unwrap();
    assert_eq!((plan.cost, plan.motion.duration()), (0.0, 0.0));
}

#[test]
fn what_cannot_be_planned_is_refused_with_its_reason() {
    let scene = with_task(&standin(), 0, |task| task.goal = build::tip(0.22, 0.22));
    assert!(matches!(plan(&scene, 0, &dstar()), Err(PaperError::Goal(_))));
    let scene = with_task(&scene, 0, |task| task.start = build::tip(0.6, 0.0));
    assert!(matches!(plan(&scene, 0, &dstar()), Err(PaperError::Start(_))));
    for duration in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = plan(&scene, 1, &PaperSettings { duration, ..dstar() });
        assert!(matches!(refused, Err(PaperError::Duration { .. })));
    }
}

/// Stops after so many questions, and notes the stages.
struct Watch {
    questions_left: AtomicUsize,
    stages: Mutex<Vec<Stage>>,
}

impl Monitor for Watch {
    fn stage(&self, stage: Stage) {
        self.stages.lock().unwrap().push(stage);
    }

    fn keep_going(&self) -> bool {
        self.questions_left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1)).is_ok()
    }
}

#[test]
fn the_monitor_sees_every_stage_and_can_stop_each() {
    let scene = standin();
    let watched = |questions: usize| {
        let watch = Watch { questions_left: AtomicUsize::new(questions), stages: Mutex::new(Vec::new()) };
        let result = plan_as_in_paper(&scene, &scene.tasks()[0], &PaperSettings::default(), &watch);
        (result, watch.stages.into_inner().unwrap())
    };
    let all = [Stage::FreeSpace, Stage::CostToGo, Stage::TipPath, Stage::JointPath, Stage::Trajectory];
    let (done, stages) = watched(usize::MAX);
    assert!(done.is_ok());
    assert_eq!(stages, all);
    let seen = Cell::new(0);
    for questions in [0, 50, 101, 102, 150] {
        let (stopped, stages) = watched(questions);
        assert_eq!(stopped.unwrap_err(), PaperError::Stopped);
        assert!(stages.len() >= seen.replace(stages.len()) && all.starts_with(&stages));
    }
    assert!(seen.get() == 3, "the swarm can be stopped");
}

#[test]
fn the_union_holds_what_either_posture_holds() {
    let scene = standin();
    let two = scene.two_link().unwrap();
    let space = FreeSpace::of(two);
    let cases = space.cases(two);
    let free = (0..scene.grid().len()).filter(|&cell| space.union_is_free(cell)).count();
    assert_eq!(cases.two + cases.one, free);
    assert_eq!(free + cases.none, scene.grid().len());
}
