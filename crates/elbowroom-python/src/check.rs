use std::sync::Arc;

use elbowroom::planning::Monitor;
use elbowroom::trajectory::{Samples, interpolate};
use elbowroom::verify::{Quantity, Verdict as Found, VerifySettings, Violation, verify_until};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::verdict::{Asked, Verdict};
use crate::watch;

/// What was taken between the rows of a trajectory, and so what must not jump between the pieces.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Curve {
    Linear,
    Cubic,
    Quintic,
}

impl Curve {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
        }
    }

    pub(crate) fn named(py: Python<'_>, name: &str) -> PyResult<Self> {
        [Self::Linear, Self::Cubic, Self::Quintic].into_iter().find(|curve| curve.name() == name).ok_or_else(
            || {
                let message = format!("no curve is called '{name}'; linear, cubic or quintic");
                errors::setting(py, "curve", &message)
            },
        )
    }

    const fn continuous(self) -> Quantity {
        match self {
            Self::Linear => Quantity::Position,
            Self::Cubic => Quantity::Velocity,
            Self::Quintic => Quantity::Acceleration,
        }
    }
}

/// The verifier's answer on a trajectory; ``bool(check)`` is whether it is proved to be safe.
///
/// The verifier alone makes them. One that is unpickled has been made anew: the trajectory is verified again.
#[pyclass(frozen, eq, module = "elbowroom._core")]
pub(crate) struct Check {
    motion: Py<Motion>,
    curve: Curve,
    verdict: Py<Verdict>,
}

impl PartialEq for Check {
    fn eq(&self, other: &Self) -> bool {
        self.curve == other.curve
            && self.motion.get() == other.motion.get()
            && self.verdict.get() == other.verdict.get()
    }
}

impl Check {
    /// What `verdict` is about with it; `None` for one that does not know.
    fn of(py: Python<'_>, verdict: Py<Verdict>) -> PyResult<Option<Self>> {
        let Some(asked) = verdict.get().asked() else { return Ok(None) };
        let motion = Py::new(py, Motion::from(Arc::clone(&asked.motion)))?;
        Ok(Some(Self { motion, curve: asked.curve, verdict }))
    }
}

#[pymethods]
impl Check {
    /// The trajectory as polynomials.
    #[getter]
    fn motion(&self, py: Python<'_>) -> Py<Motion> {
        self.motion.clone_ref(py)
    }

    /// What was taken between its rows: ``linear`` for positions alone, ``cubic`` with velocities, ``quintic`` with
    /// accelerations too. What such curves let jump by their nature, the velocity of a linear one, is compared with a
    /// joint only if the rate above it is limited.
    #[getter]
    fn curve(&self) -> &'static str {
        self.curve.name()
    }

    /// What the verifier says.
    #[getter]
    fn verdict(&self, py: Python<'_>) -> Py<Verdict> {
        self.verdict.clone_ref(py)
    }

    /// Whether the trajectory is proved to be safe.
    #[getter]
    fn safe(&self) -> bool {
        self.verdict.get().safe()
    }

    fn __bool__(&self) -> bool {
        self.safe()
    }

    fn __repr__(&self) -> String {
        format!("<Check of a {} trajectory: {}>", self.curve.name(), self.verdict.get().in_words())
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let again = py.import("elbowroom._core")?.getattr("check_again")?;
        (again, (self.verdict.bind(py),)).into_pyobject(py)
    }
}

/// Return the check that ``verdict`` is of.
///
/// Raises:
///     BadSetting: It is a replanner's, which does not know what it is about.
#[pyfunction]
pub(crate) fn check_again(py: Python<'_>, verdict: Py<Verdict>) -> PyResult<Check> {
    Check::of(py, verdict)?
        .ok_or_else(|| errors::setting(py, "verdict", "a replanner's verdict is of no trajectory"))
}

/// Return the motion through samples, and the curve taken between them: ``linear``, ``cubic`` or ``quintic``.
///
/// Raises:
///     TrajectoryError: The samples make no motion.
#[pyfunction]
#[pyo3(signature = (times, positions, velocities=None, accelerations=None))]
pub(crate) fn interpolated(
    py: Python<'_>,
    times: PyReadonlyArray1<'_, f64>,
    positions: PyReadonlyArray2<'_, f64>,
    velocities: Option<PyReadonlyArray2<'_, f64>>,
    accelerations: Option<PyReadonlyArray2<'_, f64>>,
) -> PyResult<(Motion, &'static str)> {
    let samples = Samples {
        times: times.as_array().to_vec(),
        positions: rows(&positions),
        velocities: velocities.map(|values| rows(&values)),
        accelerations: accelerations.map(|values| rows(&values)),
    };
    let (motion, curve) =
        interpolate(&samples).map_err(|error| errors::trajectory(py, &error.to_string()))?;
    Ok((motion.into(), curve.name()))
}

/// Return the verifier's answer on ``motion`` in ``scene``; ``curve`` says what must not jump between its pieces.
///
/// Raises:
///     TrajectoryError: It is no motion of this arm.
///     TimedOut: The timeout came first.
///     BadSetting: A setting makes no sense.
#[pyfunction]
#[pyo3(signature = (scene, motion, *, curve, margin, timeout=None))]
pub(crate) fn verify(
    py: Python<'_>,
    scene: Py<Scene>,
    motion: Py<Motion>,
    curve: &str,
    margin: f64,
    timeout: Option<f64>,
) -> PyResult<Check> {
    let curve = Curve::named(py, curve)?;
    let verdict = judged(py, &scene, motion.get(), curve, margin, timeout)?;
    Ok(Check { motion, curve, verdict: Py::new(py, verdict)? })
}

/// The verdict on `motion` in `scene`.
pub(crate) fn judged(
    py: Python<'_>,
    scene: &Py<Scene>,
    motion: &Motion,
    curve: Curve,
    margin: f64,
    timeout: Option<f64>,
) -> PyResult<Verdict> {
    let core = scene.get();
    let motion = &motion.motion;
    let (joints, moved) = (core.scene.arm().links(), motion.joints());
    if joints != moved {
        let message = format!("it moves {moved} joints; the arm of the scene has {joints}");
        return Err(errors::trajectory(py, &message));
    }
    if !(margin.is_finite() && margin >= 0.0) {
        return Err(errors::setting(
            py,
            "margin",
            &format!("margin is {}, it must be finite and not negative", core.units().stated_length(margin)),
        ));
    }
    let settings = VerifySettings { margin, continuous: curve.continuous(), ..VerifySettings::default() };
    let (found, _) = watch::run(py, timeout, None, |watch| {
        verify_until(&core.scene, motion, &settings, &|| watch.keep_going())
    })?;
    if was_stopped(&found) {
        return Err(errors::timed_out(py, timeout));
    }
    let asked = Asked { scene: scene.clone_ref(py), motion: Arc::clone(motion), curve, margin };
    Ok(Verdict::new(core, &found, Some(asked)))
}

fn was_stopped(found: &Found) -> bool {
    found.violations.iter().any(|violation| matches!(violation, Violation::Stopped { .. }))
}

fn rows(values: &PyReadonlyArray2<'_, f64>) -> Vec<Vec<f64>> {
    values.as_array().rows().into_iter().map(|row| row.to_vec()).collect()
}
