//! `dstar-pso` for arms of more than two links: D* over the tip's workspace guides, a swarm finds the configurations.

use super::chain::{Guide, Halt, Leader, Ledger, Trees, price, shortened};
use super::endpoints::Endpoints;
use super::finish::along;
use super::settings::PlanSettings;
use super::{Monitor, Plan, PlanError, Stage};
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::scene::{Place, Scene, Task};
use crate::swarm::GuidedSwarmSettings;

/// How many configurations and turns are judged for each candidate path that the settings allow.
const EVALUATIONS_PER_CANDIDATE: usize = 2_000;

/// Candidate paths that are enough.
const ENOUGH: usize = 8;

/// Plans `task`: two trees of configurations grow along the guides' ways until they meet, several times over; the best of the
/// paths, made shorter by certified turns, becomes a motion.
///
/// # Errors
/// [`PlanError`]
pub(crate) fn plan(
    scene: &Scene,
    task: &Task,
    swarm: &GuidedSwarmSettings,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    let ends = Endpoints::new(scene, task, settings.seed, monitor)?;
    let budget = swarm.candidates.saturating_mul(EVALUATIONS_PER_CANDIDATE);
    let mut leader = Leader::new(scene, Ledger::new(budget, monitor), settings.seed);
    if let Some(q) = ends.already_there() {
        let effort = leader.ledger.effort();
        return along(scene, JointPath(vec![q.clone()]), settings, effort, monitor);
    }
    monitor.stage(Stage::FreeSpace);
    let tips = |ends: &[Configuration]| ends.iter().map(|q| scene.arm().tip(q)).collect::<Vec<_>>();
    let to_goals = Guide::new(scene, &tips(&ends.goals), monitor)?;
    let to_starts = to_goals.towards(&tips(&ends.starts))?;
    let asked = [&task.goal, &task.start].map(|place| match place {
        Place::Tip(tip) => Some(*tip),
        Place::Configuration(_) => None,
    });

    monitor.stage(Stage::TipPath);
    let trees = Trees::new(&ends, asked, to_goals, to_starts);
    let mut paths: Vec<(f64, JointPath)> = Vec::new();
    while paths.len() < ENOUGH.min(swarm.candidates) {
        let drawn = trees.path(&mut leader).and_then(|path| shortened(&mut leader, path, settings.objective));
        match drawn {
            Ok(path) => {
                let price = price(scene.arm(), settings.objective, &path, scene.grid().step());
                leader.ledger.found(price);
                paths.push((price, path));
            }
            Err(Halt::Spent) => break,
            Err(Halt::Failed(error)) => return Err(error),
        }
    }
    paths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let effort = leader.ledger.effort();
    let choice = paths.len();
    let mut refused = PlanError::NotFoundInBudget { evaluations: effort.evaluations };
    for (_, path) in paths {
        match along(scene, path, settings, effort.clone(), monitor) {
            Ok(plan) => return Ok(Plan { paths_to_choose_from: choice, ..plan }),
            Err(PlanError::Stopped) => return Err(PlanError::Stopped),
            Err(error) => refused = error,
        }
    }
    Err(refused)
}
