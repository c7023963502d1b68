//! What a verdict on rows leaves open and what it lets pass: plain values, as Python shows them.

use elbowroom::verify::{self, Rate, Unknown};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::scene::Scene;

/// A rate that has a limit and was not judged: the rows do not tell it well enough. Attributes that do not go with its cause
/// are ``None``.
#[pyclass(frozen, eq, get_all, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct Unjudged {
    /// Which joint, 1 for the one at the base.
    joint: usize,
    /// ``velocity``, ``acceleration`` or ``jerk``.
    rate: &'static str,
    /// What is allowed (rad/s, rad/s² or rad/s³).
    limit: f64,
    /// Any motion through the rows, as far as they are rounded, reaches this much somewhere.
    at_least: f64,
    /// ``rounding`` of the rows, or their ``spacing``: the curve between them is a guess, and beyond the limit.
    cause: &'static str,
    /// How far apart the rows are (s).
    spacing: f64,
    /// What of the rows is rounded: ``position``, ``velocity`` or ``acceleration``.
    quantity: Option<&'static str>,
    /// To multiples of what (rad, rad/s or rad/s²).
    quantum: Option<f64>,
    /// How far off the rate may be for that.
    error: Option<f64>,
    /// What the curve between the rows reaches; ``None`` where the rate below it jumps.
    reached: Option<f64>,
    /// The same in words.
    message: String,
}

impl Unjudged {
    pub(crate) fn of(scene: &Scene, unjudged: &verify::Unjudged) -> Self {
        let verify::Unjudged { joint, rate, limit, at_least, cause } = *unjudged;
        let (spacing, quantity, quantum, error, reached) = match cause {
            Unknown::Rounding { what, quantum, spacing, error } => {
                (spacing, Some(what.name()), Some(quantum), Some(error), None)
            }
            Unknown::Spacing { spacing, reached } => (spacing, None, None, None, reached),
        };
        let (rate, cause, message) = (rate.name(), cause.name(), unjudged.told(scene.units()));
        Self { joint, rate, limit, at_least, cause, spacing, quantity, quantum, error, reached, message }
    }
}

#[pymethods]
impl Unjudged {
    /// Return what goes with its cause as a dictionary.
    pub(crate) fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let part = PyDict::new(py);
        part.set_item("joint", self.joint)?;
        part.set_item("rate", self.rate)?;
        part.set_item("limit", self.limit)?;
        part.set_item("at_least", self.at_least)?;
        part.set_item("cause", self.cause)?;
        part.set_item("spacing", self.spacing)?;
        if let Some(quantity) = self.quantity {
            part.set_item("quantity", quantity)?;
            part.set_item("quantum", self.quantum)?;
            part.set_item("error", self.error)?;
        } else {
            part.set_item("reached", self.reached)?;
        }
        part.set_item("message", &self.message)?;
        Ok(part)
    }

    fn __repr__(&self) -> String {
        format!("<Unjudged {}>", self.message)
    }
}

/// What is beyond a limit, and passed.
#[pyclass(frozen, eq, get_all, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct Allowed {
    /// Which joint, 1 for the one at the base.
    joint: usize,
    /// ``position``, ``velocity``, ``acceleration`` or ``jerk``.
    what: &'static str,
    /// What the curve between the rows reaches (rad, rad/s, rad/s² or rad/s³).
    value: f64,
    /// What is allowed.
    limit: f64,
    /// For what it passed: the ``rounding`` of the rows, their ``spacing`` (no motion through them has to reach it), or the
    /// ``tolerance`` that was asked for.
    by: &'static str,
    /// The same in words.
    message: String,
}

impl Allowed {
    pub(crate) fn of(scene: &Scene, allowed: &verify::Allowed) -> Self {
        let verify::Allowed { joint, rate, value, limit, by } = *allowed;
        let what = rate.map_or("position", Rate::name);
        Self { joint, what, value, limit, by: by.name(), message: allowed.told(scene.units()) }
    }
}

#[pymethods]
impl Allowed {
    /// Return it as a dictionary.
    pub(crate) fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let part = PyDict::new(py);
        part.set_item("joint", self.joint)?;
        part.set_item("what", self.what)?;
        part.set_item("value", self.value)?;
        part.set_item("limit", self.limit)?;
        part.set_item("by", self.by)?;
        part.set_item("message", &self.message)?;
        Ok(part)
    }

    fn __repr__(&self) -> String {
        format!("<Allowed {}>", self.message)
    }
}
