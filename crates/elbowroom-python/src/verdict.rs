//! What the verifier says of a motion.

use std::sync::Arc;

use elbowroom::trajectory;
use elbowroom::units::short;
use elbowroom::verify::{self, FLOOR};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use crate::check::{self, Terms, Told};
use crate::errors;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::verdict_parts::{Clearance, JointMargin, MotionMargins, Violation};
use crate::verdict_rows::{Allowed, Unjudged};

/// What the verifier says of a motion. ``safe`` is a proof; ``bool(verdict)`` is the same.
///
/// The verifier alone makes verdicts. One that is unpickled has been made anew: the motion is verified again.
#[pyclass(frozen, eq, module = "elbowroom._core")]
pub(crate) struct Verdict {
    found: Found,
    /// What was judged; unknown of a replanner's, which is on what was left of a motion among obstacles as they were known.
    asked: Option<Asked>,
}

#[derive(PartialEq)]
struct Found {
    violations: Vec<Violation>,
    least_clearance: Option<Clearance>,
    joint_margins: Vec<Option<JointMargin>>,
    motion_margins: Vec<MotionMargins>,
    posture_changes: Vec<f64>,
    unjudged: Vec<Unjudged>,
    allowed: Vec<Allowed>,
}

/// A motion to be judged.
pub(crate) struct Asked {
    pub(crate) scene: Py<Scene>,
    pub(crate) motion: Arc<trajectory::Motion>,
    pub(crate) terms: Terms,
}

/// Verdicts are equal if they say the same.
impl PartialEq for Verdict {
    fn eq(&self, other: &Self) -> bool {
        self.found == other.found
    }
}

impl Verdict {
    pub(crate) fn new(scene: &Scene, verdict: &verify::Verdict, asked: Option<Asked>) -> Self {
        let margin = asked.as_ref().map_or(0.0, |asked| asked.terms.margin);
        let found = Found {
            violations: verdict.violations.iter().map(|one| Violation::of(scene, margin, one)).collect(),
            least_clearance: verdict.least_clearance.map(|least| Clearance::of(scene, &least)),
            joint_margins: verdict.joint_margins.iter().map(|m| m.as_ref().map(JointMargin::of)).collect(),
            motion_margins: verdict.motion_margins.iter().map(MotionMargins::of).collect(),
            posture_changes: verdict.posture_changes.clone(),
            unjudged: verdict.unjudged.iter().map(|one| Unjudged::of(scene, one)).collect(),
            allowed: verdict.allowed.iter().map(|one| Allowed::of(scene, one)).collect(),
        };
        Self { found, asked }
    }

    pub(crate) fn asked(&self) -> Option<&Asked> {
        self.asked.as_ref()
    }

    /// ``safe``, and how near or why not.
    pub(crate) fn in_words(&self) -> String {
        let but = match self.found.unjudged.len() {
            0 => String::new(),
            1 => " in what was judged, a rate was not".to_owned(),
            more => format!(" in what was judged, {more} rates were not"),
        };
        match (self.found.violations.as_slice(), &self.found.least_clearance) {
            ([], Some(least)) => format!("safe{but}, least clearance {} mm", short(least.distance() * 1e3)),
            ([], None) => format!("safe{but}"),
            ([first, rest @ ..], _) => {
                let more = if rest.is_empty() { String::new() } else { format!(", {} more", rest.len()) };
                format!("not safe: {} at {} s{more}", first.kind(), short(first.time()))
            }
        }
    }
}

#[pymethods]
impl Verdict {
    /// Whether the motion is proved to be safe, down to a clearance of ``floor``, in all that was judged: see ``unjudged``.
    #[getter]
    pub(crate) fn safe(&self) -> bool {
        self.found.violations.is_empty()
    }

