use elbowroom::planners::{Objective, PlanSettings, Planner, Unwatched, plan};
use elbowroom::swarm::GuidedSwarmSettings;
use serde_json::json;

use super::{Outcome, runs, scenes};

/// A whole plan: map to verified trajectory.
pub(crate) fn measure([file, task, planner, objective]: [&str; 4], points: usize, runs: usize) -> Outcome {
    let scene = scenes::load(file, points)?;
    let task = scene.task(task).ok_or("no such task")?;
    let planner = match planner {
        "dstar" => Planner::Dstar,
        "dstar-pso" => Planner::DstarPso(GuidedSwarmSettings::default()),
        "optimal" => Planner::Optimal,
        _ => return Err("no such planner".into()),
    };
    let objective = [Objective::Tip, Objective::Joint, Objective::Time]
        .into_iter()
        .find(|known| known.name() == objective)
        .ok_or("no such objective")?;
    let settings = PlanSettings { objective, ..PlanSettings::default() };
    let (times, found) = runs::times(runs, || plan(&scene, task, &planner, &settings, &Unwatched));
    let found = found?;
    Ok(json!({
        "times_ms": times,
        "cost": found.cost,
        "path_cost": found.path_cost,
        "duration": found.trajectory.motion().duration(),
        "safe": found.trajectory.verdict().is_safe(),
    }))
}
