//! A plan as Python shows it.

use elbowroom::planning::{self, Objective};
use elbowroom::units::short;
use numpy::PyArray2;
use numpy::ndarray::Array2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::check::Terms;
use crate::motion::Motion;
use crate::once::Once;
use crate::plan_kept;
use crate::scene::Scene;
use crate::verdict::{Asked, Verdict};

/// What a planner found for a task: a motion that is proved to be safe in its scene, and how it came to be.
///
/// Planners alone make plans. One that is unpickled has had its motion verified again; the path it was made from and its lower
/// bound are as they were kept. Plans are equal if all but their timings is.
/// Arrays cannot be written to.
#[pyclass(frozen, eq, module = "elbowroom._core")]
pub(crate) struct Plan {
    pub(crate) asked: Question,
    pub(crate) plan: planning::Plan,
    pub(crate) timings: Vec<(String, f64)>,
    motion: Py<Motion>,
    verdict: Py<Verdict>,
    tip_path: Once<PyArray2<f64>>,
    configurations: Once<PyArray2<f64>>,
}

/// What a planner was asked.
pub(crate) struct Question {
    pub(crate) scene: Py<Scene>,
    pub(crate) task: String,
    pub(crate) planner: String,
    pub(crate) settings: Vec<(String, Setting)>,
    pub(crate) seed: u64,
    pub(crate) objective: Objective,
}

/// The value of a setting.
#[derive(Clone, PartialEq, FromPyObject, IntoPyObject)]
pub(crate) enum Setting {
    Flag(bool),
    Count(usize),
    Number(f64),
    Word(String),
}

impl Question {
    /// The settings as a dictionary.
    pub(crate) fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let settings = PyDict::new(py);
        for (name, value) in &self.settings {
            settings.set_item(name, value.clone())?;
        }
        Ok(settings)
    }

    /// Whether all but the scene is the same.
    fn same_but_scene(&self, other: &Self) -> bool {
        (&self.task, &self.planner, self.seed, self.objective)
            == (&other.task, &other.planner, other.seed, other.objective)
            && self.settings == other.settings
    }
}

impl Plan {
    pub(crate) fn new(
        py: Python<'_>,
        asked: Question,
        plan: planning::Plan,
        timings: Vec<(String, f64)>,
    ) -> PyResult<Self> {
        let motion = Motion::from(plan.trajectory().motion().clone());
        let judged =
            Asked { scene: asked.scene.clone_ref(py), motion: motion.motion.clone(), terms: Terms::PLANNED };
        let verdict = Verdict::new(asked.scene.get(), plan.trajectory().verdict(), Some(judged));
        Ok(Self {
            asked,
            plan,
            timings,
            motion: Py::new(py, motion)?,
            verdict: Py::new(py, verdict)?,
            tip_path: Once::new(),
            configurations: Once::new(),
        })
    }
}

impl PartialEq for Plan {
    fn eq(&self, other: &Self) -> bool {
        self.plan == other.plan
            && self.asked.same_but_scene(&other.asked)
            && self.asked.scene.get() == other.asked.scene.get()
    }
}

#[pymethods]
impl Plan {
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

    /// The planner's name.
    #[getter]
    fn planner(&self) -> &str {
        &self.asked.planner
    }

