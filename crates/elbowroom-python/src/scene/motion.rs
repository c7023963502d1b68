use elbowroom::geometry::Vector;
use elbowroom::scene::{self, Course, Sight, Waypoint};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::part::{Keywords, NewArgs, Part, hash_of, made, number};
use crate::argument::argument;
use crate::errors;

/// How an obstacle moves, without turning: by waypoints, at one velocity, or after the arm's tip.
///
/// Args:
///     waypoints: Times (s) and shifts from where the scene has the obstacle (m): straight from one to the next, still
///         before the first and after the last.
///     velocity: In m/s, from ``start`` (s) on.
///     start: When it begins to move at its velocity (s).
///     chases: Whether it goes after the tip, at its maximum speed, but no nearer to the arm than ``keep_off`` (m).
///     keep_off: See ``chases``.
///     greatest_speed: It is never faster (m/s); None for that of its waypoints or velocity.
///     seen_from: Since when the arm knows of it (s); None, as ``sensing_radius``, if it always does.
///     sensing_radius: The arm knows of it while it is no farther away than this (m).
///
/// Raises:
///     SceneError: Nothing moves so.
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
#[derive(PartialEq)]
pub(crate) struct ObstacleMotion {
    motion: scene::ObstacleMotion,
}

impl ObstacleMotion {
    pub(crate) fn of(py: Python<'_>, motion: scene::ObstacleMotion) -> PyResult<Bound<'_, Self>> {
        Bound::new(py, made(Self { motion }))
    }

    pub(crate) fn motion(&self) -> &scene::ObstacleMotion {
        &self.motion
    }
}

#[pymethods]
impl ObstacleMotion {
    #[new]
    #[pyo3(signature = (*, waypoints=None, velocity=None, start=0.0, chases=false, keep_off=0.0, greatest_speed=None,
        seen_from=None, sensing_radius=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] waypoints: Option<Vec<(f64, [f64; 2])>>,
        #[pyo3(from_py_with = argument)] velocity: Option<[f64; 2]>,
        #[pyo3(from_py_with = argument)] start: f64,
        #[pyo3(from_py_with = argument)] chases: bool,
        #[pyo3(from_py_with = argument)] keep_off: f64,
        #[pyo3(from_py_with = argument)] greatest_speed: Option<f64>,
        #[pyo3(from_py_with = argument)] seen_from: Option<f64>,
        #[pyo3(from_py_with = argument)] sensing_radius: Option<f64>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let refused = |message: &str| errors::part(py, "motion", message);
        let vector = |[x, y]: [f64; 2]| Vector::new(x, y);
        if start != 0.0 && velocity.is_none() {
            return Err(refused("start is for what moves at a velocity"));
        }
        if keep_off != 0.0 && !chases {
            return Err(refused("keep_off is for what chases"));
        }
        let course = match (waypoints, velocity, chases) {
            (Some(points), None, false) => Course::Waypoints(
                points.into_iter().map(|(time, shift)| Waypoint { time, shift: vector(shift) }).collect(),
            ),
            (None, Some(velocity), false) => Course::Drift { start, velocity: vector(velocity) },
            (None, None, true) => Course::Chase { keep_off },
            _ => return Err(refused("one of waypoints, velocity, chases")),
        };
        let sight = match (seen_from, sensing_radius) {
            (None, None) => Sight::Always,
            (Some(time), None) => Sight::From(time),
            (None, Some(radius)) => Sight::Within(radius),
            (Some(_), Some(_)) => return Err(refused("seen_from or sensing_radius, not both")),
        };
        if chases && greatest_speed.is_none() {
            return Err(refused("greatest_speed is needed beside chases"));
        }
        scene::ObstacleMotion::new(course, sight, greatest_speed)
            .map(|motion| made(Self { motion }))
            .map_err(|error| refused(&error.to_string()))
    }

    /// Times (s) and shifts (m) of the places it goes to; ``None`` if it does not go by them.
    #[getter]
    fn waypoints<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyTuple>>> {
        let Course::Waypoints(points) = self.motion.course() else { return Ok(None) };
        PyTuple::new(py, points.iter().map(|at| (number(at.time), in_pairs(at.shift)))).map(Some)
    }

    /// Its velocity (m/s); ``None`` if it does not move at one.
    #[getter]
    fn velocity(&self) -> Option<(f64, f64)> {
        match *self.motion.course() {
            Course::Drift { velocity, .. } => Some(in_pairs(velocity)),
            _ => None,
        }
    }

    /// When it begins to move at its velocity (s).
    #[getter]
    fn start(&self) -> f64 {
        match *self.motion.course() {
            Course::Drift { start, .. } => number(start),
            _ => 0.0,
        }
    }

    /// Whether it goes after the arm's tip.
    #[getter]
    fn chases(&self) -> bool {
        matches!(self.motion.course(), Course::Chase { .. })
    }

    /// How far from the arm it stops where it chases (m).
    #[getter]
    fn keep_off(&self) -> f64 {
        match *self.motion.course() {
            Course::Chase { keep_off } => number(keep_off),
            _ => 0.0,
        }
    }

    /// It is never faster (m/s); ``None`` for the speed of its waypoints or velocity.
    #[getter]
    fn greatest_speed(&self) -> Option<f64> {
        self.motion.declared_speed().map(number)
    }

    /// Since when the arm knows of it (s); ``None`` if that does not go by time.
    #[getter]
    fn seen_from(&self) -> Option<f64> {
        match self.motion.sight() {
            Sight::From(time) => Some(number(time)),
            _ => None,
        }
    }

    /// How far from the arm it is seen (m); ``None`` if that does not go by distance.
    #[getter]
    fn sensing_radius(&self) -> Option<f64> {
        match self.motion.sight() {
            Sight::Within(radius) => Some(number(radius)),
            _ => None,
        }
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of(slf)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords = Keywords::new(py)
            .some("waypoints", self.waypoints(py)?)?
            .some("velocity", self.velocity())?
            .unless(0.0, "start", self.start())?
            .unless(false, "chases", self.chases())?
            .unless(0.0, "keep_off", self.keep_off())?
            .some("greatest_speed", self.greatest_speed())?
            .some("seen_from", self.seen_from())?
            .some("sensing_radius", self.sensing_radius())?;
        Ok(keywords.told())
    }
}

fn in_pairs(vector: Vector) -> (f64, f64) {
    (number(vector.x), number(vector.y))
}
