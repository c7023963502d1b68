use elbowroom::units::{self, AngleUnit, LengthUnit};
use pyo3::prelude::*;

use super::part::{Keywords, NewArgs, Part, hash_of, made};
use crate::argument::text;
use crate::errors;

/// The units that texts and pictures tell lengths and angles in; all attributes are in metres and radians whatever they are.
///
/// Args:
///     length: ``m``, ``cm`` or ``mm``.
///     angle: ``rad`` or ``deg``.
///
/// Raises:
///     SceneError: There is no such unit.
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
#[derive(Clone, Copy, PartialEq, Default)]
pub(crate) struct Units(units::Units);

impl From<units::Units> for Units {
    fn from(units: units::Units) -> Self {
        Self(units)
    }
}

impl Units {
    pub(crate) fn units(&self) -> units::Units {
        self.0
    }

    pub(crate) fn shown(self, py: Python<'_>) -> PyResult<Bound<'_, Self>> {
        Bound::new(py, made(self))
    }
}

#[pymethods]
impl Units {
    #[new]
    #[pyo3(signature = (*, length="m", angle="rad"))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = text)] length: &str,
        #[pyo3(from_py_with = text)] angle: &str,
    ) -> PyResult<PyClassInitializer<Self>> {
        let lengths = LengthUnit::ALL.into_iter().find(|unit| unit.name() == length);
        let angles = AngleUnit::ALL.into_iter().find(|unit| unit.name() == angle);
        match (lengths, angles) {
            (Some(length), Some(angle)) => Ok(made(Self(units::Units { length, angle }))),
            (None, _) => {
                Err(errors::part(py, "units.length", &format!("found {length}; allowed: m, cm, mm")))
            }
            (_, None) => Err(errors::part(py, "units.angle", &format!("found {angle}; allowed: rad, deg"))),
        }
    }

    /// What the unit of lengths is called.
    #[getter]
    fn length(&self) -> &str {
        self.0.length.name()
    }

    /// What the unit of angles is called.
    #[getter]
    fn angle(&self) -> &str {
        self.0.angle.name()
    }

    /// How many of the unit of lengths make a metre.
    #[getter]
    fn per_metre(&self) -> f64 {
        self.0.length.per_metre()
    }

    /// How many of the unit of angles make a radian.
    #[getter]
    fn per_radian(&self) -> f64 {
        self.0.of_radians(1.0)
    }

    /// Return the unit of the derivative of an angle of this ``order``: 0 for the angle itself, 3 for jerk.
    fn rate_unit(&self, order: usize) -> String {
        self.0.rate_name(order)
    }

    /// Return a length that was measured (m) as text, to three digits that count.
    fn measured_length(&self, metres: f64) -> String {
        self.0.length(metres)
    }

    /// Return an angle that was measured (rad) as text, to three digits that count; with an ``order`` one of its
    /// derivatives.
    #[pyo3(signature = (radians, *, order=0))]
    fn measured_angle(&self, radians: f64, order: usize) -> String {
        self.0.rate(radians, order)
    }

    /// Return a length that somebody stated (m) as text, to six digits that count.
    fn stated_length(&self, metres: f64) -> String {
        self.0.stated_length(metres)
    }

    /// Return an angle that somebody stated (rad) as text, to six digits that count; with an ``order`` one of its
    /// derivatives.
    #[pyo3(signature = (radians, *, order=0))]
    fn stated_angle(&self, radians: f64, order: usize) -> String {
        format!("{} {}", units::stated(self.0.of_radians(radians)), self.0.rate_name(order))
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        hash_of(&self.shown(py)?.into_any())
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords = Keywords::new(py).with("length", self.length())?.with("angle", self.angle())?;
        Ok(keywords.told())
    }
}

/// Return a number that was measured as text, to three digits that count.
#[pyfunction]
pub(crate) fn measured(number: f64) -> String {
    units::measured(number)
}

/// Return a number that somebody stated as text, to six digits that count, without zeros after them.
#[pyfunction]
pub(crate) fn stated(number: f64) -> String {
    units::stated(number)
}
