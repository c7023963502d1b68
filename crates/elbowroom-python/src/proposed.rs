//! Plans by planners that are written in Python: what they propose goes the way of all candidates.

use elbowroom::arm::Configuration;
use elbowroom::path::JointPath;
use elbowroom::planning::{
    self, Candidate, Effort, Found, Pace, Pick, PlanError, PlanSettings, Planner, Problem, Round, SLACK,
};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::argument::argument;
use crate::errors;
use crate::motion::Motion;
use crate::plan::{Plan, Question, Setting};
use crate::planning::{objective_called, told};
use crate::scene::Scene;
use crate::watch;

/// A planner that has planned already.
#[derive(Debug)]
struct Proposer {
    name: String,
    candidate: Candidate,
    effort: Option<Effort>,
}

impl Planner for Proposer {
    fn name(&self) -> &str {
        &self.name
    }

    fn search(&self, _: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let found = Found::new(vec![self.candidate.clone()], Pick::First);
        Ok(Found { effort: self.effort.clone(), ..found })
    }
}

/// Return the plan that ``motion``, or else the path through ``configurations``, makes for the task called ``task`` of ``scene``.
///
/// Raises:
///     UnknownTask: The scene has no such task.
///     NotFree: Start or goal is not free.
///     NoPath: It is proved that no motion does the task.
///     PlannerFault: What is proposed is not safe, or does not do the task.
///     TimedOut: The timeout came first.
///     BadSetting: A setting makes no sense, or the duration is too short.
#[pyfunction]
#[pyo3(signature = (scene, task, *, planner, settings, objective, seed, motion=None, configurations=None, evaluations=None,
    convergence=None, timings, duration=None, slack=None, clearance=None, timeout=None, on_stage=None))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn plan_proposed(
    py: Python<'_>,
    scene: Py<Scene>,
    task: &str,
    planner: String,
    settings: Vec<(String, Setting)>,
    objective: &str,
    seed: u64,
    motion: Option<&Motion>,
    configurations: Option<PyReadonlyArray2<'_, f64>>,
    evaluations: Option<usize>,
    convergence: Option<Vec<(usize, f64)>>,
    timings: Vec<(String, f64)>,
    duration: Option<f64>,
    #[pyo3(from_py_with = argument)] slack: Option<f64>,
    #[pyo3(from_py_with = argument)] clearance: Option<f64>,
    timeout: Option<f64>,
    on_stage: Option<&Bound<'_, PyAny>>,
) -> PyResult<Plan> {
    let core = scene.get();
    let asked = core.task(py, task)?;
    let objective = objective_called(py, objective)?;
    let candidate = match (motion, configurations) {
        (Some(motion), None) => Candidate::motion((*motion.motion).clone()),
        (None, Some(rows)) => {
            let row =
                |row: numpy::ndarray::ArrayView1<'_, f64>| row.iter().copied().collect::<Configuration>();
            let mut places: Vec<Configuration> = rows.as_array().outer_iter().map(row).collect();
            places.dedup();
            Candidate::along(JointPath(places))
        }
        _ => return Err(errors::internal(py, "a proposal is a motion or a path")),
    };
    let effort =
        evaluations.map(|evaluations| Effort { evaluations, convergence: convergence.unwrap_or_default() });
    let proposer = Proposer { name: planner, candidate, effort };
    let pace = duration.map_or(Pace::Fastest, Pace::Duration);
    let plan_settings =
        PlanSettings { objective, pace, seed, gap: None, slack: slack.unwrap_or(SLACK), clearance };
    let work = |watch: &watch::Watch| planning::plan(&core.scene, asked, &proposer, &plan_settings, watch);
    let (result, spent) = watch::run(py, timeout, on_stage, work)?;
    let plan = result.map_err(|error| errors::proposed(py, core, (&proposer.name, task), timeout, &error))?;
    let mut all = told(&proposer, &plan_settings);
    all.extend(settings);
    let question = Question {
        scene: scene.clone_ref(py),
        task: task.to_owned(),
        planner: proposer.name,
        settings: all,
        seed,
        objective,
    };
    Plan::new(py, question, plan, timings.into_iter().chain(watch::told(spent)).collect())
}
