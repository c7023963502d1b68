use elbowroom::arm::{self, JointLimits, MotionLimits};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::part::{Keywords, NewArgs, Part, each_of_class, hash_of, made, number, pair, point};
use crate::argument::argument;
use crate::errors;
use crate::once::Once;

/// Where a joint may turn, and how fast: without limits if ``continuous``, else from ``min`` to ``max``, ends included.
///
/// Args:
///     continuous: Whether it turns without limits.
///     min: Its lower limit (rad).
///     max: Its upper limit (rad).
///     velocity: Its greatest (rad/s); None, as of the next two, where none is stated.
///     acceleration: Its greatest (rad/s²).
///     jerk: Its greatest (rad/s³).
///
/// Raises:
///     SceneError: The numbers make no joint.
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
#[derive(PartialEq)]
pub(crate) struct Joint {
    joint: arm::Joint,
}

#[pymethods]
impl Joint {
    #[new]
    #[pyo3(signature = (*, continuous=false, min=None, max=None, velocity=None, acceleration=None, jerk=None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] continuous: bool,
        #[pyo3(from_py_with = argument)] min: Option<f64>,
        #[pyo3(from_py_with = argument)] max: Option<f64>,
        #[pyo3(from_py_with = argument)] velocity: Option<f64>,
        #[pyo3(from_py_with = argument)] acceleration: Option<f64>,
        #[pyo3(from_py_with = argument)] jerk: Option<f64>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let limits = match (continuous, min, max) {
            (true, None, None) => JointLimits::Continuous,
            (false, Some(min), Some(max)) => {
                JointLimits::range(min, max).map_err(|error| errors::part(py, "joint", &error.to_string()))?
            }
            _ => return Err(errors::part(py, "joint", "either continuous=True, or min and max")),
        };
        let motion = MotionLimits { velocity, acceleration, jerk };
        let refused = |error: arm::MotionLimitError| {
            errors::part(py, &format!("joint.{}", error.rate), &error.to_string())
        };
        motion.check().map_err(refused)?;
        Ok(made(Self { joint: arm::Joint { limits, motion } }))
    }

    /// Whether it turns without limits.
    #[getter]
    fn continuous(&self) -> bool {
        matches!(self.joint.limits, JointLimits::Continuous)
    }

    /// Its lower limit (rad); ``None`` if it has none.
    #[getter]
    fn min(&self) -> Option<f64> {
        self.stops().map(|[min, _]| min)
    }

    /// Its upper limit (rad); ``None`` if it has none.
    #[getter]
    fn max(&self) -> Option<f64> {
        self.stops().map(|[_, max]| max)
    }

    /// Its greatest velocity (rad/s); ``None`` where none is stated.
    #[getter]
    fn velocity(&self) -> Option<f64> {
        self.joint.motion.velocity
    }

    /// Its greatest acceleration (rad/s²); ``None`` where none is stated.
    #[getter]
    fn acceleration(&self) -> Option<f64> {
        self.joint.motion.acceleration
    }

    /// Its greatest jerk (rad/s³); ``None`` where none is stated.
    #[getter]
    fn jerk(&self) -> Option<f64> {
        self.joint.motion.jerk
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of(slf)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords = Keywords::new(py)
            .unless(false, "continuous", self.continuous())?
            .some("min", self.min())?
            .some("max", self.max())?
            .some("velocity", self.velocity())?
            .some("acceleration", self.acceleration())?
            .some("jerk", self.jerk())?;
        Ok(keywords.told())
    }
}

impl Joint {
    fn stops(&self) -> Option<[f64; 2]> {
        match self.joint.limits {
            JointLimits::Continuous => None,
            JointLimits::Range { min, max } => Some([number(min), number(max)]),
        }
    }
}

/// A planar arm: two or more links end to end on a fixed base, capsules of one half width, a joint at the start of each.
///
/// Args:
///     links: Their lengths, base first (m).
///     joints: One each, base first.
///     half_width: Radius of the capsules (m).
///     base: Where the first joint turns (m).
///     self_collision: Whether links that are not neighbours must keep clear of each other.
///
/// Raises:
///     SceneError: The measures make no arm.
#[pyclass(frozen, eq, extends = Part, module = "elbowroom._core")]
pub(crate) struct Arm {
    arm: arm::Arm,
    joints: Once<PyTuple>,
}

impl PartialEq for Arm {
    fn eq(&self, other: &Self) -> bool {
        self.arm == other.arm
    }
}

impl Arm {
    pub(crate) fn of<'py>(py: Python<'py>, arm: &arm::Arm) -> PyResult<Bound<'py, Self>> {
        Bound::new(py, made(Self { arm: arm.clone(), joints: Once::new() }))
    }

    pub(crate) fn arm(&self) -> &arm::Arm {
        &self.arm
    }
}

#[pymethods]
impl Arm {
    #[new]
    #[pyo3(signature = (*, links, joints, half_width=0.0, base=[0.0, 0.0], self_collision=false))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = argument)] links: Vec<f64>,
        joints: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = argument)] half_width: f64,
        #[pyo3(from_py_with = argument)] base: [f64; 2],
        #[pyo3(from_py_with = argument)] self_collision: bool,
    ) -> PyResult<PyClassInitializer<Self>> {
        let joints = each_of_class::<Joint>(joints, "joints")?;
        let joints = joints.iter().map(|joint| joint.get().joint).collect();
        arm::Arm::new(point(base), links, half_width, joints, self_collision)
            .map(|arm| made(Self { arm, joints: Once::new() }))
            .map_err(|error| errors::part(py, "arm", &error.to_string()))
    }

    /// Lengths of the links, base first (m).
    #[getter]
    fn links<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.arm.lengths())
    }

    /// The joints, base first: as many as links.
    #[getter]
    fn joints<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        self.joints.made(py, || {
            let joints = self.arm.joints().iter().map(|&joint| Bound::new(py, made(Joint { joint })));
            PyTuple::new(py, joints.collect::<PyResult<Vec<_>>>()?)
        })
    }

    /// Radius of the capsules around the links (m).
    #[getter]
    fn half_width(&self) -> f64 {
        number(self.arm.half_width())
    }

    /// Where the first joint turns (m).
    #[getter]
    fn base(&self) -> (f64, f64) {
        pair(self.arm.base())
    }

    /// Whether links that are not neighbours must keep clear of each other.
    #[getter]
    fn self_collision(&self) -> bool {
        self.arm.self_collision()
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of(slf)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArgs<'py>> {
        let keywords = Keywords::new(py)
            .with("links", self.links(py)?)?
            .with("joints", self.joints(py)?)?
            .unless(0.0, "half_width", self.half_width())?
            .unless((0.0, 0.0), "base", self.base())?
            .unless(false, "self_collision", self.self_collision())?;
        Ok(keywords.told())
    }
}
