//! Planning while the arm moves: the replanner, and a world to try it in.

use std::sync::Mutex;

use elbowroom::arm::Posture;
use elbowroom::free_space::configurations;
use elbowroom::geometry::Vector;
use elbowroom::online::{self, Decision, KnownMotion};
use elbowroom::planning::Monitor;
use elbowroom::scene::{self, Course, Place, Sight, Task, TaskPosture};
use elbowroom::trajectory::State;
use elbowroom::units::Units;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::argument::{argument, text};
use crate::errors;
use crate::motion::Motion;
use crate::scene::{ObstacleMotion, Scene};
use crate::threads::with_threads;
use crate::verdict::Verdict;
use crate::watch;

const WHAT: &str = "planning while the arm moves";

/// Keeps an arm of two links going to a goal, safely, among obstacles that move.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct Replanner {
    replanner: Mutex<online::Replanner>,
    start: [f64; 2],
}

/// The decision's name, the motion that now runs, whether it ends at a goal, and the verifier's verdict on what is left of it.
type Update = (&'static str, Motion, bool, Verdict);

#[pymethods]
impl Replanner {
    /// For the arm of ``scene`` standing at ``q``, or where ``task`` starts, to get to its goal.
    ///
    /// Raises:
    ///     UnknownTask: The scene has no such task.
    ///     NotFree: The arm cannot stand at the start now, or at the goal whatever moves.
    ///     BadSetting: The arm has more than two links, or the task asks for a posture to be kept.
    #[new]
    #[pyo3(signature = (scene, task, *, seed, q=None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] scene: Py<Scene>,
        #[pyo3(from_py_with = text)] task: &str,
        #[pyo3(from_py_with = argument)] seed: u64,
        q: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        let scene = scene.get();
        let asked = scene.task(py, task)?;
        scene.check_links(py, WHAT)?;
        if asked.clearance > 0.0 {
            let message = format!("task '{task}' has a clearance, which {WHAT} cannot keep");
            return Err(errors::setting(py, "task", &message));
        }
        let (units, scene) = (scene.units(), &scene.scene);
        let start = match q {
            Some(q) => Place::Configuration(pair(py, "q", &q)?.into()),
            None => asked.start.clone(),
        };
        let now = scene.with_obstacles(online::World::new(scene.clone()).obstacles());
        let now = now.map_err(|error| errors::setting(py, "scene", &error.to_string()))?;
        let now = now.two_link().map_err(|error| errors::two_link(py, WHAT, &error))?;
        let starts = py.detach(|| configurations(now, &start));
        let starts = starts.map_err(|refused| errors::not_free(py, units, task, "start", &refused))?;
        let Some(&start) = starts.first() else { return Err(errors::internal(py, "no start")) };
        let goal = goal(py, units, scene, asked)?;
        let made = py.detach(|| with_threads(|| online::Replanner::new(scene.clone(), start, &goal, seed)));
        let made = made.ok_or_else(|| errors::no_threads(py))?;
        let replanner = made.map_err(|error| errors::replan(py, units, WHAT, task, &error))?;
        Ok(Self { replanner: Mutex::new(replanner), start })
    }

    /// Where the arm stands at the beginning, shape ``(2,)`` (rad).
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.start.to_vec().into_pyarray(py)
    }

    /// The motion that runs; before its start and after its end the arm stands.
    #[getter]
    fn motion(&self, py: Python<'_>) -> PyResult<Motion> {
        self.ask(py, |replanner| replanner.motion().clone().into())
    }

    /// Whether it ends at a goal.
    #[getter]
    fn reaches_goal(&self, py: Python<'_>) -> PyResult<bool> {
        self.ask(py, online::Replanner::reaches_goal)
    }

    /// Return what to do ``now`` (s) with the arm at ``q``, ``v``, ``a`` and what is ``known`` of the obstacles that move:
    /// the decision, the motion that now runs, whether it ends at a goal, and the verdict on what is left of it.
    ///
    /// Raises:
    ///     BadSetting: A number makes no sense, or what is known does not fit the scene.
    #[pyo3(signature = (scene, known, *, now, q, v, a, deadline=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn update<'py>(
        &self,
        py: Python<'py>,
        scene: &Scene,
        known: Vec<(usize, Option<KnownPart<'py>>)>,
        #[pyo3(from_py_with = argument)] now: f64,
        q: PyReadonlyArray1<'py, f64>,
        v: PyReadonlyArray1<'py, f64>,
        a: PyReadonlyArray1<'py, f64>,
        #[pyo3(from_py_with = argument)] deadline: Option<f64>,
    ) -> PyResult<Update> {
        let known = known
            .into_iter()
            .map(|(index, part)| known_motion(py, &scene.scene, index, part))
            .collect::<PyResult<Vec<_>>>()?;
        let [q, v, a] = [pair(py, "q", &q)?, pair(py, "v", &v)?, pair(py, "a", &a)?];
        let state = State { velocity: v.to_vec(), acceleration: a.to_vec(), ..State::rest(&q) };
        let (found, _) = watch::run(py, deadline, None, |watch| {
            let mut replanner = self.replanner.lock().ok()?;
            let update = replanner.update(&known, now, &state, &|| watch.keep_going());
            Some((update, replanner.motion().clone()))
        })?;
        let Some((update, motion)) = found else { return Err(broken(py)) };
        let update = update.map_err(|error| errors::setting(py, "known", &error.to_string()))?;
        let decision = match update.decision {
            Decision::Keep => "keep",
            Decision::New(_) => "new",
            Decision::Stop(_) => "stop",
            _ => return Err(errors::internal(py, "a decision without a name")),
        };
        let verdict = Verdict::new(scene, &update.verdict, None);
        Ok((decision, motion.into(), update.reaches_goal, verdict))
    }
}

