//! What is made when it is first asked for.

use numpy::ndarray::{Array, Dimension};
use numpy::{IntoPyArray, PyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

/// A value made once, that nobody can write to: everyone who asks is handed the same.
pub(crate) struct Once<A>(PyOnceLock<Py<A>>);

impl<A> Once<A> {
    pub(crate) const fn new() -> Self {
        Self(PyOnceLock::new())
    }
}

impl<D: Dimension> Once<PyArray<f64, D>> {
    pub(crate) fn get<'py>(
        &self,
        py: Python<'py>,
        make: impl FnOnce() -> Array<f64, D>,
    ) -> Bound<'py, PyArray<f64, D>> {
        let made = self.0.get_or_init(py, || {
            let array = make().into_pyarray(py);
            array.readwrite().make_nonwriteable();
            array.unbind()
        });
        made.bind(py).clone()
    }
}

impl<A> Once<A> {
    /// The value, of any kind that cannot be written to or is not handed out itself.
    pub(crate) fn made<'py>(
        &self,
        py: Python<'py>,
        make: impl FnOnce() -> PyResult<Bound<'py, A>>,
    ) -> PyResult<Bound<'py, A>> {
        self.0.get_or_try_init(py, || make().map(Bound::unbind)).map(|made| made.bind(py).clone())
    }
}
