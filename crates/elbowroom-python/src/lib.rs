//! The Python border of `elbowroom`: conversion and error mapping, nothing else.

use pyo3::prelude::*;

#[pymodule]
mod _core {}