impl Replanner {
    /// Waits for an update in another thread to end.
    fn ask<T: Send>(&self, py: Python<'_>, what: impl FnOnce(&online::Replanner) -> T + Send) -> PyResult<T> {
        py.detach(|| self.replanner.lock().ok().map(|replanner| what(&replanner))).ok_or_else(|| broken(py))
    }
}

/// A scene in time: where its movers are, and what the arm knows of them.
#[pyclass(module = "elbowroom._core")]
pub(crate) struct World(online::World);

#[pymethods]
impl World {
    /// The world of ``scene`` at time 0.
    ///
    /// Raises:
    ///     BadSetting: The arm has more than two links.
    #[new]
    fn new(py: Python<'_>, #[pyo3(from_py_with = argument)] scene: Py<Scene>) -> PyResult<Self> {
        let scene = scene.get();
        scene.check_links(py, "a world in time")?;
        Ok(Self(online::World::new(scene.scene.clone())))
    }

    /// What time it is (s).
    #[getter]
    fn now(&self) -> f64 {
        self.0.now()
    }

    /// Let time go on to ``now`` (s) while the arm is at ``q`` (rad).
    #[pyo3(signature = (now, *, q))]
    fn advance(
        &mut self,
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] now: f64,
        q: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<()> {
        self.0.advance(now, &pair(py, "q", &q)?);
        Ok(())
    }

    /// Where each obstacle that moves is now, in the scene's order, as a shift from where the scene has it, shape
    /// ``(movers, 2)`` (m).
    #[getter]
    fn shifts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let pairs: Vec<[f64; 2]> = self.0.shifts().iter().map(|shift| [shift.x, shift.y]).collect();
        Array2::from(pairs).into_pyarray(py)
    }

    /// Return what the arm, which is at ``q`` (rad), knows of each obstacle that moves: its place among the scene's
    /// obstacles, and its course, or where it is seen: shift (m), time (s) and maximum speed (m/s); ``None`` for one that
    /// it knows nothing of.
    #[pyo3(signature = (*, q))]
    fn known<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Vec<(usize, Option<Seen<'py>>)>> {
        let seen = self.0.seen_from(&pair(py, "q", &q)?);
        seen.iter().map(|known| Ok((known.obstacle, Seen::of(py, &known.motion)?))).collect()
    }
}

/// What is known of an obstacle that moves, to Python.
#[derive(IntoPyObject)]
enum Seen<'py> {
    Course(Bound<'py, ObstacleMotion>),
    Sighting((f64, f64), f64, f64),
}

impl<'py> Seen<'py> {
    fn of(py: Python<'py>, motion: &scene::ObstacleMotion) -> PyResult<Option<Self>> {
        let speed = motion.greatest_speed();
        match motion.course() {
            Course::Absent => Ok(None),
            Course::Unknown { seen, shift } => Ok(Some(Self::Sighting((shift.x, shift.y), *seen, speed))),
            course => {
                // The arm knows of it now, however that came about.
                let known = scene::ObstacleMotion::new(course.clone(), Sight::Always, Some(speed));
                let known = known.map_err(|error| errors::internal(py, &error.to_string()))?;
                ObstacleMotion::of(py, known).map(|known| Some(Self::Course(known)))
            }
        }
    }
}

