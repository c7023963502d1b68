use elbowroom::geometry::{Point, Shape, ShapeError, Vector};
use elbowroom::scene;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::motion::ObstacleMotion;
use super::part::{Keywords, NewArgs, Part, hash_of, made, number, pair, point};
use crate::argument::argument;
use crate::errors;

/// Something that the arm must not touch: a ``Circle``, ``Segment`` or ``Polygon``.
#[pyclass(frozen, eq, subclass, extends = Part, module = "elbowroom._core")]
#[derive(PartialEq)]
pub(crate) struct Obstacle {
    obstacle: scene::Obstacle,
}

#[pymethods]
impl Obstacle {
    /// What people call it; ``None`` if they do not.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.obstacle.name.as_deref()
    }

    /// How it moves; ``None`` if it is static.
    #[getter]
    fn motion<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, ObstacleMotion>>> {
        self.obstacle.motion.clone().map(|motion| ObstacleMotion::of(py, motion)).transpose()
    }

    /// The shape as points with a radius (m): all that is within it of one point, of the line between two, or of a polygon.
    #[getter]
    fn outline<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyTuple>, f64)> {
        let shape = &self.obstacle.shape;
        Ok((in_pairs(py, shape.vertices())?, number(shape.radius())))
    }

    /// Return the same moved by so much (m).
    ///
    /// Raises:
    ///     SceneError: No obstacle may be there.
    fn shifted<'py>(&self, py: Python<'py>, by: [f64; 2]) -> PyResult<Bound<'py, PyAny>> {
        let moved = self.obstacle.shape.shifted(Vector::new(by[0], by[1]));
        // A shift may be no number, or take it too far out.
        let (vertices, radius) = (moved.vertices().to_vec(), moved.radius());
        let (kind, shape) = match vertices[..] {
            [center] => ("circle", Shape::circle(center, radius)),
            [start, end] => ("segment", Shape::segment(start, end, radius)),
            _ => ("polygon", Shape::rounded_polygon(vertices, radius)),
        };
        let shape = sound(py, kind, shape)?;
        Self::of(py, scene::Obstacle { shape, ..self.obstacle.clone() })
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of(slf)
    }
}

impl Obstacle {
    /// The `obstacle` as the class that its shape has.
    pub(crate) fn of(py: Python<'_>, obstacle: scene::Obstacle) -> PyResult<Bound<'_, PyAny>> {
        let corners = obstacle.shape.vertices().len();
        let base = made(Self { obstacle });
        match corners {
            1 => Bound::new(py, base.add_subclass(Circle)).map(Bound::into_any),
            2 => Bound::new(py, base.add_subclass(Segment)).map(Bound::into_any),
            _ => Bound::new(py, base.add_subclass(Polygon)).map(Bound::into_any),
        }
    }

    pub(crate) fn obstacle(&self) -> &scene::Obstacle {
        &self.obstacle
    }

    fn vertices(&self) -> &[Point] {
        self.obstacle.shape.vertices()
    }

    /// With the keywords that all shapes have.
    fn told<'py>(&self, py: Python<'py>, keywords: Keywords<'py>) -> PyResult<NewArgs<'py>> {
        Ok(keywords.some("name", self.name())?.some("motion", self.motion(py)?)?.told())
    }

    /// The same as a class, for its constructor.
    fn new(
        shape: Shape,
        name: Option<String>,
        motion: Option<Bound<'_, ObstacleMotion>>,
    ) -> PyClassInitializer<Self> {
        let motion = motion.map(|motion| motion.get().motion().clone());
        made(Self { obstacle: scene::Obstacle { name, shape, motion } })
    }
}

/// A disc that the arm must not touch, and how it moves if it does.
///
/// Args:
///     center: Its middle (m).
///     radius: Of the disc (m).
///     name: What people call it.
///     motion: How it moves; None for a static one.
///
/// Raises:
///     SceneError: The numbers make no disc.
#[pyclass(frozen, extends = Obstacle, module = "elbowroom._core")]
struct Circle;

#[pymethods]
impl Circle {
    #[new]
    #[pyo3(signature = (*, center, radius, name=None, motion=None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] center: [f64; 2],
        #[pyo3(from_py_with = argument)] radius: f64,
        #[pyo3(from_py_with = argument)] name: Option<String>,
        #[pyo3(from_py_with = argument)] motion: Option<Bound<'_, ObstacleMotion>>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let shape = sound(py, "circle", Shape::circle(point(center), radius))?;
        Ok(Obstacle::new(shape, name, motion).add_subclass(Self))
    }

