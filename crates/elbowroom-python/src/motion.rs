use elbowroom::trajectory;
use numpy::ndarray::{Array1, Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray1};
use pyo3::prelude::*;

/// Polynomial pieces over time, one after the other; nothing says that an arm may run them.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct Motion(pub(crate) trajectory::Motion);

/// Positions, velocities, accelerations and jerks, shape (n, joints) each.
type Samples<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

#[pymethods]
impl Motion {
    /// How long it lasts (s).
    #[getter]
    fn duration(&self) -> f64 {
        self.0.duration()
    }

    /// When it ends (s).
    #[getter]
    fn end(&self) -> f64 {
        self.0.end()
    }

    /// When each piece begins, shape ``(pieces,)`` (s).
    #[getter]
    fn starts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.pieces().iter().map(|piece| piece.start).collect::<Array1<f64>>().into_pyarray(py)
    }

    /// How long each piece lasts, shape ``(pieces,)`` (s).
    #[getter]
    fn durations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.pieces().iter().map(|piece| piece.duration).collect::<Array1<f64>>().into_pyarray(py)
    }

    /// Polynomial coefficients, shape ``(pieces, joints, 6)``: the constant first, of the time since the piece's
    /// start (rad, rad/s, ...).
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f64>> {
        let pieces = self.0.pieces();
        Array3::from_shape_fn((pieces.len(), self.0.joints(), 6), |(i, j, k)| pieces[i].coefficients[j][k])
            .into_pyarray(py)
    }

    /// Return joint positions, velocities, accelerations and jerks at ``times`` (s), shape ``(n, joints)`` each.
    fn sample<'py>(&self, py: Python<'py>, times: PyReadonlyArray1<'py, f64>) -> Samples<'py> {
        let states: Vec<_> = times.as_array().iter().map(|&t| self.0.at(t)).collect();
        let array = |of: fn(&trajectory::State) -> &Vec<f64>| {
            Array2::from_shape_fn((states.len(), self.0.joints()), |(i, j)| of(&states[i])[j])
                .into_pyarray(py)
        };
        (array(|s| &s.position), array(|s| &s.velocity), array(|s| &s.acceleration), array(|s| &s.jerk))
    }
}
