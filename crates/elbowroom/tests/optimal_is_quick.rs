//! Scenes in which `optimal` would need hours if it cut or searched too finely: it asks whether to keep going once for every
//! slice and every few thousand search nodes, so that the questions tell how much it did.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use elbowroom::arm::Joint;
use elbowroom::planners::OptimalPlanner;
use elbowroom::planning::{Monitor, Objective, Plan, PlanError, PlanSettings, Stage, plan};
use elbowroom::scene::{Place, Scene, TaskPosture};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// Lets a planner ask so many times.
struct Patience(AtomicUsize);

impl Monitor for Patience {
    fn keep_going(&self) -> bool {
        let left = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
        left.is_ok()
    }

    fn stage(&self, _: Stage) {}
}

fn asked(scene: &Scene, objective: Objective, patience: usize) -> Result<Plan, PlanError> {
    let settings = PlanSettings { objective, ..PlanSettings::default() };
    let patience = Patience(AtomicUsize::new(patience));
    plan(scene, &scene.tasks()[0], &OptimalPlanner, &settings, &patience)
}

/// Links of 0.1 m and 1 m, a post of half a millimetre, and a joint 2 that goes round: a thin wall across all turns of joint 1.
fn one_post(turns: f64) -> Scene {
    let first = build::joint(build::stops(-turns * PI, turns * PI));
    let arm = build::arm_of(&[0.1, 1.0], 0.0, &[first, Joint::CONTINUOUS]);
    let at = |first: f64, second: f64| Place::Configuration([first, second].into());
    let task = build::task("go", at(turns * PI, -4.3), at(-0.95 * turns * PI, 2.4), TaskPosture::Any);
    build::scene(arm, vec![build::circle(0.4, 0.8, 0.0005)]).with_tasks(vec![task]).unwrap()
}

#[test]
fn one_post_of_half_a_millimetre_costs_no_more_the_thinner_it_is() {
    for turns in [1.0, 3.0, 20.0] {
        let scene = one_post(turns);
        for objective in Objective::ALL {
            let plan = asked(&scene, objective, 20_000 * turns as usize).unwrap();
            assert!(plan.lower_bound().unwrap() > 0.0, "{turns}, {objective:?}");
        }
    }
}

#[test]
fn many_small_circles_do_not_double_the_search() {
    let arm = build::arm_of(&[1.0, 1.0], 0.0, &[build::joint(build::stops(-PI, PI)); 2]);
    let at = |q: [f64; 2]| Place::Configuration(q.into());
    let task = build::task("go", at([-2.9, 1.2]), at([2.6, 0.9]), TaskPosture::Any);
    let mut found = 0;
    for seed in 0..3 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        // Of all sizes, out where only the second link comes.
        let circles = (0..25).map(|_| {
            let (r, angle) = (1.5 + 0.4 * unit(), 2.0 * PI * unit());
            build::circle(r * angle.cos(), r * angle.sin(), 0.01 * f64::powf(10.0, -3.0 * unit()))
        });
        let scene = build::scene(arm.clone(), circles.collect()).with_tasks(vec![task.clone()]).unwrap();
        for objective in Objective::ALL {
            let answer = asked(&scene, objective, 400_000);
            assert!(!matches!(answer, Err(PlanError::Stopped)), "seed {seed}, {objective:?}");
            found += usize::from(answer.is_ok_and(|plan| plan.lower_bound().is_some()));
        }
    }
    assert!(found > 5, "{found}");
}
