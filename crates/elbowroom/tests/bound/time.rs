//! Bounds on duration against the best motions known, over random worlds and the example scenes.

use std::sync::Mutex;

use elbowroom::arm::{Joint, JointLimits, MotionLimits};
use elbowroom::planners::{DstarPsoPlanner, OptimalPlanner};
use elbowroom::planning::{
    ASSUMED_LIMITS, Endpoints, Found, Objective, Pick, PlanError, PlanSettings, Planner, Problem, Round,
    Unwatched, plan,
};
use elbowroom::scene::{Place, Scene, Task, TaskPosture};
use elbowroom::trajectory::{SpeedLimits, Stop, least_time};
use rayon::prelude::*;

use super::{build, wall_in, worlds};

/// What is known of the fastest motion of one task (s).
struct Known {
    /// No motion is faster.
    bound: f64,
    /// Proved by start and goal alone.
    without_obstacles: f64,
    /// The best motion of two planners takes so long.
    best: f64,
}

impl Known {
    fn gap(&self) -> f64 {
        self.best / self.bound - 1.0
    }

    /// Whether start and goal alone tell as much.
    fn is_unhindered(&self) -> bool {
        self.bound <= self.without_obstacles * (1.0 + 1e-6)
    }
}

/// The least of the double-S times of the slower joint, over all starts and goals (s).
fn without_obstacles(scene: &Scene) -> f64 {
    let ends = Endpoints::new(scene, &scene.tasks()[0], 0, &Unwatched).unwrap();
    let of_joint = |j: usize, from: f64, to: f64| {
        let (joint, assumed) = (&scene.arm().joints()[j], ASSUMED_LIMITS);
        let limits = SpeedLimits {
            velocity: joint.motion.velocity.unwrap_or(assumed.velocity),
            acceleration: joint.motion.acceleration.unwrap_or(assumed.acceleration),
            jerk: joint.motion.jerk.unwrap_or(assumed.jerk),
        };
        let turns = if joint.limits == JointLimits::Continuous { -40..=40 } else { 0..=0 };
        let ways = turns.map(|turn| (to - from + std::f64::consts::TAU * f64::from(turn)).abs());
        least_time(ways.fold(f64::INFINITY, f64::min), &limits, [Stop::Rest; 2])
    };
    let mut least = f64::INFINITY;
    for start in &ends.starts {
        for goal in &ends.goals {
            let joints = (0..2).map(|j| of_joint(j, start[j], goal[j]));
            least = least.min(joints.fold(0.0, f64::max));
        }
    }
    least
}

/// What is known of the task of world `seed`; `None` where no motion was found.
fn known(seed: u64) -> Option<Known> {
    let mut scene = worlds::world(seed)?;
    if seed.is_multiple_of(2) {
        scene = wall_in(scene, seed);
    }
    let mut known = Known { bound: 0.0, without_obstacles: 0.0, best: f64::INFINITY };
    let planners: [&dyn Planner; 2] = [&OptimalPlanner, &DstarPsoPlanner::default()];
    for planner in planners {
        let settings = PlanSettings { objective: Objective::Time, ..PlanSettings::default() };
        match plan(&scene, &scene.tasks()[0], planner, &settings, &Unwatched) {
            Ok(plan) => {
                known.best = known.best.min(plan.cost());
                known.bound = known.bound.max(plan.lower_bound().unwrap());
            }
            Err(error @ PlanError::BelowBound { .. }) => panic!("seed {seed}: {error}"),
            Err(_) => {}
        }
    }
    if !(known.best.is_finite() && known.best > 0.0) {
        return None;
    }
    assert!(known.bound <= known.best, "seed {seed}: {} above {}", known.bound, known.best);
    known.without_obstacles = without_obstacles(&scene);
    assert!(
        known.bound >= known.without_obstacles * (1.0 - 1e-6) - 1e-4,
        "seed {seed}: start and goal alone tell more, {} and {}",
        known.bound,
        known.without_obstacles
    );
    Some(known)
}

/// Gaps of tasks without and with something in the way, in order.
pub(super) fn gaps(seeds: std::ops::Range<u64>) -> [Vec<f64>; 2] {
    let known: Vec<Known> = seeds.into_par_iter().filter_map(known).collect();
    [true, false].map(|unhindered| {
        let of = known.iter().filter(|known| known.is_unhindered() == unhindered);
        let mut gaps: Vec<f64> = of.map(Known::gap).collect();
        gaps.sort_by(f64::total_cmp);
        gaps
    })
}

