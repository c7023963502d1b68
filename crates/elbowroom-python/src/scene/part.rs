use elbowroom::geometry::Point;
use pyo3::PyClass;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// So many members of a tuple are shown by `repr`.
const MOST_SHOWN: usize = 4;

/// A value that is made with keywords, never changes, and tells the keywords it can be made anew with.
#[pyclass(frozen, subclass, module = "elbowroom._core")]
pub(crate) struct Part;

#[pymethods]
impl Part {
    /// Return the same but for ``changes``, keywords of its class.
    ///
    /// Raises:
    ///     SceneError: What comes of it makes no sense.
    #[pyo3(signature = (**changes))]
    fn replace<'py>(
        slf: &Bound<'py, Self>,
        changes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let keywords = keywords_of(slf)?;
        if let Some(changes) = changes {
            keywords.update(changes.as_mapping())?;
        }
        slf.get_type().call((), Some(&keywords))
    }

    /// Return the same but for ``changes``: ``copy.replace`` asks for it.
    #[pyo3(signature = (**changes))]
    fn __replace__<'py>(
        slf: &Bound<'py, Self>,
        changes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        Self::replace(slf, changes)
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let keywords = keywords_of(slf)?;
        let told = keywords
            .iter()
            .map(|(name, value)| Ok(format!("{name}={}", in_short(&value)?)))
            .collect::<PyResult<Vec<_>>>()?;
        Ok(format!("{}({})", slf.get_type().name()?, told.join(", ")))
    }
}

/// How Python's `value` is made.
pub(crate) fn made<T: PyClass<BaseType = Part>>(value: T) -> PyClassInitializer<T> {
    PyClassInitializer::from(Part).add_subclass(value)
}

/// The `value` called `key`, which has to be of the class `T`.
pub(crate) fn of_class<'py, T: PyClass>(value: Bound<'py, PyAny>, key: &str) -> PyResult<Bound<'py, T>> {
    value.cast_into().map_err(|error| {
        let value = error.into_inner();
        let needed = value.py().get_type::<T>();
        match (value.repr(), needed.name()) {
            (Ok(found), Ok(name)) => PyTypeError::new_err(format!("{key} is {found}; {name} is needed")),
            (Err(error), _) | (_, Err(error)) => error,
        }
    })
}

/// The members of `values`, called `key`, which have to be of the class `T`.
pub(crate) fn each_of_class<'py, T: PyClass>(
    values: &Bound<'py, PyAny>,
    key: &str,
) -> PyResult<Vec<Bound<'py, T>>> {
    values.try_iter()?.enumerate().map(|(i, value)| of_class(value?, &format!("{key}[{i}]"))).collect()
}

/// What `__getnewargs_ex__` returns.
pub(crate) type NewArgs<'py> = ((), Bound<'py, PyDict>);

/// The keywords that a part can be made anew with: without those that are as they are by default, so that a key that is new
/// changes nothing for scenes without it, nor for those that were pickled before.
pub(crate) struct Keywords<'py>(Bound<'py, PyDict>);

impl<'py> Keywords<'py> {
    pub(crate) fn new(py: Python<'py>) -> Self {
        Self(PyDict::new(py))
    }

    pub(crate) fn with(self, name: &str, value: impl IntoPyObject<'py>) -> PyResult<Self> {
        self.0.set_item(name, value)?;
        Ok(self)
    }

    /// With `value`, unless it is the default.
    pub(crate) fn unless<T: IntoPyObject<'py> + PartialEq>(
        self,
        default: T,
        name: &str,
        value: T,
    ) -> PyResult<Self> {
        if value == default { Ok(self) } else { self.with(name, value) }
    }

    /// With `value`, if there is one.
    pub(crate) fn some(self, name: &str, value: Option<impl IntoPyObject<'py>>) -> PyResult<Self> {
        match value {
            Some(value) => self.with(name, value),
            None => Ok(self),
        }
    }

    pub(crate) fn told(self) -> NewArgs<'py> {
        ((), self.0)
    }
}

/// The keywords that `part` can be made anew with.
pub(crate) fn keywords_of<'py>(part: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
    let told = part.call_method0("__getnewargs_ex__")?;
    Ok(told.get_item(1)?.cast_into::<PyDict>()?)
}

/// Of the keywords: equal parts have the same.
pub(crate) fn hash_of(part: &Bound<'_, PyAny>) -> PyResult<isize> {
    let keywords = keywords_of(part)?;
    PyTuple::new(part.py(), keywords.iter())?.hash()
}

/// What `repr` says, but of long tuples.
fn in_short(value: &Bound<'_, PyAny>) -> PyResult<String> {
    let Ok(members) = value.cast::<PyTuple>() else { return Ok(value.repr()?.to_string()) };
    let shown = members.iter().take(MOST_SHOWN).map(|one| in_short(&one)).collect::<PyResult<Vec<_>>>()?;
    let rest = match members.len() {
        1 => ",".to_owned(),
        count if count > MOST_SHOWN => format!(", ... {count} in all"),
        _ => String::new(),
    };
    Ok(format!("({}{rest})", shown.join(", ")))
}

/// `value` as Python is told: -0 is equal to 0, and so told as 0.
pub(crate) fn number(value: f64) -> f64 {
    value + 0.0
}

/// Coordinates as Python is told.
pub(crate) fn pair(point: Point) -> (f64, f64) {
    (number(point.x), number(point.y))
}

/// The point with these coordinates.
pub(crate) fn point([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}
