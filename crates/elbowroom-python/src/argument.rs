//! Arguments from Python: what is of the wrong type is told in one line, with its name, what was given and what is needed.

use pyo3::PyTypeInfo;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;

/// Values that are told by their type instead from this many characters on.
const LONGEST_REPR: usize = 60;

/// What arguments are.
pub(crate) trait Argument {
    /// What is needed, in words.
    fn needed(py: Python<'_>) -> String;
}

macro_rules! needed {
    ($($kind:ty: $words:expr;)*) => {
        $(impl Argument for $kind {
            fn needed(_: Python<'_>) -> String {
                $words.to_owned()
            }
        })*
    };
}

needed! {
    f64: "a number";
    bool: "True or False";
    u64: "a whole number from 0 on";
    usize: "a whole number from 0 on";
    String: "a str";
    [f64; 2]: "a pair of numbers";
    Vec<f64>: "a list of numbers";
    Vec<[f64; 2]>: "a list of (x, y)";
    Vec<(f64, [f64; 2])>: "a list of (time, (x, y))";
}

impl<T: Argument> Argument for Option<T> {
    fn needed(py: Python<'_>) -> String {
        format!("{} or None", T::needed(py))
    }
}

impl<T: PyTypeInfo> Argument for Bound<'_, T> {
    fn needed(py: Python<'_>) -> String {
        T::type_object(py).name().map_or_else(|_| "another class".to_owned(), |name| name.to_string())
    }
}

impl<T: PyTypeInfo> Argument for Py<T> {
    fn needed(py: Python<'_>) -> String {
        Bound::<T>::needed(py)
    }
}

/// An argument's `value`. The error lacks its name, which `WrongType` has from the note that PyO3 adds.
pub(crate) fn argument<'py, T: Argument + FromPyObjectOwned<'py>>(value: &Bound<'py, PyAny>) -> PyResult<T> {
    value.extract().map_err(|error: T::Error| {
        let (error, py): (PyErr, _) = (error.into(), value.py());
        let is_of_type = error.is_instance_of::<PyTypeError>(py)
            || error.is_instance_of::<PyValueError>(py)
            || error.is_instance_of::<PyOverflowError>(py);
        if is_of_type { wrong_type(value, &T::needed(py)).unwrap_or(error) } else { error }
    })
}

/// [`argument`] for texts.
pub(crate) fn text<'a>(value: &'a Bound<'_, PyAny>) -> PyResult<&'a str> {
    match value.cast::<PyString>() {
        Ok(text) => text.to_str(),
        Err(_) => Err(wrong_type(value, &String::needed(value.py()))?),
    }
}

fn wrong_type(value: &Bound<'_, PyAny>, needed: &str) -> PyResult<PyErr> {
    let told = value.repr()?.to_string();
    let is_short = told.len() < LONGEST_REPR && !told.contains('\n');
    let found = if is_short { told } else { format!("of type {}", value.get_type().name()?) };
    let class = value.py().import("elbowroom._errors")?.getattr("WrongType")?;
    Ok(PyErr::from_value(class.call1((format!("is {found}; {needed} is needed"),))?))
}
