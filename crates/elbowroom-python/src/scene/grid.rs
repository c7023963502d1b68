use elbowroom::grid;
use pyo3::prelude::*;

use super::part::{Keywords, NewArgs, Part, hash_of, made, number};
use crate::argument::argument;
use crate::errors;

/// The points of the free-space map. Grids are equal if their points are.
///
/// Args:
///     x: Where they begin and end along x (m); the last is no farther than the end.
///     y: The same along y (m).
///     step: From one to the next (m).
///
/// Raises:
///     SceneError: The numbers make no grid.
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
#[derive(Clone, Copy)]
pub(crate) struct Grid {
    grid: grid::Grid,
    /// As they were asked for: a finer step may come nearer to their ends.
    ranges: [[f64; 2]; 2],
}

impl PartialEq for Grid {
    fn eq(&self, other: &Self) -> bool {
        self.grid == other.grid
    }
}

impl From<grid::Grid> for Grid {
    /// Ranges end at the last points.
    fn from(grid: grid::Grid) -> Self {
        let [x, y] = [grid.origin().x, grid.origin().y].map(number);
        let ranges = [[x, grid.x(grid.columns() - 1)], [y, grid.y(grid.rows() - 1)]];
        Self { grid, ranges }
    }
}

impl Grid {
    pub(crate) fn grid(&self) -> grid::Grid {
        self.grid
    }

    pub(crate) fn shown(self, py: Python<'_>) -> PyResult<Bound<'_, Self>> {
        Bound::new(py, made(self))
    }
}

#[pymethods]
impl Grid {
    #[new]
    #[pyo3(signature = (*, x, y, step))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] x: [f64; 2],
        #[pyo3(from_py_with = argument)] y: [f64; 2],
        #[pyo3(from_py_with = argument)] step: f64,
    ) -> PyResult<PyClassInitializer<Self>> {
        let ranges = [x.map(number), y.map(number)];
        grid::Grid::new(x, y, step)
            .map(|grid| made(Self { grid, ranges }))
            .map_err(|error| errors::part(py, "grid", &error.to_string()))
    }

    /// Where the points begin and end along x (m).
    #[getter]
    fn x(&self) -> (f64, f64) {
        self.ranges[0].into()
    }

    /// Where the points begin and end along y (m).
    #[getter]
    fn y(&self) -> (f64, f64) {
        self.ranges[1].into()
    }

    /// From one point to the next (m).
    #[getter]
    fn step(&self) -> f64 {
        self.grid.step()
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        hash_of(&Self::from(self.grid).shown(py)?.into_any())
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords =
            Keywords::new(py).with("x", self.x())?.with("y", self.y())?.with("step", self.step())?;
        Ok(keywords.told())
    }
}
