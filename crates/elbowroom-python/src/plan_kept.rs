//! Plans that are pickled. Nothing that a plan claims of safety is taken from there: the verifier judges its motion anew.

use elbowroom::geometry::Point;
use elbowroom::path::{JointPath, TipPath};
use elbowroom::planning::{self, AssumedLimit, Effort, Objective, PlanRecord, RecordError};
use elbowroom::verify::Rate;
use pyo3::prelude::*;

use crate::errors;
use crate::motion::Motion;
use crate::plan::{Plan, Question, Setting};
use crate::scene::Scene;
use crate::verdict::{Verdict, refuted};
use crate::watch;

/// What is kept of a plan besides its scene and its motion: a dictionary in Python.
#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Kept {
    task: String,
    planner: String,
    settings: Vec<(String, Setting)>,
    seed: u64,
    objective: String,
    cost: f64,
    lower_bound: Option<f64>,
    path_cost: f64,
    paths_to_choose_from: usize,
    tip_path: Vec<(f64, f64)>,
    configurations: Vec<Vec<f64>>,
    vias: Vec<usize>,
    stops: usize,
    assumed_limits: Vec<(usize, String, f64)>,
    effort: Option<(usize, Vec<(usize, f64)>)>,
    timings: Vec<(String, f64)>,
    clearance: f64,
}

impl Kept {
    pub(crate) fn of(shown: &Plan) -> Self {
        let (asked, plan) = (&shown.asked, shown.plan.record());
        let limit = |limit: &AssumedLimit| (limit.joint, limit.rate.to_owned(), limit.value);
        Self {
            task: asked.task.clone(),
            planner: asked.planner.clone(),
            settings: asked.settings.clone(),
            seed: asked.seed,
            objective: asked.objective.name().to_owned(),
            cost: plan.cost,
            lower_bound: plan.lower_bound,
            path_cost: plan.path_cost,
            paths_to_choose_from: plan.paths_to_choose_from,
            tip_path: plan.tip_path.0.iter().map(|p| (p.x, p.y)).collect(),
            configurations: plan.joint_path.0.iter().map(|q| q.to_vec()).collect(),
            vias: plan.vias.clone(),
            stops: plan.stops,
            assumed_limits: plan.assumed_limits.iter().map(limit).collect(),
            effort: plan.effort.as_ref().map(|effort| (effort.evaluations, effort.convergence.clone())),
            timings: shown.timings.clone(),
            clearance: plan.clearance,
        }
    }
}

/// Return the plan of ``motion`` in ``scene`` that was ``kept``, verified again.
///
/// Raises:
///     Refuted: The motion is not safe, or its cost is not what was kept.
///     BadSetting: What was kept is no plan.
#[pyfunction]
pub(crate) fn plan_again(py: Python<'_>, scene: Py<Scene>, motion: &Motion, kept: Kept) -> PyResult<Plan> {
    let core = scene.get();
    let task = core.task(py, &kept.task)?;
    let Some(objective) = Objective::ALL.into_iter().find(|known| known.name() == kept.objective) else {
        return Err(errors::setting(py, "objective", "the plan was kept with no objective that there is"));
    };
    let assumed_limits = kept
        .assumed_limits
        .into_iter()
        .map(|(joint, name, value)| rate(&name).map(|rate| AssumedLimit { joint, rate, value }))
        .collect::<Option<_>>()
        .ok_or_else(|| errors::setting(py, "assumed_limits", "the plan was kept with a limit on no rate"))?;
    let record = PlanRecord {
        cost: kept.cost,
        lower_bound: kept.lower_bound,
        path_cost: kept.path_cost,
        paths_to_choose_from: kept.paths_to_choose_from,
        tip_path: TipPath(kept.tip_path.into_iter().map(|(x, y)| Point::new(x, y)).collect()),
        joint_path: JointPath(kept.configurations.into_iter().map(Into::into).collect()),
        vias: kept.vias,
        stops: kept.stops,
        assumed_limits,
        effort: kept.effort.map(|(evaluations, convergence)| Effort { evaluations, convergence }),
        clearance: kept.clearance,
    };
    let motion = (*motion.motion).clone();
    let (again, _) =
        watch::run(py, None, None, |_| planning::Plan::again(&core.scene, task, objective, motion, record))?;
    let plan = again.map_err(|error| match &error {
        RecordError::Refused(verdict) => {
            refuted(py, "the plan was kept as safe", Verdict::new(core, verdict, None))
        }
        RecordError::Path { .. } => errors::setting(py, "configurations", &error.to_string()),
        _ => errors::refuted(py, &error.to_string(), None),
    })?;
    let asked = Question {
        scene,
        task: kept.task,
        planner: kept.planner,
        settings: kept.settings,
        seed: kept.seed,
        objective,
    };
    Plan::new(py, asked, plan, kept.timings)
}

fn rate(name: &str) -> Option<&'static str> {
    [Rate::Velocity, Rate::Acceleration, Rate::Jerk].map(Rate::name).into_iter().find(|known| *known == name)
}