    /// Its middle (m).
    #[getter]
    fn center(slf: &Bound<'_, Self>) -> (f64, f64) {
        pair(slf.as_super().get().vertices()[0])
    }

    /// Of the disc (m).
    #[getter]
    fn radius(slf: &Bound<'_, Self>) -> f64 {
        slf.as_super().get().obstacle.shape.radius()
    }

    fn __getnewargs_ex__<'py>(slf: &Bound<'py, Self>) -> PyResult<NewArgs<'py>> {
        let py = slf.py();
        let keywords =
            Keywords::new(py).with("center", Self::center(slf))?.with("radius", Self::radius(slf))?;
        slf.as_super().get().told(py, keywords)
    }
}

/// A straight wall that the arm must not touch: all that is within ``radius`` of the line between two points.
///
/// Args:
///     start: One end of the line (m).
///     end: The other (m).
///     radius: How far around the line the wall goes (m); 0 for one without thickness.
///     name: What people call it.
///     motion: How it moves; None for a static one.
///
/// Raises:
///     SceneError: The numbers make no wall.
#[pyclass(frozen, extends = Obstacle, module = "elbowroom._core")]
struct Segment;

#[pymethods]
impl Segment {
    #[new]
    #[pyo3(signature = (*, start, end, radius=0.0, name=None, motion=None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] start: [f64; 2],
        #[pyo3(from_py_with = argument)] end: [f64; 2],
        #[pyo3(from_py_with = argument)] radius: f64,
        #[pyo3(from_py_with = argument)] name: Option<String>,
        #[pyo3(from_py_with = argument)] motion: Option<Bound<'_, ObstacleMotion>>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let shape = sound(py, "segment", Shape::segment(point(start), point(end), radius))?;
        Ok(Obstacle::new(shape, name, motion).add_subclass(Self))
    }

    /// One end of the line (m).
    #[getter]
    fn start(slf: &Bound<'_, Self>) -> (f64, f64) {
        pair(slf.as_super().get().vertices()[0])
    }

    /// The other end of the line (m).
    #[getter]
    fn end(slf: &Bound<'_, Self>) -> (f64, f64) {
        pair(slf.as_super().get().vertices()[1])
    }

    /// How far around the line the wall goes (m).
    #[getter]
    fn radius(slf: &Bound<'_, Self>) -> f64 {
        number(slf.as_super().get().obstacle.shape.radius())
    }

    fn __getnewargs_ex__<'py>(slf: &Bound<'py, Self>) -> PyResult<NewArgs<'py>> {
        let py = slf.py();
        let keywords = Keywords::new(py)
            .with("start", Self::start(slf))?
            .with("end", Self::end(slf))?
            .unless(0.0, "radius", Self::radius(slf))?;
        slf.as_super().get().told(py, keywords)
    }
}

/// A simple polygon, convex or not, that the arm must not touch.
///
/// Args:
///     vertices: Its corners, in either direction, without repeating the first (m).
///     name: What people call it.
///     motion: How it moves; None for a static one.
///
/// Raises:
///     SceneError: The corners make no simple polygon.
#[pyclass(frozen, extends = Obstacle, module = "elbowroom._core")]
struct Polygon;

#[pymethods]
impl Polygon {
    #[new]
    #[pyo3(signature = (*, vertices, name=None, motion=None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] vertices: Vec<[f64; 2]>,
        #[pyo3(from_py_with = argument)] name: Option<String>,
        #[pyo3(from_py_with = argument)] motion: Option<Bound<'_, ObstacleMotion>>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let shape = Shape::polygon(vertices.into_iter().map(point).collect());
        Ok(Obstacle::new(sound(py, "polygon", shape)?, name, motion).add_subclass(Self))
    }

    /// Its corners (m).
    #[getter]
    fn vertices<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        in_pairs(slf.py(), slf.as_super().get().vertices())
    }

    fn __getnewargs_ex__<'py>(slf: &Bound<'py, Self>) -> PyResult<NewArgs<'py>> {
        let py = slf.py();
        slf.as_super().get().told(py, Keywords::new(py).with("vertices", Self::vertices(slf)?)?)
    }
}

/// The classes of all shapes, into `module`.
pub(crate) fn add_shapes(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Circle>()?;
    module.add_class::<Segment>()?;
    module.add_class::<Polygon>()
}

fn sound(py: Python<'_>, kind: &str, shape: Result<Shape, ShapeError>) -> PyResult<Shape> {
    shape.map_err(|error| errors::part(py, kind, &error.to_string()))
}

fn in_pairs<'py>(py: Python<'py>, points: &[Point]) -> PyResult<Bound<'py, PyTuple>> {
    PyTuple::new(py, points.iter().copied().map(pair))
}
