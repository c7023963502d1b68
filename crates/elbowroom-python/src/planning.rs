//! From a task to a plan.

use elbowroom::planners;
use elbowroom::planning::{self, ASSUMED_LIMITS, Objective, OptionValue, Pace, PlanSettings, Planner, SLACK};
use elbowroom::units::Told;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::{argument, text};
use crate::errors;
use crate::motion::Motion;
use crate::plan::{Plan, Question, Setting};
use crate::scene::Scene;
use crate::watch;

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

/// What there is to know of a planner, see [`planners_known`].
type Known<'py> = (String, Bound<'py, PyDict>, Option<&'static str>, usize, usize);

/// Return every planner: its name, its options with their defaults, which of them is its budget, if any, and the least and most
/// links of arms that it serves.
#[pyfunction]
pub(crate) fn planners_known(py: Python<'_>) -> PyResult<Vec<Known<'_>>> {
    let known = |planner: &dyn Planner| {
        let (least, most) = planner.links().into_inner();
        Ok((planner.name().to_owned(), options_of(py, planner)?, planner.budget(), least, most))
    };
    planners::all().iter().map(|planner| known(&**planner)).collect()
}

/// Return the name of the planner to take for the arm of ``scene`` where none is asked for.
#[pyfunction]
pub(crate) fn default_planner(scene: &Scene) -> String {
    planners::default_for(scene.scene.arm()).name().to_owned()
}

/// Return ``task``, or the name of the only task of ``scene`` if ``None``.
///
/// Raises:
///     UnknownTask: The scene has no such task, or not exactly one.
#[pyfunction]
#[pyo3(signature = (scene, task=None))]
pub(crate) fn only_task(
    py: Python<'_>,
    #[pyo3(from_py_with = argument)] scene: Py<Scene>,
    #[pyo3(from_py_with = argument)] task: Option<String>,
) -> PyResult<String> {
    let scene = scene.get();
    match (task, scene.scene.tasks()) {
        (Some(name), _) => scene.task(py, &name).map(|task| task.name.clone()),
        (None, [only]) => Ok(only.name.clone()),
        (None, tasks) => {
            let known = tasks.iter().map(|task| task.name.clone()).collect();
            Err(errors::unknown_task(py, None, known))
        }
    }
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
    options_of(py, &*by_name(py, planner, options)?)
}

fn options_of<'py>(py: Python<'py>, planner: &dyn Planner) -> PyResult<Bound<'py, PyDict>> {
    let options = PyDict::new(py);
    for (name, value) in planner.options() {
        match value {
            OptionValue::Count(count) => options.set_item(name, count)?,
            OptionValue::Word(word) => options.set_item(name, word)?,
        }
    }
    Ok(options)
}

fn by_name(py: Python<'_>, planner: &str, options: Vec<(String, OptionPart)>) -> PyResult<Box<dyn Planner>> {
    let options: Vec<(String, OptionValue)> =
        options.into_iter().map(|(name, value)| (name, value.into())).collect();
    planners::by_name(planner, &options).map_err(|error| errors::setting(py, "planner", &error.to_string()))
}

