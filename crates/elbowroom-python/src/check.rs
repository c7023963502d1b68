use std::sync::Arc;

use elbowroom::planning::Monitor;
use elbowroom::trajectory::{self, Samples, interpolate};
use elbowroom::verify::{
    End, Quantity, Rows, Verdict as Found, VerifySettings, Violation, verify_rows, verify_until,
};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::argument::argument;
use crate::errors;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::verdict::{Asked, Verdict};
use crate::watch;

/// What was taken between the rows of a trajectory, and so what must not jump between the pieces.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Curve {
    Linear,
    Cubic,
    Quintic,
}

/// What is asked of a trajectory, besides to keep clear of everything and within all limits.
#[derive(Clone, PartialEq)]
pub(crate) struct Terms {
    /// Between its rows.
    pub(crate) curve: Curve,
    /// Clearance to keep (m).
    pub(crate) margin: f64,
    /// The first and the last curve of one that is to begin and end at rest.
    pub(crate) at_rest: Option<[Curve; 2]>,
    /// How long before its beginning the arm is on its way there, which nobody has told (s).
    pub(crate) lead: f64,
    /// How the rows were written that it interpolates; `None` for a motion that is told as it is.
    pub(crate) rows: Option<Rows>,
}

/// How rows were written: the curve between all of them, the quanta of each joint, that of times, and the tolerance of limits.
pub(crate) type ToldRows = (Option<String>, Vec<[f64; 3]>, f64, f64);

/// Terms as pickles keep them.
pub(crate) type Told = (String, f64, Option<(String, String)>, f64, Option<ToldRows>);

impl Terms {
    /// Of a planned motion: at rest it is because it does its task.
    pub(crate) const PLANNED: Self =
        Self { curve: Curve::Quintic, margin: 0.0, at_rest: None, lead: 0.0, rows: None };

    pub(crate) fn told(&self) -> Told {
        let named = |curve: Curve| curve.name().to_owned();
        (
            named(self.curve),
            self.margin,
            self.at_rest.map(|[first, last]| (named(first), named(last))),
            self.lead,
            self.rows.as_ref().map(told_rows),
        )
    }

    pub(crate) fn read(py: Python<'_>, (curve, margin, at_rest, lead, rows): &Told) -> PyResult<Self> {
        let named = |(first, last): &(String, String)| -> PyResult<[Curve; 2]> {
            Ok([Curve::named(py, first)?, Curve::named(py, last)?])
        };
        let curve = Curve::named(py, curve)?;
        let at_rest = at_rest.as_ref().map(named).transpose()?;
        let rows = rows.as_ref().map(|rows| read_rows(py, rows)).transpose()?;
        Ok(Self { curve, margin: *margin, at_rest, lead: *lead, rows })
    }

    fn settings(&self) -> VerifySettings {
        // Motions as fast as their acceleration allows begin with it at once; only a limit on the jerk forbids that.
        let end = |curve: Curve| End::AtRest(curve.continuous().min(Quantity::Velocity));
        VerifySettings {
            margin: self.margin,
            continuous: self.curve.continuous(),
            ends: self.at_rest.map_or([End::Open; 2], |ends| ends.map(end)),
            ..VerifySettings::default()
        }
    }
}

fn told_rows(rows: &Rows) -> ToldRows {
    let curve = rows.curve.map(|curve| curve.name().to_owned());
    (curve, rows.quanta.clone(), rows.time_quantum, rows.tolerance)
}

fn read_rows(py: Python<'_>, (curve, quanta, time_quantum, tolerance): &ToldRows) -> PyResult<Rows> {
    if !(tolerance.is_finite() && *tolerance >= 0.0) {
        let message = format!("limit_tolerance is {tolerance}; it must be finite and 0 or more");
        return Err(errors::setting(py, "limit_tolerance", &message));
    }
    let curve = curve.as_ref().map(|name| Curve::named(py, name)).transpose()?.map(Curve::taken);
    Ok(Rows { curve, quanta: quanta.clone(), time_quantum: *time_quantum, tolerance: *tolerance })
}

impl Curve {
    const fn taken(self) -> trajectory::Curve {
        match self {
            Self::Linear => trajectory::Curve::Linear,
            Self::Cubic => trajectory::Curve::Cubic,
            Self::Quintic => trajectory::Curve::Quintic,
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
        }
    }

