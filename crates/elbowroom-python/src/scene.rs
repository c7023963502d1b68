use elbowroom::arm::{Arm, JointLimits};
use elbowroom::geometry::Point;
use elbowroom::path::{link_clearances, self_clearance};
use elbowroom::scene::{
    self, Course, ObstacleMotion, Place, Sight, Task, TaskPosture, TwoLinkError, TwoLinkScene,
};
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::errors;
use crate::scene_parts::{ArmPart, GridPart, ObstaclePart, TaskPart};

/// An arm among obstacles, checked, as the core holds it.
#[pyclass(frozen, module = "elbowroom._core")]
pub(crate) struct Scene {
    pub(crate) scene: scene::Scene,
}

impl Scene {
    pub(crate) fn task(&self, py: Python<'_>, name: &str) -> PyResult<&Task> {
        let known = || self.scene.tasks().iter().map(|task| task.name.clone()).collect();
        self.scene.task(name).ok_or_else(|| errors::unknown_task(py, name, known()))
    }

    /// The scene with the closed forms of its arm, for `what` cannot do with another, or with obstacles that move.
    pub(crate) fn two_link(&self, py: Python<'_>, what: &str) -> PyResult<TwoLinkScene<'_>> {
        self.scene.two_link().map_err(|error| errors::two_link(py, what, &error))
    }

    /// The name of an obstacle, if it has one.
    pub(crate) fn obstacle_name(&self, index: usize) -> Option<&str> {
        self.scene.obstacles().get(index).and_then(|obstacle| obstacle.name.as_deref())
    }

    /// Refuses an arm of other than two links, for `what` serves obstacles that move too.
    pub(crate) fn check_links(&self, py: Python<'_>, what: &str) -> PyResult<()> {
        match self.scene.arm().links() {
            2 => Ok(()),
            found => Err(errors::two_link(py, what, &TwoLinkError::Links { found })),
        }
    }
}

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
            .map(|scene| Self { scene })
            .map_err(|problem| errors::part(py, "scene", &problem.to_string()))
    }

    /// Return the clearance of each link from the obstacles at configurations ``q``, shape ``(n, joints)``, as an array
    /// of that shape (m); 0 or less in contact, infinite without obstacles. Joint limits are not looked at.
    fn link_clearances<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let configurations = self.configurations(py, &q)?;
        let found: Vec<f64> =
            py.detach(|| configurations.iter().flat_map(|q| link_clearances(&self.scene, q)).collect());
        let shape = (configurations.len(), self.scene.arm().links());
        Ok(Array2::from_shape_fn(shape, |(i, j)| found[i * shape.1 + j]).into_pyarray(py))
    }

    /// Return the least clearance between links that have to keep clear of each other at configurations ``q``, shape
    /// ``(n, joints)``, one each (m); 0 or less in contact, infinite where there are no such links.
    fn self_clearances<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let configurations = self.configurations(py, &q)?;
        let found: Vec<f64> =
            py.detach(|| configurations.iter().map(|q| self_clearance(&self.scene, q)).collect());
        Ok(found.into_pyarray(py))
    }

    /// Return where the links end at configurations ``q``, shape ``(n, joints)``, as an array of shape ``(n, links, 2)``
    /// (m): the last is the tip.
    fn link_ends<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let configurations = self.configurations(py, &q)?;
        let arm = self.scene.arm();
        let ends: Vec<Point> = configurations.iter().flat_map(|q| arm.link_ends(q)).collect();
        let shape = (configurations.len(), arm.links(), 2);
        let at = |(i, link, axis): (usize, usize, usize)| {
            let end = ends[i * shape.1 + link];
            if axis == 0 { end.x } else { end.y }
        };
        Ok(Array3::from_shape_fn(shape, at).into_pyarray(py))
    }
}

impl Scene {
    fn configurations(&self, py: Python<'_>, q: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Vec<f64>>> {
        let joints = self.scene.arm().links();
        if q.as_array().ncols() != joints {
            let message = format!("configurations have {joints} columns, one per joint");
            return Err(errors::setting(py, "q", &message));
        }
        Ok(q.as_array().rows().into_iter().map(|row| row.to_vec()).collect())
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

    /// The scene as plain data, in metres and radians, with the names of the dataclasses' fields; of shapes the vertices of
    /// the core and the radius around it.
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let scene = &self.0.scene;
        let parts = PyDict::new(py);
        parts.set_item("arm", arm_parts(py, scene.arm())?)?;
        let grid = PyDict::new(py);
        let last = |first: f64, count: usize| first + (count - 1) as f64 * scene.grid().step();
        let origin = scene.grid().origin();
        grid.set_item("x", (origin.x, last(origin.x, scene.grid().columns())))?;
        grid.set_item("y", (origin.y, last(origin.y, scene.grid().rows())))?;
        grid.set_item("step", scene.grid().step())?;
        parts.set_item("grid", grid)?;
        let obstacles = PyList::empty(py);
        for obstacle in scene.obstacles() {
            let part = PyDict::new(py);
            let vertices: Vec<_> = obstacle.shape.vertices().iter().map(|v| (v.x, v.y)).collect();
            part.set_item("vertices", vertices)?;
            part.set_item("radius", obstacle.shape.radius())?;
            part.set_item("name", &obstacle.name)?;
            if let Some(motion) = &obstacle.motion {
                part.set_item("motion", motion_parts(py, motion)?)?;
            }
            obstacles.append(part)?;
        }
        parts.set_item("obstacles", obstacles)?;
        let tasks = PyDict::new(py);
        for task in scene.tasks() {
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

fn arm_parts<'py>(py: Python<'py>, arm: &Arm) -> PyResult<Bound<'py, PyDict>> {
    let parts = PyDict::new(py);
    parts.set_item("links", arm.lengths())?;
    parts.set_item("half_width", arm.half_width())?;
    parts.set_item("base", (arm.base().x, arm.base().y))?;
    parts.set_item("self_collision", arm.self_collision())?;
    let joints = PyList::empty(py);
    for joint in arm.joints() {
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
    parts.set_item("joints", joints)?;
    Ok(parts)
}

/// How an obstacle moves, with the names of the dataclass's fields.
pub(crate) fn motion_parts<'py>(py: Python<'py>, motion: &ObstacleMotion) -> PyResult<Bound<'py, PyDict>> {
    let part = PyDict::new(py);
    match motion.course() {
        Course::Waypoints(points) => {
            let points: Vec<_> = points.iter().map(|p| (p.time, (p.shift.x, p.shift.y))).collect();
            part.set_item("waypoints", points)?;
        }
        Course::Drift { start, velocity } => {
            part.set_item("velocity", (velocity.x, velocity.y))?;
            part.set_item("start", start)?;
        }
        Course::Chase { keep_off } => {
            part.set_item("chases", true)?;
            part.set_item("keep_off", keep_off)?;
        }
        // No file says so.
        Course::Absent | Course::Unknown { .. } => {}
    }
    part.set_item("greatest_speed", motion.greatest_speed())?;
    match motion.sight() {
        Sight::Always => {}
        Sight::From(time) => part.set_item("seen_from", time)?,
        Sight::Within(radius) => part.set_item("sensing_radius", radius)?,
    }
    Ok(part)
}

/// A tip as a pair under `end`, a configuration as a pair under `end_q`.
fn set_place(part: &Bound<'_, PyDict>, end: &str, place: &Place) -> PyResult<()> {
    match place {
        Place::Tip(tip) => part.set_item(end, (tip.x, tip.y)),
        Place::Configuration(q) => part.set_item(format!("{end}_q"), q.to_vec()),
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
