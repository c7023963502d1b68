use elbowroom::geometry::Point;
use elbowroom::path::{link_clearances, self_clearance};
use elbowroom::planning::PlanError;
use elbowroom::scene::{self, TwoLinkError, TwoLinkScene};
use elbowroom::units::Told;
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyMapping, PyMappingProxy, PyString, PyTuple};

use super::arm::Arm;
use super::configurations::configurations;
use super::grid::Grid;
use super::obstacle::Obstacle;
use super::part::{Keywords, NewArgs, Part, each_of_class, keywords_of, made, of_class};
use super::source::{self, Source};
use super::task::Task;
use super::units::Units;
use crate::argument::{argument, text};
use crate::errors;
use crate::once::Once;

/// So many tasks are shown by `repr`.
const MOST_SHOWN: usize = 4;

/// An arm among obstacles, with the grid of its map and named tasks. Metres and radians throughout.
///
/// Scenes are equal if they say the same, wherever they come from.
///
/// Args:
///     arm: The arm.
///     grid: The points of its free-space maps.
///     obstacles: What it must not touch.
///     tasks: What is asked of it, by name.
///     units: What texts and pictures tell lengths and angles in; of a file those that it is written in. Attributes, and
///         numbers that are asked for, are in metres and radians all the same.
///
/// Raises:
///     SceneError: The parts make no scene.
///
/// Example:
///     >>> import math
///     >>> import elbowroom as er
///     >>> bend = math.radians(150)
///     >>> scene = er.Scene(
///     ...     arm=er.Arm(links=(0.25, 0.25), joints=(er.Joint(continuous=True), er.Joint(min=-bend, max=bend))),
///     ...     grid=er.Grid(x=(-0.5, 0.5), y=(-0.5, 0.5), step=0.01),
///     ...     obstacles=[er.Circle(center=(0.22, 0.22), radius=0.05)],
///     ...     tasks={"first": er.Task(start=(0.4, 0.1), goal=(-0.45, -0.15))},
///     ... )
///     >>> er.free_space(scene).cases["two"] > 1000
///     True
///     >>> scene.replace(obstacles=[obstacle.shifted((0.0, 0.1)) for obstacle in scene.obstacles]).obstacles
///     (Circle(center=(0.22, 0.32), radius=0.05),)
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
pub(crate) struct Scene {
    pub(crate) scene: scene::Scene,
    /// As it was given, which says more than its points.
    grid: Grid,
    /// In which its texts and pictures are.
    units: Units,
    /// `None` if the scene was made, or changed, in code.
    source: Option<Source>,
    arm: Once<Arm>,
    obstacles: Once<PyTuple>,
    tasks: Once<PyDict>,
    sha256: Once<PyString>,
}

/// In which order the tasks stand does not matter.
impl PartialEq for Scene {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (&self.scene, &other.scene);
        a.arm() == b.arm()
            && a.grid() == b.grid()
            && a.obstacles() == b.obstacles()
            && a.tasks().len() == b.tasks().len()
            && a.tasks().iter().all(|task| b.task(&task.name) == Some(task))
    }
}

impl Scene {
    fn of(scene: scene::Scene, grid: Grid, units: Units, source: Option<Source>) -> PyClassInitializer<Self> {
        let (arm, obstacles, tasks, sha256) = (Once::new(), Once::new(), Once::new(), Once::new());
        made(Self { scene, grid, units, source, arm, obstacles, tasks, sha256 })
    }

    pub(crate) fn task(&self, py: Python<'_>, name: &str) -> PyResult<&scene::Task> {
        let known = || self.scene.tasks().iter().map(|task| task.name.clone()).collect();
        self.scene.task(name).ok_or_else(|| errors::unknown_task(py, Some(name), known()))
    }

