use elbowroom::planners::{self, Objective, OptionValue, Pace, PlanSettings, Planner};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;
use crate::motion::Motion;
use crate::paper::{configurations, postures, tips};
use crate::scene::Scene;
use crate::verdict;
use crate::watch::{self, Timings};

/// What a planner found: a motion that is proved to be safe. There is no other way to make one.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct Plan {
    plan: planners::Plan,
    timings: Timings,
}

#[pymethods]
impl Plan {
    /// What the motion costs in terms of the objective: metres, radians or seconds.
    #[getter]
    fn cost(&self) -> f64 {
        self.plan.cost
    }

    /// No motion costs less than this; ``None`` where nothing could be proved.
    #[getter]
    fn lower_bound(&self) -> Option<f64> {
        self.plan.lower_bound
    }

    /// Tip travel along the path that the motion was made from (m).
    #[getter]
    fn path_cost(&self) -> f64 {
        self.plan.path_cost
    }

    /// How many different paths the choice was among.
    #[getter]
    fn paths_to_choose_from(&self) -> usize {
        self.plan.paths_to_choose_from
    }

    /// Where the tip is at each configuration, shape ``(n, 2)`` (m).
    #[getter]
    fn tip_path<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        tips(py, &self.plan.tip_path)
    }

    /// Configurations from start to goal, shape ``(n, joints)`` (rad); the straight turns between them are certified free.
    #[getter]
    fn configurations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        configurations(py, &self.plan.joint_path)
    }

    /// The posture at each: ``elbow-up``, ``elbow-down``, or ``None`` with the links in line or more links than two.
    #[getter]
    fn postures(&self) -> Vec<Option<&'static str>> {
        postures(&self.plan.joint_path)
    }

    /// Places of the path that the motion is led through, by their index.
    #[getter]
    fn vias(&self) -> Vec<usize> {
        self.plan.vias.clone()
    }

    /// How many via points, ends left out, the arm stops at.
    #[getter]
    fn stops(&self) -> usize {
        self.plan.stops
    }

    /// The polynomials, proved to be safe.
    #[getter]
    fn motion(&self) -> Motion {
        Motion(self.plan.trajectory.motion().clone())
    }

    /// Motion limits the scene does not state, and what was taken in their place: joint, rate, value.
    #[getter]
    fn assumed_limits(&self) -> Vec<(usize, &'static str, f64)> {
        self.plan.assumed_limits.iter().map(|limit| (limit.joint, limit.rate, limit.value)).collect()
    }

    /// How many candidates were judged, and the best cost after how many each time it fell; ``None`` if not counted.
    #[getter]
    fn effort(&self) -> Option<(usize, Vec<(usize, f64)>)> {
        self.plan.effort.as_ref().map(|effort| (effort.evaluations, effort.convergence.clone()))
    }

    /// Seconds spent in each stage, in order.
    #[getter]
    fn timings(&self) -> Timings {
        self.timings.clone()
    }

    /// Return the verifier's verdict; ``scene`` names the obstacles.
    fn verdict<'py>(&self, py: Python<'py>, scene: &Scene) -> PyResult<Bound<'py, PyDict>> {
        verdict::as_dict(py, &scene.scene, self.plan.trajectory.verdict())
    }
}

/// The value of a planner's option as Python has it.
#[derive(FromPyObject)]
pub(crate) enum OptionPart {
    Count(usize),
    Word(String),
}

impl From<OptionPart> for OptionValue {
    fn from(part: OptionPart) -> Self {
        match part {
            OptionPart::Count(count) => Self::Count(count),
            OptionPart::Word(word) => Self::Word(word),
        }
    }
}

/// A planner's name, its options with their defaults, and which of them is its budget, if any.
type Known<'py> = (&'static str, Bound<'py, PyDict>, Option<&'static str>);

/// Return every planner: its name, its options with their defaults, and which of them is its budget, if any.
#[pyfunction]
pub(crate) fn planners_known(py: Python<'_>) -> PyResult<Vec<Known<'_>>> {
    let known = |planner: &Planner| Ok((planner.name(), options_of(py, planner)?, planner.budget()));
    Planner::all().iter().map(known).collect()
}

/// Return all options of the planner called ``planner``, with ``options`` in place of its defaults.
///
/// Raises:
///     BadSetting: There is no such planner, option or value.
#[pyfunction]
pub(crate) fn planner_options<'py>(
    py: Python<'py>,
    planner: &str,
    options: Vec<(String, OptionPart)>,
) -> PyResult<Bound<'py, PyDict>> {
    options_of(py, &by_name(py, planner, options)?)
}

fn options_of<'py>(py: Python<'py>, planner: &Planner) -> PyResult<Bound<'py, PyDict>> {
    let options = PyDict::new(py);
    for (name, value) in planner.options() {
        match value {
            OptionValue::Count(count) => options.set_item(name, count)?,
            OptionValue::Word(word) => options.set_item(name, word)?,
        }
    }
    Ok(options)
}

fn by_name(py: Python<'_>, planner: &str, options: Vec<(String, OptionPart)>) -> PyResult<Planner> {
    let options: Vec<(String, OptionValue)> =
        options.into_iter().map(|(name, value)| (name, value.into())).collect();
    Planner::by_name(planner, &options).map_err(|error| errors::setting(py, "planner", &error.to_string()))
}

/// Return a plan for the task called ``task``.
///
/// Raises:
///     UnknownTask: The scene has no such task.
///     NotFree: Start or goal is not free.
///     NoPath: It is proved that no motion does the task.
///     NotFound: The certified edges do not connect them.
///     TimedOut: The timeout came first.
///     BadSetting: A setting makes no sense, or the duration is too short.
#[pyfunction]
#[pyo3(signature = (scene, task, *, planner, objective, seed, options, duration=None, gap=None, timeout=None, on_stage=None))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn plan(
    py: Python<'_>,
    scene: &Scene,
    task: &str,
    planner: &str,
    objective: &str,
    seed: u64,
    options: Vec<(String, OptionPart)>,
    duration: Option<f64>,
    gap: Option<f64>,
    timeout: Option<f64>,
    on_stage: Option<&Bound<'_, PyAny>>,
) -> PyResult<Plan> {
    let asked = scene.task(py, task)?;
    let objective = [Objective::Tip, Objective::Joint, Objective::Time]
        .into_iter()
        .find(|known| known.name() == objective)
        .ok_or_else(|| {
            errors::setting(
                py,
                "objective",
                &format!("no objective is called '{objective}'; tip, joint or time"),
            )
        })?;
    let planner = by_name(py, planner, options)?;
    let pace = duration.map_or(Pace::Fastest, Pace::Duration);
    let settings = PlanSettings { objective, pace, seed, gap };
    let work = |watch: &watch::Watch| planners::plan(&scene.scene, asked, &planner, &settings, watch);
    let (result, timings) = watch::run(py, timeout, on_stage, work)?;
    let plan = result.map_err(|error| errors::plan(py, task, timeout, &error))?;
    Ok(Plan { plan, timings })
}