    pub(crate) fn named(py: Python<'_>, name: &str) -> PyResult<Self> {
        [Self::Linear, Self::Cubic, Self::Quintic].into_iter().find(|curve| curve.name() == name).ok_or_else(
            || {
                let message = format!("no curve is called '{name}'; linear, cubic or quintic");
                errors::setting(py, "curve", &message)
            },
        )
    }

    const fn of(curve: trajectory::Curve) -> Self {
        match curve {
            trajectory::Curve::Linear => Self::Linear,
            trajectory::Curve::Cubic => Self::Cubic,
            trajectory::Curve::Quintic => Self::Quintic,
        }
    }

    const fn continuous(self) -> Quantity {
        match self {
            Self::Linear => Quantity::Position,
            Self::Cubic => Quantity::Velocity,
            Self::Quintic => Quantity::Acceleration,
        }
    }
}

/// The verifier's answer on a trajectory; ``bool(check)`` is whether it is proved to be safe.
///
/// The verifier alone makes them. One that is unpickled has been made anew: the trajectory is verified again.
#[pyclass(frozen, eq, module = "elbowroom._core")]
pub(crate) struct Check {
    motion: Py<Motion>,
    curve: Curve,
    verdict: Py<Verdict>,
}

impl PartialEq for Check {
    fn eq(&self, other: &Self) -> bool {
        self.curve == other.curve
            && self.motion.get() == other.motion.get()
            && self.verdict.get() == other.verdict.get()
    }
}

impl Check {
    /// What `verdict` is about with it; `None` for one that does not know.
    fn of(py: Python<'_>, verdict: Py<Verdict>) -> PyResult<Option<Self>> {
        let Some(asked) = verdict.get().asked() else { return Ok(None) };
        let motion = Py::new(py, Motion::from(Arc::clone(&asked.motion)))?;
        Ok(Some(Self { motion, curve: asked.terms.curve, verdict }))
    }
}

#[pymethods]
impl Check {
    /// The trajectory as polynomials.
    #[getter]
    fn motion(&self, py: Python<'_>) -> Py<Motion> {
        self.motion.clone_ref(py)
    }

    /// What was taken between its rows: ``linear`` for positions alone, ``cubic`` with velocities, ``quintic`` with
    /// accelerations too. What such curves let jump by their nature, the velocity of a linear one, is compared with a
    /// joint only if a rate above it is limited, and not where the rows are samples.
    #[getter]
    fn curve(&self) -> &'static str {
        self.curve.name()
    }

    /// What the verifier says.
    #[getter]
    fn verdict(&self, py: Python<'_>) -> Py<Verdict> {
        self.verdict.clone_ref(py)
    }

    /// Whether the trajectory is proved to be safe.
    #[getter]
    fn safe(&self) -> bool {
        self.verdict.get().safe()
    }

    fn __bool__(&self) -> bool {
        self.safe()
    }

    fn __repr__(&self) -> String {
        format!("<Check of a {} trajectory: {}>", self.curve.name(), self.verdict.get().in_words())
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let again = py.import("elbowroom._core")?.getattr("check_again")?;
        (again, (self.verdict.bind(py),)).into_pyobject(py)
    }
}

/// Return the check that ``verdict`` is of.
///
/// Raises:
///     BadSetting: It is a replanner's, which does not know what it is about.
#[pyfunction]
pub(crate) fn check_again(py: Python<'_>, verdict: Py<Verdict>) -> PyResult<Check> {
    Check::of(py, verdict)?
        .ok_or_else(|| errors::setting(py, "verdict", "a replanner's verdict is of no trajectory"))
}

