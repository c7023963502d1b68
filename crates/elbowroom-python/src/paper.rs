use elbowroom::arm::{Configuration, Posture};
use elbowroom::path::{JointPath, JumpKind, TipPath};
use elbowroom::planners::{self, Method, PaperSettings};
use elbowroom::planning::Objective;
use elbowroom::swarm::GuidedSwarmSettings;
use elbowroom::units::short;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::{argument, text};
use crate::errors;
use crate::motion::Motion;
use crate::plan::{Question, Setting, every, in_order, within};
use crate::scene::Scene;
use crate::verdict::Verdict;
use crate::watch;

/// What the paper's system finds: a path over the union of both postures, and polynomials that nobody verified.
///
/// It is here to be compared with, not to be run: ``verdict`` is ``None`` for good.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct PaperPlan {
    asked: Question,
    plan: planners::PaperPlan,
    timings: Vec<(String, f64)>,
    motion: Py<Motion>,
}

#[pymethods]
impl PaperPlan {
    /// What it was planned in.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.asked.scene.clone_ref(py)
    }

    /// The task's name.
    #[getter]
    fn task(&self) -> &str {
        &self.asked.task
    }

    /// ``dstar-pso`` or ``dstar``.
    #[getter]
    fn planner(&self) -> &str {
        &self.asked.planner
    }

    /// What was asked of it.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.asked.settings(py)
    }

    /// Of the swarm and of the choice of via points.
    #[getter]
    fn seed(&self) -> u64 {
        self.asked.seed
    }

    /// What it goes by: ``tip``.
    #[getter]
    fn objective(&self) -> &'static str {
        self.asked.objective.name()
    }

    /// Of ``cost``: ``m``.
    #[getter]
    fn cost_unit(&self) -> &'static str {
        self.asked.objective.unit()
    }

    /// The same as ``cost`` (m).
    #[getter]
    fn path_cost(&self) -> f64 {
        self.plan.cost
    }

    /// Nothing is proved of it.
    #[getter]
    fn lower_bound(&self) -> Option<f64> {
        None
    }

    /// Nothing is proved of it.
    #[getter]
    fn gap(&self) -> Option<f64> {
        None
    }

    /// It is never verified.
    #[getter]
    fn verdict(&self) -> Option<Py<Verdict>> {
        None
    }

    /// Length of the tip's path over the grid (m): eq. (10).
    #[getter]
    fn cost(&self) -> f64 {
        self.plan.cost
    }

    /// D*'s cost-to-go of the start (m): the least cost on this grid.
    #[getter]
    fn cost_to_go(&self) -> f64 {
        self.plan.cost_to_go
    }

    /// Places of the tip, start and goal included, shape ``(n, 2)`` (m).
    #[getter]
    fn tip_path<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        tips(py, &self.plan.tip_path)
    }

    /// All different paths of that cost that were drawn, shape ``(n, 2)`` each (m); the first is ``tip_path``.
    #[getter]
    fn equal_paths<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyArray2<f64>>> {
        self.plan.equal_paths.iter().map(|path| tips(py, path)).collect()
    }

    /// How often a dead point made a candidate step back.
    #[getter]
    fn dead_points(&self) -> usize {
        self.plan.dead_points
    }

    /// A configuration for each place of ``tip_path``, with as few jumps as can be, shape ``(n, 2)`` (rad).
    #[getter]
    fn configurations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        configurations(py, &self.plan.joint_path)
    }

    /// How many different paths of that cost were drawn.
    #[getter]
    fn paths_to_choose_from(&self) -> usize {
        self.plan.equal_paths.len()
    }

    /// The posture at each place: ``elbow-up``, ``elbow-down``, or ``None`` with the links in line.
    #[getter]
    fn postures(&self) -> Vec<Option<&'static str>> {
        postures(&self.plan.joint_path)
    }

    /// Steps that no arm can carry out: the place each begins at, from 0, and what is impossible.
    #[getter]
    fn jumps(&self) -> Vec<(usize, String)> {
        let in_words = |kind: &JumpKind| match kind {
            JumpKind::Posture => "posture".to_owned(),
            JumpKind::Stop { joint } => format!("stop of joint {joint}"),
        };
        self.plan.jumps.iter().map(|jump| (jump.index, in_words(&jump.kind))).collect()
    }

    /// Places of the path that the motion was led through, by their index.
    #[getter]
    fn vias(&self) -> Vec<usize> {
        self.plan.vias.clone()
    }

    /// Quintic pieces through the via points. Nothing has checked what lies between them.
    #[getter]
    fn motion(&self, py: Python<'_>) -> Py<Motion> {
        self.motion.clone_ref(py)
    }

    /// Seconds spent in each stage, in order.
    #[getter]
    fn timings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        in_order(py, &self.timings)
    }

    /// Return the motion every ``period`` (s), both ends included.
    ///
    /// Raises:
    ///     BadSetting: The period is not finite, or not greater than 0.
    #[pyo3(signature = (*, period=0.01))]
    fn sample<'py>(&self, py: Python<'py>, period: f64) -> PyResult<Bound<'py, PyAny>> {
        every(py, &self.asked.scene, &self.motion, period)
    }

    /// Return the motion at the instants ``t``, shape ``(n,)``, or at one, from 0 to the motion's end (s).
    ///
    /// Raises:
    ///     BadSetting: An instant is not a number, or not within the motion.
    fn at<'py>(&self, py: Python<'py>, t: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        within(py, &self.asked.scene, &self.motion, t)
    }

    fn __repr__(&self) -> String {
        let (cost, task) = (short(self.plan.cost), &self.asked.task);
        format!("<PaperPlan of task '{task}' by {}: cost {cost} m, not verified>", self.asked.planner)
    }
}

