use std::path::Path;

use elbowroom::scene::SceneFile;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The text that a scene was read from.
#[derive(Clone)]
pub(crate) struct Source {
    /// What it is called.
    pub(crate) file: String,
    /// Where it has each task's "start" and "goal": line and column, from 1.
    pub(crate) locations: Vec<((String, String), (usize, usize))>,
}

impl Source {
    pub(crate) fn of(read: &SceneFile, file: &str) -> Self {
        let locations = read.scene.tasks().iter().flat_map(|task| {
            let name = &task.name;
            let ends = [("start", read.locations.start(name)), ("goal", read.locations.goal(name))];
            ends.map(|(end, at)| at.map(|at| ((name.clone(), end.to_owned()), (at.line, at.column))))
        });
        Self { file: file.to_owned(), locations: locations.flatten().collect() }
    }

    /// The file without its folders.
    pub(crate) fn name(&self) -> &str {
        Path::new(&self.file).file_name().and_then(|name| name.to_str()).unwrap_or(&self.file)
    }

    pub(crate) fn locations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let places = PyDict::new(py);
        for (end, at) in &self.locations {
            places.set_item(end.clone(), at)?;
        }
        Ok(places)
    }
}

/// The text of the scene file at `path`: `elbowroom._scene.text_of`.
pub(crate) fn text_of(path: &Bound<'_, PyAny>) -> PyResult<String> {
    path.py().import("elbowroom._scene")?.call_method1("text_of", (path,))?.extract()
}

/// The text of the example called `name`: `elbowroom._scene.example_text`.
pub(crate) fn example_text(py: Python<'_>, name: &str) -> PyResult<String> {
    py.import("elbowroom._scene")?.call_method1("example_text", (name,))?.extract()
}
