use elbowroom::planners::Monitor;
use elbowroom::trajectory::{Samples, interpolate};
use elbowroom::verify::{Quantity, Verdict, VerifySettings, Violation, verify_until};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::verdict;
use crate::watch;

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
    Ok((Motion(motion), curve.name()))
}

/// Return what the verifier says of ``motion`` in ``scene``; ``curve`` says what must not jump between its pieces.
#[pyfunction]
#[pyo3(signature = (scene, motion, *, curve, margin, timeout=None))]
pub(crate) fn verify<'py>(
    py: Python<'py>,
    scene: &Scene,
    motion: &Motion,
    curve: &str,
    margin: f64,
    timeout: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let (joints, moved) = (scene.scene.arm().links(), motion.0.joints());
    if joints != moved {
        let message = format!("it moves {moved} joints; the arm of the scene has {joints}");
        return Err(errors::trajectory(py, &message));
    }
    if !(margin.is_finite() && margin >= 0.0) {
        return Err(errors::setting(
            py,
            "margin",
            &format!("margin is {margin} m, it must be finite and not negative"),
        ));
    }
    let continuous = match curve {
        "linear" => Quantity::Position,
        "cubic" => Quantity::Velocity,
        _ => Quantity::Acceleration,
    };
    let settings = VerifySettings { margin, continuous, ..VerifySettings::default() };
    let (found, _) = watch::run(py, timeout, None, |watch| {
        verify_until(&scene.scene, &motion.0, &settings, &|| watch.keep_going())
    })?;
    if was_stopped(&found) {
        return Err(errors::timed_out(py, timeout));
    }
    verdict::as_dict(py, &scene.scene, &found)
}

fn was_stopped(found: &Verdict) -> bool {
    found.violations.iter().any(|violation| matches!(violation, Violation::Stopped { .. }))
}

fn rows(values: &PyReadonlyArray2<'_, f64>) -> Vec<Vec<f64>> {
    values.as_array().rows().into_iter().map(|row| row.to_vec()).collect()
}