/// What is known of an obstacle that moves, from Python: its course, or an `elbowroom.Sighting`.
#[derive(FromPyObject)]
enum KnownPart<'py> {
    Course(Bound<'py, ObstacleMotion>),
    Sighting { shift: [f64; 2], time: f64, greatest_speed: Option<f64> },
}

impl KnownPart<'_> {
    /// The obstacle that the scene declares to move as `declared`, as it is known.
    fn motion(
        self,
        py: Python<'_>,
        index: usize,
        declared: &scene::ObstacleMotion,
    ) -> PyResult<scene::ObstacleMotion> {
        let refused = |message: &str| errors::setting(py, "known", &format!("known[{index}]: {message}"));
        match self {
            Self::Course(known) => match known.get().motion() {
                motion if matches!(motion.course(), Course::Chase { .. }) => {
                    Err(refused("nobody knows the course of what chases; a Sighting says where it was seen"))
                }
                motion => Ok(motion.clone()),
            },
            Self::Sighting { shift: [x, y], time, greatest_speed } => {
                let course = Course::Unknown { seen: time, shift: Vector::new(x, y) };
                let speed = greatest_speed.unwrap_or_else(|| declared.greatest_speed());
                scene::ObstacleMotion::new(course, Sight::Always, Some(speed))
                    .map_err(|error| refused(&error.to_string()))
            }
        }
    }
}

/// How obstacle `index` of the scene, which has to be one that moves, is known to move.
fn known_motion(
    py: Python<'_>,
    scene: &scene::Scene,
    index: usize,
    part: Option<KnownPart<'_>>,
) -> PyResult<KnownMotion> {
    let obstacles = scene.obstacles();
    let Some(declared) = obstacles.get(index).and_then(|obstacle| obstacle.motion.as_ref()) else {
        let moving = obstacles.iter().enumerate().filter(|(_, obstacle)| obstacle.motion.is_some());
        let list: Vec<String> = moving.map(|(index, _)| index.to_string()).collect();
        let message = format!(
            "known: obstacle {index} does not move in this scene; those that do: {}",
            if list.is_empty() { "none".to_owned() } else { list.join(", ") }
        );
        return Err(errors::setting(py, "known", &message));
    };
    let motion = match part {
        Some(part) => part.motion(py, index, declared)?,
        None => declared.on(Course::Absent),
    };
    Ok(KnownMotion { obstacle: index, motion })
}

/// The goal of `task`, in the posture it asks for.
fn goal(py: Python<'_>, units: Units, scene: &scene::Scene, task: &Task) -> PyResult<Place> {
    let wanted = match task.posture {
        TaskPosture::Any => return Ok(task.goal.clone()),
        TaskPosture::Up => Posture::ElbowUp,
        TaskPosture::Down => Posture::ElbowDown,
        TaskPosture::Keep => {
            let message = "the replanner cannot keep a posture: evading obstacles may need the other; use up, down or any";
            return Err(errors::setting(py, "posture", message));
        }
    };
    let goals = py.detach(|| online::goal_configurations(scene, &task.goal));
    let goals = goals.map_err(|error| errors::replan(py, units, WHAT, &task.name, &error))?;
    let fits = |q: &[f64; 2]| Posture::of(q).is_none_or(|posture| posture == wanted);
    let found = goals.into_iter().find(fits).ok_or_else(|| {
        let message = format!("the goal cannot be reached {}", wanted.name());
        errors::setting(py, "posture", &message)
    })?;
    Ok(Place::Configuration(found.into()))
}

fn pair(py: Python<'_>, name: &str, values: &PyReadonlyArray1<'_, f64>) -> PyResult<[f64; 2]> {
    let found = values.as_array();
    match found.as_slice().and_then(|values| <[f64; 2]>::try_from(values).ok()) {
        Some(pair) if pair.iter().all(|value| value.is_finite()) => Ok(pair),
        _ => {
            let listed = PyList::new(py, found.iter())?;
            let message = format!("{name} is {listed}; two finite numbers are needed, one per joint");
            Err(errors::setting(py, name, &message))
        }
    }
}

fn broken(py: Python<'_>) -> PyErr {
    errors::internal(py, "an earlier update of this replanner failed")
}
