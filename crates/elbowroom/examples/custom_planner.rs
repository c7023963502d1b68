//! A planner of one's own, here for any number of links: it tries one configuration after the other, drawn at random, to go round by.
//! `cargo run --release --example custom_planner -- scenes/paper-standin.yaml`.
//!
//! What it hands back is smoothed, judged by the verifier and compared with the task as with any other planner: this file
//! is all there is to write.

use std::error::Error;
use std::io::Write;

use elbowroom::arm::{Configuration, JointLimits};
use elbowroom::path::{JointPath, straight_move_is_free};
use elbowroom::planning::{
    Budget, Candidate, Exhausted, Found, Pick, PlanSettings, Planner, Problem, Round, Unwatched,
};
use elbowroom::{PlanError, parse, plan};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// From start to goal by way of one configuration.
#[derive(Debug)]
struct OneVia {
    /// How many are tried at the most.
    evaluations: usize,
}

impl Planner for OneVia {
    fn name(&self) -> &str {
        "one-via"
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let (scene, ends) = (problem.scene, &problem.endpoints);
        let mut rng = ChaCha8Rng::seed_from_u64(problem.settings.seed);
        let mut budget = Budget::new(self.evaluations, problem.monitor);
        let mut candidates = Vec::new();
        loop {
            match budget.spend(1) {
                Ok(()) => {}
                Err(Exhausted::Spent) => break,
                Err(Exhausted::Failed(error)) => return Err(error),
            }
            let drawn = |limits: JointLimits, rng: &mut ChaCha8Rng| {
                let share = rng.next_u64() as f64 / u64::MAX as f64;
                let (min, max) = match limits {
                    JointLimits::Range { min, max } => (min, max),
                    JointLimits::Continuous => (-std::f64::consts::PI, std::f64::consts::PI),
                };
                min + (max - min) * share
            };
            let via: Configuration =
                scene.arm().joints().iter().map(|joint| drawn(joint.limits, &mut rng)).collect();
            let start = &ends.starts[rng.next_u64() as usize % ends.starts.len()];
            let goal = &ends.goals[rng.next_u64() as usize % ends.goals.len()];
            let via = scene.arm().nearest_turn(start, &via);
            let goal = scene.arm().nearest_turn(&via, goal);
            if straight_move_is_free(scene, start, &via) && straight_move_is_free(scene, &via, &goal) {
                candidates.push(Candidate::along(JointPath(vec![start.clone(), via, goal])));
            }
        }
        Ok(Found::new(candidates, Pick::Best).with_effort(budget.effort()))
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: custom_planner SCENE")?;
    let scene = parse(&std::fs::read_to_string(&file)?, &file)?.scene;
    let task = scene.tasks().first().ok_or("the scene has no task")?;
    let planner = OneVia { evaluations: 5_000 };
    let plan = plan(&scene, task, &planner, &PlanSettings::default(), &Unwatched)?;
    let (tip, paths) = (plan.cost(), plan.record().paths_to_choose_from);
    writeln!(
        std::io::stdout(),
        "{}: {tip:.3} m of tip travel, proved to be safe; the best of {paths}",
        task.name
    )?;
    Ok(())
}
