use elbowroom::arm::Posture;
use elbowroom::free_space::{Cases, CellState};
use elbowroom::planning::Monitor;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::argument;
use crate::errors;
use crate::scene::Scene;
use crate::watch;

/// The free Cartesian space: for each grid point and posture whether the tip may stand there, and why not.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct FreeSpace {
    scene: Py<Scene>,
    space: elbowroom::free_space::FreeSpace,
    cases: Cases,
    shape: (usize, usize),
}

/// What a map holds for each point, an array each.
type States<'py> = (Bound<'py, PyArray2<u8>>, Bound<'py, PyArray2<u8>>, Bound<'py, PyArray2<i32>>);

#[pymethods]
impl FreeSpace {
    /// Return the map of one posture (0 elbow-up, 1 elbow-down) as arrays of shape ``(rows, columns)``.
    ///
    /// Returns:
    ///     What holds (0 free, 1 out of reach, 2 joint limit, 3 collision); the joint or link, from 1, or 0;
    ///     the obstacle, from 0, or -1.
    fn states<'py>(&self, py: Python<'py>, posture: usize) -> PyResult<States<'py>> {
        let posture = *Posture::ALL.get(posture).ok_or_else(|| errors::setting(py, "posture", "0 or 1"))?;
        let states: Vec<CellState> = self.space.map(posture).states().collect();
        let (rows, columns) = self.shape;
        let at = |(row, column): (usize, usize)| states[row * columns + column];
        let kinds = Array2::from_shape_fn((rows, columns), |place| match at(place) {
            CellState::Free => 0,
            CellState::OutOfReach => 1,
            CellState::JointLimit { .. } => 2,
            CellState::Collision { .. } => 3,
        });
        let parts = Array2::from_shape_fn((rows, columns), |place| match at(place) {
            CellState::JointLimit { joint } => joint,
            CellState::Collision { link, .. } => link,
            CellState::Free | CellState::OutOfReach => 0,
        });
        let obstacles = Array2::from_shape_fn((rows, columns), |place| match at(place) {
            CellState::Collision { obstacle, .. } => i32::from(obstacle),
            _ => -1,
        });
        Ok((kinds.into_pyarray(py), parts.into_pyarray(py), obstacles.into_pyarray(py)))
    }

    /// How many free configurations put the tip on each point, shape ``(rows, columns)``: 0, 1 or 2. At full stretch both
    /// postures are one configuration.
    #[getter]
    fn configurations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let two_link = self.scene.get().two_link(py, "a map per posture")?;
        let counts: Vec<u8> = self.space.configurations(two_link).collect();
        let columns = self.shape.1;
        Ok(Array2::from_shape_fn(self.shape, |(row, column)| counts[row * columns + column]).into_pyarray(py))
    }

    /// How many points have ``two``, ``one`` and ``none`` free configurations: the paper's three cases.
    #[getter]
    fn cases<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let cases = PyDict::new(py);
        cases.set_item("two", self.cases.two)?;
        cases.set_item("one", self.cases.one)?;
        cases.set_item("none", self.cases.none)?;
        Ok(cases)
    }
}

/// Return the free-space maps of ``scene``.
#[pyfunction]
#[pyo3(signature = (scene, *, timeout=None))]
pub(crate) fn free_space(
    py: Python<'_>,
    #[pyo3(from_py_with = argument)] scene: Py<Scene>,
    #[pyo3(from_py_with = argument)] timeout: Option<f64>,
) -> PyResult<FreeSpace> {
    let two_link = scene.get().two_link(py, "a map per posture")?;
    let (found, _) = watch::run(py, timeout, None, |watch| {
        let space = elbowroom::free_space::FreeSpace::of_until(two_link, &|| watch.keep_going())?;
        let cases = space.cases(two_link);
        Some((space, cases))
    })?;
    let (space, cases) = found.ok_or_else(|| errors::timed_out(py, timeout))?;
    let shape = (two_link.grid().rows(), two_link.grid().columns());
    Ok(FreeSpace { scene, space, cases, shape })
}