/// Return what the paper's system finds for the task called ``task``.
///
/// Raises:
///     UnknownTask: The scene has no such task.
///     NotFree: Start or goal is not free.
///     NotFound: The grid does not connect them.
///     TimedOut: The timeout came first.
///     BadSetting: A setting makes no sense.
#[pyfunction]
#[pyo3(signature = (scene, task, *, swarm, seed, vias, duration, candidates, timeout=None, on_stage=None))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn plan_as_in_paper(
    py: Python<'_>,
    #[pyo3(from_py_with = argument)] scene: Py<Scene>,
    #[pyo3(from_py_with = text)] task: &str,
    #[pyo3(from_py_with = argument)] swarm: bool,
    #[pyo3(from_py_with = argument)] seed: u64,
    #[pyo3(from_py_with = argument)] vias: usize,
    #[pyo3(from_py_with = argument)] duration: f64,
    #[pyo3(from_py_with = argument)] candidates: usize,
    #[pyo3(from_py_with = argument)] timeout: Option<f64>,
    on_stage: Option<&Bound<'_, PyAny>>,
) -> PyResult<PaperPlan> {
    let core = scene.get();
    let asked = core.task(py, task)?;
    let method = if swarm {
        Method::DstarPso(GuidedSwarmSettings { candidates, ..GuidedSwarmSettings::default() })
    } else {
        Method::Dstar
    };
    let settings = PaperSettings { method, seed, vias, duration };
    let work = |watch: &watch::Watch| planners::plan_as_in_paper(&core.scene, asked, &settings, watch);
    let (result, timings) = watch::run(py, timeout, on_stage, work)?;
    let plan = result.map_err(|error| errors::paper(py, scene.get().units(), task, timeout, &error))?;
    let mut settings = vec![
        ("mode".to_owned(), Setting::Word("paper".to_owned())),
        ("vias".to_owned(), Setting::Count(vias)),
        ("duration".to_owned(), Setting::Number(duration)),
    ];
    if swarm {
        settings.push(("candidates".to_owned(), Setting::Count(candidates)));
    }
    let question = Question {
        scene: scene.clone_ref(py),
        task: task.to_owned(),
        planner: if swarm { "dstar-pso" } else { "dstar" }.to_owned(),
        settings,
        seed,
        objective: Objective::Tip,
    };
    let motion = Py::new(py, Motion::from(plan.motion.clone()))?;
    Ok(PaperPlan { asked: question, plan, timings: watch::told(timings), motion })
}

fn tips<'py>(py: Python<'py>, path: &TipPath) -> Bound<'py, PyArray2<f64>> {
    let pairs: Vec<[f64; 2]> = path.0.iter().map(|p| [p.x, p.y]).collect();
    Array2::from(pairs).into_pyarray(py)
}

/// An array of shape (n, joints).
fn configurations<'py>(py: Python<'py>, path: &JointPath) -> Bound<'py, PyArray2<f64>> {
    let joints = path.0.first().map_or(0, |q| q.len());
    Array2::from_shape_fn((path.0.len(), joints), |(i, j)| path.0[i][j]).into_pyarray(py)
}

/// The posture of each configuration of two joints.
pub(crate) fn postures(path: &JointPath) -> Vec<Option<&'static str>> {
    let pair = |q: &Configuration| <[f64; 2]>::try_from(&**q).ok();
    path.0.iter().map(|q| Posture::of(&pair(q)?).map(Posture::name)).collect()
}
