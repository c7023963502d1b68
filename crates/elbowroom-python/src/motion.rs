use std::sync::Arc;

use elbowroom::trajectory::{self, Piece};
use elbowroom::units::short;
use numpy::ndarray::{Array1, Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;

use crate::errors;
use crate::once::Once;

/// Polynomial pieces over time, one after the other; nothing says that an arm may run them.
///
/// Args:
///     starts: When each piece begins, shape ``(pieces,)`` (s).
///     durations: How long each lasts, shape ``(pieces,)`` (s).
///     coefficients: Of its polynomials, shape ``(pieces, joints, 6)``: the constant first, of the time since the
///         piece's start (rad, rad/s, ...).
///
/// Raises:
///     TrajectoryError: The pieces make no motion.
#[pyclass(frozen, eq, module = "elbowroom._core")]
pub(crate) struct Motion {
    pub(crate) motion: Arc<trajectory::Motion>,
    starts: Once<PyArray1<f64>>,
    durations: Once<PyArray1<f64>>,
    coefficients: Once<PyArray3<f64>>,
}

impl From<Arc<trajectory::Motion>> for Motion {
    fn from(motion: Arc<trajectory::Motion>) -> Self {
        Self { motion, starts: Once::new(), durations: Once::new(), coefficients: Once::new() }
    }
}

impl From<trajectory::Motion> for Motion {
    fn from(motion: trajectory::Motion) -> Self {
        Arc::new(motion).into()
    }
}

impl PartialEq for Motion {
    fn eq(&self, other: &Self) -> bool {
        self.motion == other.motion
    }
}

/// Positions, velocities, accelerations and jerks, shape (n, joints) each.
type Samples<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

/// Starts, durations and coefficients of the pieces.
type Parts<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray3<f64>>);

#[pymethods]
impl Motion {
    #[new]
    fn new(
        py: Python<'_>,
        starts: PyReadonlyArray1<'_, f64>,
        durations: PyReadonlyArray1<'_, f64>,
        coefficients: PyReadonlyArray3<'_, f64>,
    ) -> PyResult<Self> {
        let (starts, durations, coefficients) =
            (starts.as_array(), durations.as_array(), coefficients.as_array());
        let (pieces, joints, terms) = coefficients.dim();
        if (starts.len(), durations.len(), terms) != (pieces, pieces, 6) {
            let message = format!(
                "{} starts, {} durations and coefficients of shape ({pieces}, {joints}, {terms}); (pieces, joints, 6) \
                 is needed and a start and a duration for each piece",
                starts.len(),
                durations.len()
            );
            return Err(errors::trajectory(py, &message));
        }
        let piece = |i: usize| Piece {
            start: starts[i],
            duration: durations[i],
            coefficients: (0..joints).map(|j| std::array::from_fn(|k| coefficients[[i, j, k]])).collect(),
        };
        trajectory::Motion::new((0..pieces).map(piece).collect())
            .map(Self::from)
            .map_err(|error| errors::trajectory(py, &error.to_string()))
    }

    /// How long it lasts (s).
    #[getter]
    fn duration(&self) -> f64 {
        self.motion.duration()
    }

    /// When it ends (s).
    #[getter]
    fn end(&self) -> f64 {
        self.motion.end()
    }

    /// When each piece begins, shape ``(pieces,)`` (s).
    #[getter]
    fn starts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let pieces = self.motion.pieces();
        self.starts.get(py, || pieces.iter().map(|piece| piece.start).collect::<Array1<f64>>())
    }

    /// How long each piece lasts, shape ``(pieces,)`` (s).
    #[getter]
    fn durations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let pieces = self.motion.pieces();
        self.durations.get(py, || pieces.iter().map(|piece| piece.duration).collect::<Array1<f64>>())
    }

    /// Polynomial coefficients, shape ``(pieces, joints, 6)``: the constant first, of the time since the piece's
    /// start (rad, rad/s, ...).
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f64>> {
        let pieces = self.motion.pieces();
        let shape = (pieces.len(), self.motion.joints(), 6);
        self.coefficients.get(py, || Array3::from_shape_fn(shape, |(i, j, k)| pieces[i].coefficients[j][k]))
    }

    /// Return joint positions, velocities, accelerations and jerks at ``times`` (s), shape ``(n, joints)`` each.
    fn sample<'py>(&self, py: Python<'py>, times: PyReadonlyArray1<'py, f64>) -> Samples<'py> {
        let states: Vec<_> = times.as_array().iter().map(|&t| self.motion.at(t)).collect();
        let array = |of: fn(&trajectory::State) -> &Vec<f64>| {
            Array2::from_shape_fn((states.len(), self.motion.joints()), |(i, j)| of(&states[i])[j])
                .into_pyarray(py)
        };
        (array(|s| &s.position), array(|s| &s.velocity), array(|s| &s.acceleration), array(|s| &s.jerk))
    }

    fn __repr__(&self) -> String {
        let (pieces, joints) = (self.motion.pieces().len(), self.motion.joints());
        let (start, end) = (short(self.motion.start()), short(self.motion.end()));
        format!("<Motion of {joints} joints, {pieces} pieces from {start} s to {end} s>")
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __getnewargs__<'py>(&self, py: Python<'py>) -> Parts<'py> {
        (self.starts(py), self.durations(py), self.coefficients(py))
    }
}