    /// Why it is not safe, in order of time; empty if it is.
    #[getter]
    fn violations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.found.violations.iter().cloned())
    }

    /// Clearance that a safe motion has more of, whatever was asked for (m).
    #[getter]
    fn floor(&self) -> f64 {
        FLOOR
    }

    /// The nearest that a link comes to what it must not touch; ``None`` where there is nothing of the kind.
    #[getter]
    fn least_clearance(&self) -> Option<Clearance> {
        self.found.least_clearance.clone()
    }

    /// How near each joint comes to its limits, base first; ``None`` for a joint without limits.
    #[getter]
    fn joint_margins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.found.joint_margins.iter().cloned())
    }

    /// The greatest velocity, acceleration and jerk of each joint, base first.
    #[getter]
    fn motion_margins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.found.motion_margins.iter().cloned())
    }

    /// When the elbow of an arm of two links changes sides (s), ascending.
    #[getter]
    fn posture_changes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, &self.found.posture_changes)
    }

    /// Rates that have a limit and were not judged, as the rows of the trajectory do not tell them well enough; they are no part
    /// of ``safe``.
    #[getter]
    fn unjudged<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.found.unjudged.iter().cloned())
    }

    /// What is beyond a limit, and passed for the rounding of the rows, their spacing, or the tolerance asked for.
    #[getter]
    fn allowed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.found.allowed.iter().cloned())
    }

    /// Return all of it as dictionaries and lists, as ``plan.json`` and ``--json`` have it.
    fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = &self.found;
        let fields = PyDict::new(py);
        fields.set_item("safe", self.safe())?;
        let violations: Vec<_> = found.violations.iter().map(|v| v.as_dict(py)).collect::<PyResult<_>>()?;
        fields.set_item("violations", PyList::new(py, violations)?)?;
        fields.set_item("floor", FLOOR)?;
        let least = found.least_clearance.as_ref().map(|least| least.as_dict(py)).transpose()?;
        fields.set_item("least_clearance", least)?;
        let stops: Vec<_> =
            found.joint_margins.iter().map(|m| m.as_ref().map(JointMargin::as_pair)).collect();
        fields.set_item("joint_margins", stops)?;
        let motion: Vec<_> = found.motion_margins.iter().map(|m| m.as_dict(py)).collect::<PyResult<_>>()?;
        fields.set_item("motion_margins", PyList::new(py, motion)?)?;
        fields.set_item("posture_changes", &found.posture_changes)?;
        // Of rows alone: a plan's own motion is told as it is.
        if self.asked.as_ref().is_some_and(|asked| asked.terms.rows.is_some()) {
            let unjudged: Vec<_> =
                found.unjudged.iter().map(|one| one.as_dict(py)).collect::<PyResult<_>>()?;
            fields.set_item("unjudged", PyList::new(py, unjudged)?)?;
            let allowed: Vec<_> = found.allowed.iter().map(|one| one.as_dict(py)).collect::<PyResult<_>>()?;
            fields.set_item("allowed", PyList::new(py, allowed)?)?;
        }
        Ok(fields)
    }

    fn __bool__(&self) -> bool {
        self.safe()
    }

    fn __repr__(&self) -> String {
        format!("<Verdict {}>", self.in_words())
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let Some(asked) = &self.asked else {
            let message = "cannot pickle a replanner's verdict: what was known of the obstacles is not kept, so it cannot be verified again";
            return Err(PyTypeError::new_err(message));
        };
        let again = py.import("elbowroom._core")?.getattr("verdict_again")?;
        let motion = Motion::from(Arc::clone(&asked.motion));
        let told = (asked.scene.bind(py), motion, asked.terms.told(), self.safe());
        (again, told).into_pyobject(py)
    }
}

/// Return the verdict on ``motion`` in ``scene``, verified again on the same ``terms``: curve, margin, the curves at its ends if it
/// is to be at rest there, lead, and how its rows were written; ``safe`` is what an earlier one said.
///
/// Raises:
///     Refuted: It was said to be safe, and is not.
#[pyfunction]
pub(crate) fn verdict_again(
    py: Python<'_>,
    scene: Py<Scene>,
    motion: &Motion,
    terms: Told,
    safe: bool,
) -> PyResult<Verdict> {
    let verdict = check::judged(py, &scene, motion, Terms::read(py, &terms)?, None)?;
    if safe && !verdict.safe() {
        return Err(refuted(py, "the motion was kept as safe", verdict));
    }
    Ok(verdict)
}

/// What was kept does not hold: the motion is not safe.
pub(crate) fn refuted(py: Python<'_>, what: &str, verdict: Verdict) -> PyErr {
    let first = verdict.found.violations.first().map_or("not safe", Violation::message);
    let message = format!("{what}; judged again, it is not: {first}");
    match Py::new(py, verdict) {
        Ok(verdict) => errors::refuted(py, &message, Some(verdict)),
        Err(error) => error,
    }
}
