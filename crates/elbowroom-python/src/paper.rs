use elbowroom::arm::{Configuration, Posture};
use elbowroom::path::{JointPath, JumpKind, TipPath};
use elbowroom::planners::{self, Method, PaperSettings};
use elbowroom::swarm::GuidedSwarmSettings;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;

use crate::errors;
use crate::motion::Motion;
use crate::scene::{Scene, points};
use crate::watch::{self, Timings};

/// What the paper's system finds: a path over the union of both postures, and polynomials that nobody verified.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct PaperPlan {
    plan: planners::PaperPlan,
    timings: Timings,
}

#[pymethods]
impl PaperPlan {
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
    fn motion(&self) -> Motion {
        Motion(self.plan.motion.clone())
    }

    /// Seconds spent in each stage, in order.
    #[getter]
    fn timings(&self) -> Timings {
        self.timings.clone()
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
    scene: &Scene,
    task: &str,
    swarm: bool,
    seed: u64,
    vias: usize,
    duration: f64,
    candidates: usize,
    timeout: Option<f64>,
    on_stage: Option<&Bound<'_, PyAny>>,
) -> PyResult<PaperPlan> {
    let asked = scene.task(py, task)?;
    let method = if swarm {
        Method::DstarPso(GuidedSwarmSettings { candidates, ..GuidedSwarmSettings::default() })
    } else {
        Method::Dstar
    };
    let settings = PaperSettings { method, seed, vias, duration };
    let work = |watch: &watch::Watch| planners::plan_as_in_paper(&scene.scene, asked, &settings, watch);
    let (result, timings) = watch::run(py, timeout, on_stage, work)?;
    let plan = result.map_err(|error| errors::paper(py, task, timeout, &error))?;
    Ok(PaperPlan { plan, timings })
}

pub(crate) fn tips<'py>(py: Python<'py>, path: &TipPath) -> Bound<'py, PyArray2<f64>> {
    points(py, path.0.iter().map(|p| [p.x, p.y]))
}

/// An array of shape (n, joints).
pub(crate) fn configurations<'py>(py: Python<'py>, path: &JointPath) -> Bound<'py, PyArray2<f64>> {
    let joints = path.0.first().map_or(0, |q| q.len());
    Array2::from_shape_fn((path.0.len(), joints), |(i, j)| path.0[i][j]).into_pyarray(py)
}

/// The posture of each configuration of two joints.
pub(crate) fn postures(path: &JointPath) -> Vec<Option<&'static str>> {
    let pair = |q: &Configuration| <[f64; 2]>::try_from(&**q).ok();
    path.0.iter().map(|q| Posture::of(&pair(q)?).map(Posture::name)).collect()
}