/// Return a plan for the task called ``task`` of ``scene``.
///
/// Raises:
///     UnknownTask: The scene has no such task.
///     NotFree: Start or goal is not free.
///     NoPath: It is proved that no motion does the task.
///     NotFound: The certified edges do not connect them.
///     TimedOut: The timeout came first.
///     BadSetting: A setting makes no sense, or the duration is too short.
#[pyfunction]
#[pyo3(signature = (scene, task, *, planner, objective, seed, options, duration=None, gap=None, slack=None, clearance=None, timeout=None, on_stage=None))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn plan(
    py: Python<'_>,
    #[pyo3(from_py_with = argument)] scene: Py<Scene>,
    #[pyo3(from_py_with = text)] task: &str,
    planner: &str,
    #[pyo3(from_py_with = text)] objective: &str,
    #[pyo3(from_py_with = argument)] seed: u64,
    options: Vec<(String, OptionPart)>,
    #[pyo3(from_py_with = argument)] duration: Option<f64>,
    #[pyo3(from_py_with = argument)] gap: Option<f64>,
    #[pyo3(from_py_with = argument)] slack: Option<f64>,
    #[pyo3(from_py_with = argument)] clearance: Option<f64>,
    #[pyo3(from_py_with = argument)] timeout: Option<f64>,
    on_stage: Option<&Bound<'_, PyAny>>,
) -> PyResult<Plan> {
    let core = scene.get();
    let asked = core.task(py, task)?;
    let objective = objective_called(py, objective)?;
    let planner = by_name(py, planner, options)?;
    let pace = duration.map_or(Pace::Fastest, Pace::Duration);
    let settings = PlanSettings { objective, pace, seed, gap, slack: slack.unwrap_or(SLACK), clearance };
    let work = |watch: &watch::Watch| planning::plan(&core.scene, asked, &*planner, &settings, watch);
    let (result, timings) = watch::run(py, timeout, on_stage, work)?;
    let plan = result.map_err(|error| errors::plan(py, core.units(), task, timeout, &error))?;
    let question = Question {
        scene: scene.clone_ref(py),
        task: task.to_owned(),
        planner: planner.name().to_owned(),
        settings: told(&*planner, &settings),
        seed,
        objective,
    };
    Plan::new(py, question, plan, watch::told(timings))
}

/// Return every objective: its name, what it is a number of, and its unit.
#[pyfunction]
pub(crate) fn objectives() -> Vec<(&'static str, &'static str, &'static str)> {
    Objective::ALL.map(|objective| (objective.name(), objective.quantity(), objective.unit())).to_vec()
}

/// The objective called `name`.
pub(crate) fn objective_called(py: Python<'_>, name: &str) -> PyResult<Objective> {
    Objective::ALL.into_iter().find(|known| known.name() == name).ok_or_else(|| {
        let known = Objective::ALL.map(Objective::name).join(", ");
        errors::setting(py, "objective", &format!("no objective is called '{name}'; known: {known}"))
    })
}

/// The settings as a plan tells them.
pub(crate) fn told(planner: &dyn Planner, settings: &PlanSettings) -> Vec<(String, Setting)> {
    let duration = match settings.pace {
        Pace::Fastest => Setting::Word("fastest".to_owned()),
        Pace::Duration(seconds) => Setting::Number(seconds),
    };
    let mut told = vec![("mode", Setting::Word("verified".to_owned())), ("duration", duration)];
    if settings.objective != Objective::Time {
        told.push(("slack", Setting::Number(settings.slack)));
    }
    told.extend(settings.clearance.map(|clearance| ("clearance", Setting::Number(clearance))));
    told.extend(settings.gap.map(|gap| ("gap", Setting::Number(gap))));
    told.extend(planner.options().into_iter().map(|(name, value)| (name, value.into())));
    told.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

impl From<OptionValue> for Setting {
    fn from(value: OptionValue) -> Self {
        match value {
            OptionValue::Count(count) => Self::Count(count),
            OptionValue::Word(word) => Self::Word(word),
        }
    }
}

/// Return how ``motion``, whose posture changes at ``posture_changes`` (s), fails to do the task called ``task``; ``None`` if it does.
///
/// Raises:
///     UnknownTask: The scene has no such task.
#[pyfunction]
pub(crate) fn mismatch(
    py: Python<'_>,
    scene: Py<Scene>,
    task: &str,
    motion: &Motion,
    posture_changes: Vec<f64>,
) -> PyResult<Option<String>> {
    let core = scene.get();
    let found = planning::mismatch(&core.scene, core.task(py, task)?, &motion.motion, &posture_changes);
    Ok(found.map(|mismatch| mismatch.told(core.units())))
}

/// By which share of ``lower_bound`` ``cost`` is above it; ``None`` where that says nothing.
#[pyfunction]
pub(crate) fn gap(cost: f64, lower_bound: f64) -> Option<f64> {
    planning::gap(cost, lower_bound)
}

/// What planners take for motion limits that a scene does not state, by rate.
pub(crate) fn assumed_limits(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let limits = PyDict::new(py);
    limits.set_item("velocity", ASSUMED_LIMITS.velocity)?;
    limits.set_item("acceleration", ASSUMED_LIMITS.acceleration)?;
    limits.set_item("jerk", ASSUMED_LIMITS.jerk)?;
    Ok(limits)
}