    /// What was asked of the planner: the pace, and all its options.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.asked.settings(py)
    }

    /// Of the swarm.
    #[getter]
    fn seed(&self) -> u64 {
        self.asked.seed
    }

    /// What the choice went by: ``tip``, ``joint`` or ``time``.
    #[getter]
    fn objective(&self) -> &'static str {
        self.asked.objective.name()
    }

    /// What the motion costs in terms of the objective, in ``cost_unit``.
    #[getter]
    fn cost(&self) -> f64 {
        self.plan.cost()
    }

    /// Of ``cost`` and ``lower_bound``: ``m`` of tip travel, ``rad`` of joint travel, or ``s``.
    #[getter]
    fn cost_unit(&self) -> &'static str {
        self.asked.objective.unit()
    }

    /// No motion costs less than this; ``None`` where nothing could be proved.
    #[getter]
    fn lower_bound(&self) -> Option<f64> {
        self.plan.lower_bound()
    }

    /// By which share of ``lower_bound`` the cost is above it: no motion is better by more; ``None`` where unknown.
    #[getter]
    fn gap(&self) -> Option<f64> {
        self.plan.gap()
    }

    /// Tip travel along the path that the motion was made from (m).
    #[getter]
    fn path_cost(&self) -> f64 {
        self.plan.record().path_cost
    }

    /// How many different paths the choice was among.
    #[getter]
    fn paths_to_choose_from(&self) -> usize {
        self.plan.record().paths_to_choose_from
    }

    /// Where the tip is at each configuration, shape ``(n, 2)`` (m).
    #[getter]
    fn tip_path<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let points = &self.plan.record().tip_path.0;
        self.tip_path.get(py, || {
            Array2::from_shape_fn(
                (points.len(), 2),
                |(i, axis)| if axis == 0 { points[i].x } else { points[i].y },
            )
        })
    }

    /// Configurations from start to goal, shape ``(n, joints)`` (rad): of the path that the motion was led along, whose
    /// straight moves are certified free; where the planner found a motion, on it.
    #[getter]
    fn configurations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let path = &self.plan.record().joint_path.0;
        let joints = self.plan.trajectory().motion().joints();
        self.configurations.get(py, || Array2::from_shape_fn((path.len(), joints), |(i, j)| path[i][j]))
    }

    /// The posture at each: ``elbow-up``, ``elbow-down``, or ``None`` with the links in line or more links than two.
    #[getter]
    fn postures(&self) -> Vec<Option<&'static str>> {
        crate::paper::postures(&self.plan.record().joint_path)
    }

    /// Places of the path that the motion is led through, by their index.
    #[getter]
    fn vias(&self) -> Vec<usize> {
        self.plan.record().vias.clone()
    }

    /// The clearance that was asked for, and is proved to be kept (m); 0 if only contact was forbidden.
    #[getter]
    fn clearance(&self) -> f64 {
        self.plan.record().clearance
    }

    /// How many via points, ends left out, the arm stops at.
    #[getter]
    fn stops(&self) -> usize {
        self.plan.record().stops
    }

    /// Motion limits the scene does not state, and what was taken in their place: joint, rate, value (rad/s, rad/s²,
    /// rad/s³).
    #[getter]
    fn assumed_limits(&self) -> Vec<(usize, &'static str, f64)> {
        self.plan.record().assumed_limits.iter().map(|limit| (limit.joint, limit.rate, limit.value)).collect()
    }

    /// The polynomials, proved to be safe.
    #[getter]
    fn motion(&self, py: Python<'_>) -> Py<Motion> {
        self.motion.clone_ref(py)
    }

    /// What the verifier says of the motion.
    #[getter]
    fn verdict(&self, py: Python<'_>) -> Py<Verdict> {
        self.verdict.clone_ref(py)
    }

    /// Seconds spent in each stage, in order.
    #[getter]
    fn timings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        in_order(py, &self.timings)
    }

    /// How many candidates the planner judged; ``None`` if it does not count them.
    #[getter]
    fn evaluations(&self) -> Option<usize> {
        self.plan.effort().map(|effort| effort.evaluations)
    }

    /// Evaluations made, and the best cost by then, each time that fell; ``None`` if it does not count them.
    #[getter]
    fn convergence(&self) -> Option<Vec<(usize, f64)>> {
        self.plan.effort().map(|effort| effort.convergence.clone())
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
        let gap = self.plan.gap().map_or_else(String::new, |gap| format!(", gap {} %", short(100.0 * gap)));
        let (cost, unit) = (short(self.plan.cost()), self.cost_unit());
        let (duration, verdict) =
            (short(self.plan.trajectory().motion().duration()), self.verdict.get().in_words());
        let (task, planner) = (&self.asked.task, &self.asked.planner);
        format!("<Plan of task '{task}' by {planner}: cost {cost} {unit}{gap}, {duration} s, {verdict}>")
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let again = py.import("elbowroom._core")?.getattr("plan_again")?;
        let told = (self.asked.scene.bind(py), self.motion.bind(py), plan_kept::Kept::of(self));
        (again, told).into_pyobject(py)
    }
}

/// Seconds by stage as a dictionary.
pub(crate) fn in_order<'py>(py: Python<'py>, timings: &[(String, f64)]) -> PyResult<Bound<'py, PyDict>> {
    let stages = PyDict::new(py);
    for (stage, seconds) in timings {
        stages.set_item(stage, seconds)?;
    }
    Ok(stages)
}

/// `elbowroom._samples.within`.
pub(crate) fn within<'py>(
    py: Python<'py>,
    scene: &Py<Scene>,
    motion: &Py<Motion>,
    t: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("elbowroom._samples")?.getattr("within")?.call1((scene, motion, t))
}

/// `elbowroom._samples.every`.
pub(crate) fn every<'py>(
    py: Python<'py>,
    scene: &Py<Scene>,
    motion: &Py<Motion>,
    period: f64,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("elbowroom._samples")?.getattr("every")?.call1((scene, motion, period))
}