/// Return the motion through samples, and the curves taken between them, each ``linear``, ``cubic`` or ``quintic``: the least
/// of all, the first and the last.
///
/// ``stated`` says of each row how much of it counts: 0 for its positions alone, 1 with velocities, 2 with accelerations.
///
/// Raises:
///     TrajectoryError: The samples make no motion.
#[pyfunction]
#[pyo3(signature = (times, positions, velocities=None, accelerations=None, stated=None))]
pub(crate) fn interpolated(
    py: Python<'_>,
    times: PyReadonlyArray1<'_, f64>,
    positions: PyReadonlyArray2<'_, f64>,
    velocities: Option<PyReadonlyArray2<'_, f64>>,
    accelerations: Option<PyReadonlyArray2<'_, f64>>,
    stated: Option<PyReadonlyArray1<'_, i64>>,
) -> PyResult<(Motion, &'static str, (&'static str, &'static str))> {
    let known = |values: PyReadonlyArray2<'_, f64>, least: i64| {
        let mut rows = rows(&values);
        if let Some(stated) = &stated {
            rows.iter_mut()
                .zip(stated.as_array())
                .filter(|(_, of)| **of < least)
                .for_each(|(row, _)| row.clear());
        }
        rows
    };
    let samples = Samples {
        times: times.as_array().to_vec(),
        positions: rows(&positions),
        velocities: velocities.map(|values| known(values, 1)),
        accelerations: accelerations.map(|values| known(values, 2)),
    };
    let found = interpolate(&samples).map_err(|error| errors::trajectory(py, &error.to_string()))?;
    let [first, last] = found.ends.map(trajectory::Curve::name);
    Ok((found.motion.into(), Curve::of(found.least).name(), (first, last)))
}

/// Return the verifier's answer on ``motion`` in ``scene``.
///
/// ``curve`` says what must not jump between its pieces, ``at_rest`` the first and the last curve of one that is to begin and
/// end at rest, ``lead`` how long before it the arm is on its way to its beginning (s), which is not judged. ``rows`` says how the
/// rows were written that it interpolates: the curve between all of them, or None where that differs; to multiples of what the
/// positions, velocities and accelerations of each joint are rounded, and times; and by what share motion limits may be exceeded.
///
/// Raises:
///     TrajectoryError: It is no motion of this arm.
///     TimedOut: The timeout came first.
///     BadSetting: A setting makes no sense.
#[pyfunction]
#[pyo3(signature = (scene, motion, *, curve, margin, at_rest=None, lead=0.0, rows=None, timeout=None))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn verify(
    py: Python<'_>,
    #[pyo3(from_py_with = argument)] scene: Py<Scene>,
    motion: Py<Motion>,
    curve: String,
    margin: f64,
    at_rest: Option<(String, String)>,
    lead: f64,
    rows: Option<ToldRows>,
    #[pyo3(from_py_with = argument)] timeout: Option<f64>,
) -> PyResult<Check> {
    let terms = Terms::read(py, &(curve, margin, at_rest, lead, rows))?;
    let curve = terms.curve;
    let verdict = judged(py, &scene, motion.get(), terms, timeout)?;
    Ok(Check { motion, curve, verdict: Py::new(py, verdict)? })
}

/// The verdict on `motion` in `scene`.
pub(crate) fn judged(
    py: Python<'_>,
    scene: &Py<Scene>,
    motion: &Motion,
    terms: Terms,
    timeout: Option<f64>,
) -> PyResult<Verdict> {
    let core = scene.get();
    let motion = &motion.motion;
    let (joints, moved) = (core.scene.arm().links(), motion.joints());
    if joints != moved {
        let message = format!("it moves {moved} joints; the arm of the scene has {joints}");
        return Err(errors::trajectory(py, &message));
    }
    let margin = terms.margin;
    if !(margin.is_finite() && margin >= 0.0) {
        return Err(errors::setting(
            py,
            "margin",
            &format!("margin is {}, it must be finite and not negative", core.units().stated_length(margin)),
        ));
    }
    let settings = terms.settings();
    let (mut found, _) = watch::run(py, timeout, None, |watch| {
        let keep_going = || watch.keep_going();
        match &terms.rows {
            Some(rows) => verify_rows(&core.scene, motion, rows, &settings, &keep_going),
            None => verify_until(&core.scene, motion, &settings, &keep_going),
        }
    })?;
    if was_stopped(&found) {
        return Err(errors::timed_out(py, timeout));
    }
    if terms.lead != 0.0 {
        let (lead, time) = (terms.lead, motion.start());
        found.violations.insert(0, Violation::NotJudged { lead, time });
    }
    let asked = Asked { scene: scene.clone_ref(py), motion: Arc::clone(motion), terms };
    Ok(Verdict::new(core, &found, Some(asked)))
}

fn was_stopped(found: &Found) -> bool {
    found.violations.iter().any(|violation| matches!(violation, Violation::Stopped { .. }))
}

fn rows(values: &PyReadonlyArray2<'_, f64>) -> Vec<Vec<f64>> {
    values.as_array().rows().into_iter().map(|row| row.to_vec()).collect()
}
