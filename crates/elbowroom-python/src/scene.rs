use elbowroom::arm::{Configuration, JointLimits};
use elbowroom::path::link_clearances;
use elbowroom::scene::{self, Place, Shape, Task, TaskPosture};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::errors;
use crate::scene_parts::{ArmPart, GridPart, ObstaclePart, TaskPart};

/// An arm among obstacles, checked, as the core holds it.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct Scene(pub(crate) scene::Scene);

impl Scene {
    pub(crate) fn task(&self, py: Python<'_>, name: &str) -> PyResult<&Task> {
        let known = || self.0.tasks.iter().map(|task| task.name.clone()).collect();
        self.0.task(name).ok_or_else(|| errors::unknown_task(py, name, known()))
    }
}

/// Two arrays of shape (n, 2).
type PointArrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

#[pymethods]
impl Scene {
    /// Check the parts, dataclasses of ``elbowroom.scene``, and hold what they say.
    ///
    /// Raises:
    ///     SceneError: A part makes no sense.
    #[new]
    #[pyo3(signature = (*, arm, grid, obstacles, tasks))]
    fn new(
        py: Python<'_>,
        arm: ArmPart,
        grid: GridPart,
        obstacles: Vec<ObstaclePart>,
        tasks: Vec<(String, TaskPart)>,
    ) -> PyResult<Self> {
        let obstacles = obstacles
            .into_iter()
            .enumerate()
            .map(|(index, part)| part.build(py, index))
            .collect::<PyResult<Vec<_>>>()?;
        let tasks =
            tasks.into_iter().map(|(name, part)| part.build(py, name)).collect::<PyResult<Vec<_>>>()?;
        scene::Scene::new(arm.build(py)?, grid.build(py)?, obstacles, tasks)
            .map(Self)
            .map_err(|problem| errors::part(py, "scene", &problem.to_string()))
    }

    /// Return the clearance of each link at configurations ``q``, shape ``(n, 2)`` (m); 0 or less in contact, infinite
    /// without obstacles. Joint limits are not looked at.
    fn link_clearances<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let configurations = configurations(py, &q)?;
        let found: Vec<[f64; 2]> =
            py.detach(|| configurations.iter().map(|q| link_clearances(&self.0, q)).collect());
        Ok(points(py, found.into_iter()))
    }

    /// Return where elbow and tip are at configurations ``q``, shape ``(n, 2)`` each (m).
    fn elbows_and_tips<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<PointArrays<'py>> {
        let configurations = configurations(py, &q)?;
        let arm = &self.0.arm;
        let at = |point: elbowroom::geometry::Point| [point.x, point.y];
        Ok((
            points(py, configurations.iter().map(|q| at(arm.elbow(q)))),
            points(py, configurations.iter().map(|q| at(arm.tip(q)))),
        ))
    }
}

/// A scene file, parsed: its parts as plain data, and where in the text its tasks begin and end.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct SceneFile(scene::SceneFile);

#[pymethods]
impl SceneFile {
    /// Parse ``text``; ``file`` is what errors call it.
    ///
    /// Raises:
    ///     SceneError: The text is no scene; with line, column and key.
    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, file: &str) -> PyResult<Self> {
        py.detach(|| scene::parse(text, file)).map(Self).map_err(|error| errors::scene_file(py, &error))
    }

    /// Line and column, from 1, of ``start`` or ``goal`` of the task called ``task``.
    fn location(&self, task: &str, end: &str) -> Option<(usize, usize)> {
        let at = match end {
            "start" => self.0.locations.start(task),
            _ => self.0.locations.goal(task),
        }?;
        Some((at.line, at.column))
    }

    /// The scene as plain data, in metres and radians, with the names of the dataclasses' fields.
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let scene = &self.0.scene;
        let parts = PyDict::new(py);
        parts.set_item("arm", arm_parts(py, scene)?)?;
        let grid = PyDict::new(py);
        let last = |first: f64, count: usize| first + (count - 1) as f64 * scene.grid.step();
        let origin = scene.grid.origin();
        grid.set_item("x", (origin.x, last(origin.x, scene.grid.columns())))?;
        grid.set_item("y", (origin.y, last(origin.y, scene.grid.rows())))?;
        grid.set_item("step", scene.grid.step())?;
        parts.set_item("grid", grid)?;
        let obstacles = PyList::empty(py);
        for obstacle in &scene.obstacles {
            let part = PyDict::new(py);
            match &obstacle.shape {
                Shape::Circle(circle) => {
                    part.set_item("center", (circle.center.x, circle.center.y))?;
                    part.set_item("radius", circle.radius)?;
                }
                Shape::Polygon(polygon) => {
                    let vertices: Vec<_> = polygon.vertices().iter().map(|v| (v.x, v.y)).collect();
                    part.set_item("vertices", vertices)?;
                }
            }
            part.set_item("name", &obstacle.name)?;
            obstacles.append(part)?;
        }
        parts.set_item("obstacles", obstacles)?;
        let tasks = PyDict::new(py);
        for task in &scene.tasks {
            let part = PyDict::new(py);
            set_place(&part, "start", &task.start)?;
            set_place(&part, "goal", &task.goal)?;
            let posture = match task.posture {
                TaskPosture::Up => "up",
                TaskPosture::Down => "down",
                TaskPosture::Any => "any",
                TaskPosture::Keep => "keep",
            };
            part.set_item("posture", posture)?;
            tasks.set_item(&task.name, part)?;
        }
        parts.set_item("tasks", tasks)?;
        Ok(parts)
    }
}

fn configurations(py: Python<'_>, q: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Configuration<2>>> {
    if q.as_array().ncols() != 2 {
        return Err(errors::setting(py, "q", "configurations have two columns, one per joint"));
    }
    Ok(q.as_array().rows().into_iter().map(|row| Configuration([row[0], row[1]])).collect())
}

fn arm_parts<'py>(py: Python<'py>, scene: &scene::Scene) -> PyResult<Bound<'py, PyDict>> {
    let arm = PyDict::new(py);
    arm.set_item("links", scene.arm.lengths())?;
    arm.set_item("half_width", scene.arm.half_width())?;
    arm.set_item("base", (scene.arm.base().x, scene.arm.base().y))?;
    let joints = PyList::empty(py);
    for joint in scene.arm.joints() {
        let part = PyDict::new(py);
        match joint.limits {
            JointLimits::Continuous => part.set_item("continuous", true)?,
            JointLimits::Range { min, max } => {
                part.set_item("min", min)?;
                part.set_item("max", max)?;
            }
        }
        part.set_item("velocity", joint.motion.velocity)?;
        part.set_item("acceleration", joint.motion.acceleration)?;
        part.set_item("jerk", joint.motion.jerk)?;
        joints.append(part)?;
    }
    arm.set_item("joints", joints)?;
    Ok(arm)
}

/// A tip as a pair under `end`, a configuration as a pair under `end_q`.
fn set_place(part: &Bound<'_, PyDict>, end: &str, place: &Place) -> PyResult<()> {
    match place {
        Place::Tip(tip) => part.set_item(end, (tip.x, tip.y)),
        Place::Configuration(q) => part.set_item(format!("{end}_q"), q.0),
    }
}

/// An array of shape (n, 2).
pub(crate) fn points<'py>(
    py: Python<'py>,
    pairs: impl Iterator<Item = [f64; 2]>,
) -> Bound<'py, PyArray2<f64>> {
    let pairs: Vec<[f64; 2]> = pairs.collect();
    Array2::from(pairs).into_pyarray(py)
}
