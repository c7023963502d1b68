//! Plans that are pickled. Nothing that a plan claims of safety is taken from there: the verifier judges its motion anew.

use elbowroom::geometry::Point;
use elbowroom::path::{JointPath, TipPath};
use elbowroom::planners::{self, AssumedLimit, Effort, Objective};
use elbowroom::verify::{Rate, Trajectory, VerifySettings};
use pyo3::prelude::*;

use crate::errors;
use crate::motion::Motion;
use crate::plan::{Plan, Question, Setting};
use crate::verdict::{Verdict, core_of, refuted};
use crate::watch;

/// By which share a cost that is measured again may differ: rounding on another machine.
const ROUNDING: f64 = 1e-9;

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
}

impl Kept {
    pub(crate) fn of(shown: &Plan) -> Self {
        let (asked, plan) = (&shown.asked, &shown.plan);
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
        }
    }
}

/// Return the plan of ``motion`` in ``scene`` that was ``kept``, judged again.
///
/// Raises:
///     Refuted: The motion is not safe, or its cost is not what was kept.
///     BadSetting: What was kept is no plan.
#[pyfunction]
pub(crate) fn plan_again(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    motion: &Motion,
    kept: Kept,
) -> PyResult<Plan> {
    let core = core_of(scene)?;
    let core = core.get();
    core.task(py, &kept.task)?;
    let Some(objective) = objective(&kept.objective) else {
        return Err(errors::setting(py, "objective", "the plan was kept with no objective that there is"));
    };
    let joints = motion.motion.joints();
    if kept.configurations.is_empty() || kept.configurations.iter().any(|q| q.len() != joints) {
        return Err(errors::setting(py, "configurations", "the plan was kept with no path of its joints"));
    }
    let (judged, _) = watch::run(py, None, None, |_| {
        Trajectory::certify(&core.scene, (*motion.motion).clone(), &VerifySettings::default())
    })?;
    let trajectory =
        judged.map_err(|found| refuted(py, "the plan was kept as safe", Verdict::new(core, &found, None)))?;
    let measured = match objective {
        Objective::Tip => motion.motion.tip_length(core.scene.arm()),
        Objective::Joint => motion.motion.joint_length(),
        Objective::Time => motion.motion.duration(),
    };
    let off = (kept.cost - measured).abs();
    if off.is_nan() || off > ROUNDING * measured {
        let message = format!("the plan was kept with a cost of {}; its motion costs {measured}", kept.cost);
        return Err(errors::refuted(py, &message, None));
    }
    if kept.lower_bound.is_some_and(|bound| bound.is_nan() || bound > measured * (1.0 + ROUNDING)) {
        let message = format!("the plan was kept with a lower bound above what its motion costs, {measured}");
        return Err(errors::refuted(py, &message, None));
    }
    let assumed_limits = kept
        .assumed_limits
        .into_iter()
        .map(|(joint, name, value)| rate(&name).map(|rate| AssumedLimit { joint, rate, value }))
        .collect::<Option<_>>()
        .ok_or_else(|| errors::setting(py, "assumed_limits", "the plan was kept with a limit on no rate"))?;
    let plan = planners::Plan {
        cost: kept.cost,
        lower_bound: kept.lower_bound,
        path_cost: kept.path_cost,
        paths_to_choose_from: kept.paths_to_choose_from,
        tip_path: TipPath(kept.tip_path.into_iter().map(|(x, y)| Point::new(x, y)).collect()),
        joint_path: JointPath(kept.configurations.into_iter().map(Into::into).collect()),
        vias: kept.vias,
        stops: kept.stops,
        trajectory,
        assumed_limits,
        effort: kept.effort.map(|(evaluations, convergence)| Effort { evaluations, convergence }),
    };
    let asked = Question {
        scene: scene.clone().unbind(),
        task: kept.task,
        planner: kept.planner,
        settings: kept.settings,
        seed: kept.seed,
        objective,
    };
    Plan::new(py, asked, plan, kept.timings)
}

/// The objective called `name`.
pub(crate) fn objective(name: &str) -> Option<Objective> {
    [Objective::Tip, Objective::Joint, Objective::Time].into_iter().find(|known| known.name() == name)
}

fn rate(name: &str) -> Option<&'static str> {
    [Rate::Velocity, Rate::Acceleration, Rate::Jerk].map(Rate::name).into_iter().find(|known| *known == name)
}
