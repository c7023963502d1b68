use elbowroom::planners;
use elbowroom::planning::{Objective, PlanSettings, Unwatched, plan};
use elbowroom::scene::parse;
use elbowroom::verify::{VerifySettings, verify};
use serde_json::json;

use super::{Outcome, runs, scenes};

/// A whole plan: map to verified trajectory, and the verdict on it once more. `points` along each side of the grid, or `-`
/// for the grid of the file, with which arms of more links than two are served.
pub(crate) fn measure([file, task, points, planner, objective]: [&str; 5], runs: usize) -> Outcome {
    let scene = match points {
        "-" => parse(&std::fs::read_to_string(file)?, file)?.scene,
        points => scenes::load(file, points.parse()?)?,
    };
    let task = scene.task(task).ok_or("no such task")?;
    let planner = planners::by_name(planner, &[])?;
    let objective = [Objective::Tip, Objective::Joint, Objective::Time]
        .into_iter()
        .find(|known| known.name() == objective)
        .ok_or("no such objective")?;
    let settings = PlanSettings { objective, ..PlanSettings::default() };
    let (times, found) = runs::times(runs, || plan(&scene, task, &*planner, &settings, &Unwatched));
    let found = found?;
    let motion = found.trajectory().motion();
    let (verdicts, verdict) = runs::times(runs, || verify(&scene, motion, &VerifySettings::default()));
    Ok(json!({
        "times_ms": times,
        "verify_ms": verdicts,
        "cost": found.cost(),
        "path_cost": found.record().path_cost,
        "duration": motion.duration(),
        "safe": verdict.is_safe(),
    }))
}