/// The median and its kin, in percent.
pub(super) fn quantiles(gaps: &[f64]) -> String {
    let at = |share: f64| 100.0 * gaps[((gaps.len() - 1) as f64 * share) as usize];
    let shares = [0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1.0];
    let told: Vec<String> = shares.iter().map(|&share| format!("{:.2}", at(share))).collect();
    format!("{} tasks, least, 10, 25, 50, 75, 90, 99 % and greatest: {} %", gaps.len(), told.join(", "))
}

#[test]
fn no_bound_is_above_the_best_motion_known_and_in_the_open_they_are_near() {
    let [unhindered, others] = gaps(0..240);
    assert!(unhindered.len() > 10 && others.len() > 10, "{} and {}", unhindered.len(), others.len());
    assert!(unhindered[unhindered.len() / 2] < 0.03, "{}", quantiles(&unhindered));
    assert!(others[others.len() / 2] < 0.25, "{}", quantiles(&others));
}

/// Finds nothing, and remembers the bound.
#[derive(Debug, Default)]
struct Asks(Mutex<Option<f64>>);

impl Planner for Asks {
    fn name(&self) -> &str {
        "asks"
    }

    fn search(&self, _: &Problem<'_>, round: Round) -> Result<Found, PlanError> {
        *self.0.lock().unwrap() = round.lower_bound;
        Ok(Found::new(vec![], Pick::First))
    }
}

fn bound(scene: &Scene, task: &Task, objective: Objective) -> Option<f64> {
    let asks = Asks::default();
    let settings = PlanSettings { objective, ..PlanSettings::default() };
    assert!(matches!(
        plan(scene, task, &asks, &settings, &Unwatched),
        Err(PlanError::NotFoundInBudget { .. })
    ));
    asks.0.into_inner().unwrap()
}

#[test]
fn bounds_of_the_example_tasks_are_near_the_best_motions_known() {
    // By direct transcription from many starts (s).
    let known = [
        ("abb-irb-910sc-065", [1.629, 1.852]),
        ("fanuc-sr-3ia", [2.033, 2.276]),
        ("paper-standin", [2.536, 2.775]),
        ("narrow", [3.279, 3.014]),
    ];
    let mut gaps = Vec::new();
    for (name, best) in known {
        let scene = build::example(name);
        for (task, best) in scene.tasks().iter().zip(best) {
            let bound = bound(&scene, task, Objective::Time).unwrap();
            assert!(bound <= best + 1e-3, "{name} {}: {bound} above {best}", task.name);
            gaps.push(best / bound - 1.0);
        }
    }
    gaps.sort_by(f64::total_cmp);
    assert!(gaps[3] < 0.013 && gaps[7] < 0.065, "{gaps:?}");
}

#[test]
fn arms_of_more_links_have_the_bounds_that_start_and_goal_tell() {
    let limits = |v: f64| SpeedLimits { velocity: v, acceleration: 3.0, jerk: 20.0 };
    let joint = |v: f64| Joint {
        limits: JointLimits::Continuous,
        motion: MotionLimits { velocity: Some(v), acceleration: Some(3.0), jerk: Some(20.0) },
    };
    let arm = build::arm_of(&[0.3, 0.2, 0.2], 0.0, &[joint(1.0), joint(2.0), joint(3.0)]);
    let scene = build::scene(arm, vec![]);
    let (from, to) = ([0.1, 0.2, 0.3], [2.1, -0.8, 0.3 + 6.0]);
    let at = |q: [f64; 3]| Place::Configuration(q.into());
    let task = build::task("turn", at(from), at(to), TaskPosture::Any);
    // The last joint goes the other way round.
    let ways: [f64; 3] = [2.0, 1.0, std::f64::consts::TAU - 6.0];
    let times =
        [1.0, 2.0, 3.0].iter().zip(ways).map(|(v, way)| least_time(way, &limits(*v), [Stop::Rest; 2]));
    let length = ways.iter().map(|way| way * way).sum::<f64>().sqrt();
    let tips = [from, to].map(|q| scene.arm().tip(&q));
    let expected = [tips[0].distance(tips[1]), length, times.fold(0.0, f64::max)];
    for (objective, expected) in Objective::ALL.into_iter().zip(expected) {
        let bound = bound(&scene, &task, objective).unwrap();
        assert!(bound <= expected && bound > expected - 2e-5, "{objective:?}: {bound}, {expected}");
    }
    let by_tip = build::task("reach", at(from), build::tip(tips[1].x, tips[1].y), TaskPosture::Any);
    let bounds = Objective::ALL.map(|objective| bound(&scene, &by_tip, objective));
    assert!(bounds[0].is_some() && bounds[1].is_none() && bounds[2].is_none(), "{bounds:?}");
}