    /// The scene with the closed forms of its arm, for `what` cannot do with another, or with obstacles that move.
    pub(crate) fn two_link(&self, py: Python<'_>, what: &str) -> PyResult<TwoLinkScene<'_>> {
        self.scene.two_link().map_err(|error| errors::two_link(py, what, &error))
    }

    /// The name of an obstacle, if it has one.
    pub(crate) fn obstacle_name(&self, index: usize) -> Option<&str> {
        self.scene.obstacles().get(index).and_then(|obstacle| obstacle.name.as_deref())
    }

    /// What its texts tell lengths and angles in.
    pub(crate) fn units(&self) -> elbowroom::units::Units {
        self.units.units()
    }

    /// Refuses an arm of other than two links, for `what` serves obstacles that move too.
    pub(crate) fn check_links(&self, py: Python<'_>, what: &str) -> PyResult<()> {
        match self.scene.arm().links() {
            2 => Ok(()),
            found => Err(errors::two_link(py, what, &TwoLinkError::Links { found })),
        }
    }

    fn read<'py>(py: Python<'py>, text: &str, file: &str) -> PyResult<Bound<'py, Self>> {
        let read = py.detach(|| scene::parse(text, file)).map_err(|error| errors::scene_file(py, &error))?;
        let source = Source::of(&read, file);
        let grid = (*read.scene.grid()).into();
        Bound::new(py, Self::of(read.scene, grid, read.units.into(), Some(source)))
    }

    /// The hash of what the scene says.
    fn hashed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyString>> {
        // Not the grid as it was given: equal ones may be given otherwise.
        let grid = Grid::from(*self.scene.grid());
        let said = PyDict::new(py);
        said.set_item("arm", self.arm(py)?)?;
        said.set_item("grid", grid.shown(py)?)?;
        said.set_item("obstacles", self.obstacles(py)?)?;
        said.set_item("tasks", self.tasks_by_name(py)?)?;
        let keywords = |args: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| {
            keywords_of(&args.get_item(0)?).map(Bound::unbind)
        };
        let options = PyDict::new(py);
        options.set_item("sort_keys", true)?;
        options.set_item("default", PyCFunction::new_closure(py, None, None, keywords)?)?;
        let text = py.import("json")?.call_method("dumps", (said,), Some(&options))?;
        let hash = py.import("hashlib")?.call_method1("sha256", (text.call_method0("encode")?,))?;
        Ok(hash.call_method0("hexdigest")?.cast_into()?)
    }

    fn tasks_by_name<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.tasks.made(py, || {
            let tasks = PyDict::new(py);
            for task in self.scene.tasks() {
                tasks.set_item(&task.name, Task::of(py, task)?)?;
            }
            Ok(tasks)
        })
    }
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(
        signature = (*file, arm=None, grid=None, obstacles=None, tasks=None, units=None),
        text_signature = "(*, arm, grid, obstacles=None, tasks=None, units=None)"
    )]
    fn new<'py>(
        py: Python<'py>,
        file: &Bound<'py, PyTuple>,
        arm: Option<&Bound<'py, Arm>>,
        grid: Option<&Bound<'py, Grid>>,
        obstacles: Option<&Bound<'py, PyAny>>,
        tasks: Option<&Bound<'py, PyAny>>,
        units: Option<&Bound<'py, Units>>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let (true, Some(arm), Some(grid)) = (file.is_empty(), arm, grid) else {
            return Err(PyTypeError::new_err(
                "a Scene is made of parts by keyword, arm=, grid=, obstacles=, tasks=; Scene.load(path) reads a file",
            ));
        };
        let obstacles = obstacles.map(|given| each_of_class::<Obstacle>(given, "obstacles")).transpose()?;
        let obstacles =
            obstacles.iter().flatten().map(|obstacle| obstacle.get().obstacle().clone()).collect();
        let mut named = Vec::new();
        if let Some(tasks) = tasks {
            let Ok(tasks) = tasks.cast::<PyMapping>() else {
                let message = format!(
                    "tasks is of type {}; names and their tasks are needed, such as {{'pick': Task(...)}}",
                    tasks.get_type().name()?
                );
                return Err(PyTypeError::new_err(message));
            };
            for item in tasks.items()? {
                let (name, task): (String, Bound<'_, PyAny>) = item.extract()?;
                let task = of_class::<Task>(task, &format!("tasks['{name}']"))?;
                named.push(task.get().called(name));
            }
        }
        let grid = *grid.get();
        scene::Scene::new(arm.get().arm().clone(), grid.grid(), obstacles, named)
            .map(|scene| Self::of(scene, grid, units.map_or_else(Units::default, |given| *given.get()), None))
            .map_err(|problem| errors::part(py, "scene", &problem.to_string()))
    }

    /// Return the scene in the YAML file at ``path``; its format is ``schema/scene.schema.json``.
    ///
    /// Raises:
    ///     SceneError: The file cannot be read or is no scene; with file, line, column and key.
    #[staticmethod]
    fn load<'py>(py: Python<'py>, path: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Self>> {
        Self::read(py, &source::text_of(path)?, &path.str()?.to_cow()?)
    }

    /// Return one of the scenes that come with the package, such as ``paper-standin``.
    ///
    /// Raises:
    ///     SceneError: There is no such scene; the message lists those there are.
    #[staticmethod]
    fn example<'py>(py: Python<'py>, #[pyo3(from_py_with = text)] name: &str) -> PyResult<Bound<'py, Self>> {
        Self::read(py, &source::example_text(py, name)?, &format!("scenes/{name}.yaml"))
    }

    /// Return the scene in the YAML ``text``; errors call it ``file``.
    ///
    /// Raises:
    ///     SceneError: The text is no scene; with file, line, column and key.
    #[staticmethod]
    #[pyo3(signature = (text, *, file="scene"))]
    fn parse<'py>(
        py: Python<'py>,
        #[pyo3(from_py_with = text)] text: &str,
        #[pyo3(from_py_with = text)] file: &str,
    ) -> PyResult<Bound<'py, Self>> {
        Self::read(py, text, file)
    }

    /// The arm.
    #[getter]
    fn arm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, Arm>> {
        self.arm.made(py, || Arm::of(py, self.scene.arm()))
    }

    /// The points of its free-space maps.
    #[getter]
    fn grid<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, Grid>> {
        self.grid.shown(py)
    }

    /// What the arm must not touch, in the order given.
    #[getter]
    fn obstacles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        self.obstacles.made(py, || {
            let obstacles = self.scene.obstacles().iter().map(|obstacle| Obstacle::of(py, obstacle.clone()));
            PyTuple::new(py, obstacles.collect::<PyResult<Vec<_>>>()?)
        })
    }

    /// What is asked of the arm, by name; cannot be written to.
    #[getter]
    fn tasks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyMappingProxy>> {
        Ok(PyMappingProxy::new(py, self.tasks_by_name(py)?.as_mapping()))
    }

    /// The units that texts and pictures of it are in.
    #[getter]
    #[pyo3(name = "units")]
    fn units_shown<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, Units>> {
        self.units.shown(py)
    }

    /// What the text is called that it was read from; ``None`` if it was made, or changed, in code.
    #[getter]
    fn file(&self) -> Option<&str> {
        self.source.as_ref().map(|source| source.file.as_str())
    }

    /// Line and column of each (task, "start" or "goal") in that text; none if there is none.
    #[getter]
    fn locations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.source.as_ref().map_or_else(|| Ok(PyDict::new(py)), |source| source.locations(py))
    }

    /// Hash of what the scene says, in hexadecimal: arm, grid, obstacles and tasks, wherever they come from.
    #[getter]
    fn sha256<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyString>> {
        self.sha256.made(py, || self.hashed(py))
    }

    /// Return the scene whose links and obstacles are thicker by half of ``clearance`` (m) each: contact there is coming as near here.
    ///
    /// Raises:
    ///     BadSetting: The clearance is less than 0, or more than arm or obstacles can be thickened by.
    fn with_clearance<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = argument)] clearance: f64,
    ) -> PyResult<Bound<'py, Self>> {
        let refused =
            || errors::setting(py, "clearance", &PlanError::Clearance { clearance }.told(self.units()));
        let thicker = self.scene.with_clearance(clearance).ok_or_else(refused)?;
        Bound::new(py, Self::of(thicker, self.grid, self.units, None))
    }

    /// Return the clearance of each link from the obstacles at configurations ``q``, shape ``(n, joints)``, as an array
    /// of that shape (m); 0 or less in contact, infinite without obstacles. Joint limits do not matter.
    ///
    /// Raises:
    ///     BadSetting: ``q`` has not a column for each joint.
    fn link_clearances<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let configurations = configurations(q, self.scene.arm().links())?;
        let found: Vec<f64> =
            py.detach(|| configurations.iter().flat_map(|q| link_clearances(&self.scene, q)).collect());
        let shape = (configurations.len(), self.scene.arm().links());
        Ok(Array2::from_shape_fn(shape, |(i, j)| found[i * shape.1 + j]).into_pyarray(py))
    }

    /// Return the least clearance between links that have to keep clear of each other at configurations ``q``, shape
    /// ``(n, joints)``, one each (m); 0 or less in contact, infinite where there are no such links.
    ///
    /// Raises:
    ///     BadSetting: ``q`` has not a column for each joint.
    fn self_clearances<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let configurations = configurations(q, self.scene.arm().links())?;
        let found: Vec<f64> =
            py.detach(|| configurations.iter().map(|q| self_clearance(&self.scene, q)).collect());
        Ok(found.into_pyarray(py))
    }

    /// Return where the links end at configurations ``q``, shape ``(n, joints)``, as an array of shape ``(n, links, 2)``
    /// (m): the last is the tip.
    ///
    /// Raises:
    ///     BadSetting: ``q`` has not a column for each joint.
    fn link_ends<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let configurations = configurations(q, self.scene.arm().links())?;
        let arm = self.scene.arm();
        let ends: Vec<Point> = configurations.iter().flat_map(|q| arm.link_ends(q)).collect();
        let shape = (configurations.len(), arm.links(), 2);
        let at = |(i, link, axis): (usize, usize, usize)| {
            let end = ends[i * shape.1 + link];
            if axis == 0 { end.x } else { end.y }
        };
        Ok(Array3::from_shape_fn(shape, at).into_pyarray(py))
    }

    fn __repr__(&self) -> String {
        let file = self.source.as_ref().map_or_else(String::new, |source| format!(" {}", source.name()));
        let (links, obstacles) = (self.scene.arm().links(), self.scene.obstacles().len());
        let obstacles =
            if obstacles == 1 { "1 obstacle".to_owned() } else { format!("{obstacles} obstacles") };
        let names: Vec<&str> = self.scene.tasks().iter().map(|task| task.name.as_str()).collect();
        let tasks = match names.len() {
            0 => "no tasks".to_owned(),
            1 => format!("task {}", names[0]),
            count if count > MOST_SHOWN => format!("{count} tasks"),
            _ => format!("tasks {}", names.join(", ")),
        };
        format!("<Scene{file}: {links} links, {obstacles}, {tasks}>")
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords = Keywords::new(py)
            .with("arm", self.arm(py)?)?
            .with("grid", self.grid(py)?)?
            .with("obstacles", self.obstacles(py)?)?
            .with("tasks", self.tasks_by_name(py)?.copy()?)?;
        let keywords = match self.units == Units::default() {
            true => keywords,
            false => keywords.with("units", self.units.shown(py)?)?,
        };
        Ok(keywords.told())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let again = py.import("elbowroom._core")?.getattr("scene_again")?;
        let (_, keywords) = self.__getnewargs_ex__(py)?;
        (again, (keywords, self.file(), self.locations(py)?)).into_pyobject(py)
    }
}

/// Return the scene of these ``keywords`` that was read from ``file``, or made in code if that is ``None``.
///
/// Raises:
///     SceneError: The parts make no scene.
#[pyfunction]
pub(crate) fn scene_again<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    file: Option<String>,
    locations: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, Scene>> {
    let made = py.get_type::<Scene>().call((), Some(keywords))?.cast_into::<Scene>()?;
    let Some(file) = file else { return Ok(made) };
    let locations = locations.iter().map(|(end, at)| Ok((end.extract()?, at.extract()?)));
    let source = Source { file, locations: locations.collect::<PyResult<_>>()? };
    let again = made.get();
    Bound::new(py, Scene::of(again.scene.clone(), again.grid, again.units, Some(source)))
}
