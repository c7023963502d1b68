use numpy::{AllowTypeChange, PyArrayLike1, PyArrayLike2};
use pyo3::prelude::*;

use crate::errors;

/// The rows of Python's `q`, configurations of so many `joints`.
pub(super) fn configurations(q: &Bound<'_, PyAny>, joints: usize) -> PyResult<Vec<Vec<f64>>> {
    let refused = |what: &str| {
        let message = format!("q {what}; rows of {joints} joint angles are needed, [[...]] for one");
        errors::setting(q.py(), "q", &message)
    };
    let rows = match q.extract::<PyArrayLike2<'_, f64, AllowTypeChange>>() {
        Ok(rows) => rows,
        Err(_) if q.extract::<PyArrayLike1<'_, f64, AllowTypeChange>>().is_ok() => {
            return Err(refused("is a single row"));
        }
        Err(_) => return Err(refused("is no array of numbers")),
    };
    if rows.as_array().ncols() != joints {
        return Err(refused(&format!("has {} columns", rows.as_array().ncols())));
    }
    Ok(rows.as_array().rows().into_iter().map(|row| row.to_vec()).collect())
}
