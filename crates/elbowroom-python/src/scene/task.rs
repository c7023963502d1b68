use elbowroom::arm;
use elbowroom::scene::{self, Place, TaskPosture};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::part::{Keywords, NewArgs, Part, hash_of, made, number, pair, point};
use crate::argument::{argument, text};
use crate::errors;

/// What they are called.
const POSTURES: [(&str, TaskPosture); 4] = [
    ("up", TaskPosture::Up),
    ("down", TaskPosture::Down),
    ("any", TaskPosture::Any),
    ("keep", TaskPosture::Keep),
];

/// Joint angles: a start or goal given by the joints.
///
/// Args:
///     q: One each, base first (rad).
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
#[derive(PartialEq)]
pub(crate) struct Configuration {
    q: arm::Configuration,
}

#[pymethods]
impl Configuration {
    #[new]
    fn new(#[pyo3(from_py_with = argument)] q: Vec<f64>) -> PyClassInitializer<Self> {
        made(Self { q: q.into() })
    }

    /// One angle each, base first (rad).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.q.iter().copied().map(number).collect::<Vec<_>>())
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of(slf)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        Ok(Keywords::new(py).with("q", self.q(py)?)?.told())
    }
}

/// A motion that is asked for, and the postures that will do.
///
/// Args:
///     start: Where the arm is: a place of the tip (m), or a ``Configuration``.
///     goal: Where it shall be, the same.
///     posture: ``up`` or ``down`` at the goal, ``any``, or ``keep`` for that of the start all along.
///     clearance: What every motion of it keeps (m) between links and what they must not touch.
///
/// Raises:
///     SceneError: There is no such posture, or the clearance is less than 0.
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
#[derive(PartialEq)]
pub(crate) struct Task {
    start: Place,
    goal: Place,
    posture: TaskPosture,
    clearance: f64,
}

impl Task {
    pub(crate) fn of<'py>(py: Python<'py>, task: &scene::Task) -> PyResult<Bound<'py, Self>> {
        let (start, goal) = (task.start.clone(), task.goal.clone());
        Bound::new(py, made(Self { start, goal, posture: task.posture, clearance: task.clearance }))
    }

    /// The task as the scene has it.
    pub(crate) fn called(&self, name: String) -> scene::Task {
        let (start, goal) = (self.start.clone(), self.goal.clone());
        scene::Task { name, start, goal, posture: self.posture, clearance: self.clearance }
    }
}

#[pymethods]
impl Task {
    #[new]
    #[pyo3(signature = (*, start, goal, posture="any", clearance=0.0))]
    fn new(
        py: Python<'_>,
        start: &Bound<'_, PyAny>,
        goal: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = text)] posture: &str,
        #[pyo3(from_py_with = argument)] clearance: f64,
    ) -> PyResult<PyClassInitializer<Self>> {
        let Some((_, posture)) = POSTURES.into_iter().find(|(name, _)| *name == posture) else {
            let message = format!("'{posture}'; up, down, any or keep");
            return Err(errors::part(py, "task.posture", &message));
        };
        if !(0.0..f64::INFINITY).contains(&clearance) {
            return Err(errors::part(
                py,
                "task.clearance",
                &format!("{clearance}; a length of 0 m or greater"),
            ));
        }
        Ok(made(Self { start: place(start, "start")?, goal: place(goal, "goal")?, posture, clearance }))
    }

    /// Where the arm is: a place of the tip (m), or a ``Configuration``.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        shown(py, &self.start)
    }

    /// Where it shall be: a place of the tip (m), or a ``Configuration``.
    #[getter]
    fn goal<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        shown(py, &self.goal)
    }

    /// Which postures will do: ``up``, ``down``, ``any`` or ``keep``.
    #[getter]
    fn posture(&self) -> &'static str {
        POSTURES.into_iter().find(|(_, known)| *known == self.posture).map_or("any", |(name, _)| name)
    }

    /// The clearance that every motion of it has to keep (m).
    #[getter]
    fn clearance(&self) -> f64 {
        self.clearance
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of(slf)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords = Keywords::new(py)
            .with("start", self.start(py)?)?
            .with("goal", self.goal(py)?)?
            .unless("any", "posture", self.posture())?
            .unless(0.0, "clearance", self.clearance)?;
        Ok(keywords.told())
    }
}

fn place(value: &Bound<'_, PyAny>, end: &str) -> PyResult<Place> {
    if let Ok(configuration) = value.cast::<Configuration>() {
        return Ok(Place::Configuration(configuration.get().q.clone()));
    }
    value.extract().map(|tip| Place::Tip(point(tip))).map_err(|_| {
        let message = format!("{end} is {value:?}; (x, y) of the tip or a Configuration is needed");
        PyTypeError::new_err(message)
    })
}

fn shown<'py>(py: Python<'py>, place: &Place) -> PyResult<Bound<'py, PyAny>> {
    match place {
        Place::Tip(tip) => Ok(pair(*tip).into_pyobject(py)?.into_any()),
        Place::Configuration(q) => Ok(Bound::new(py, made(Configuration { q: q.clone() }))?.into_any()),
    }
}
