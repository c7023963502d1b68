//! What a verdict is made of: plain values, one class a kind.

use elbowroom::scene::obstacle_in_words;
use elbowroom::units::short;
use elbowroom::verify::{self, Against};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::scene::Scene;

/// What a link is up against: an obstacle, from 0, and its name, or another link, from 1.
#[derive(Clone, PartialEq)]
pub(crate) struct Other {
    obstacle: Option<usize>,
    name: Option<String>,
    link: Option<usize>,
}

impl Other {
    fn of(scene: &Scene, against: Against) -> Self {
        match against {
            Against::Obstacle(index) => {
                let name = scene.obstacle_name(index).map(str::to_owned);
                Self { obstacle: Some(index), name, link: None }
            }
            Against::Link(link) => Self { obstacle: None, name: None, link: Some(link) },
        }
    }

    fn put_into(&self, part: &Bound<'_, PyDict>) -> PyResult<()> {
        match (self.obstacle, self.link) {
            (Some(obstacle), _) => {
                part.set_item("obstacle", obstacle)?;
                part.set_item("name", self.name.as_deref())
            }
            (None, Some(link)) => part.set_item("other_link", link),
            (None, None) => Ok(()),
        }
    }

    fn in_words(&self) -> String {
        match (self.obstacle, self.link) {
            (Some(obstacle), _) => obstacle_in_words(obstacle, self.name.as_deref()),
            (None, Some(link)) => format!("link {link}"),
            (None, None) => "nothing".to_owned(),
        }
    }
}

/// A reason why a motion is not safe: the first or worst of its kind for each joint, or for each link and what it is up
/// against. Attributes that do not go with its kind are ``None``.
#[pyclass(frozen, eq, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct Violation {
    /// ``contact``, ``undecided``, ``joint_limit``, ``velocity_limit``, ``acceleration_limit``, ``jerk_limit``,
    /// ``position_jump``, ``velocity_jump``, ``acceleration_jump``, ``moving_start``, ``moving_end``, ``not_judged``, ``too_large``, ``other_arm`` or ``stopped``.
    #[pyo3(get)]
    kind: String,
    /// The same in words.
    #[pyo3(get)]
    message: String,
    /// When (s).
    #[pyo3(get)]
    time: f64,
    /// Which joint, 1 for the one at the base.
    #[pyo3(get)]
    joint: Option<usize>,
    /// Which link, 1 for the one at the base.
    #[pyo3(get)]
    link: Option<usize>,
    /// How much the clearance falls short of what was asked for (m).
    #[pyo3(get)]
    depth: Option<f64>,
    /// What the joint comes to, by how much it jumps or what it still moves at (rad, rad/s, rad/s², rad/s³); how long is not
    /// judged (s).
    #[pyo3(get)]
    value: Option<f64>,
    /// What is allowed.
    #[pyo3(get)]
    limit: Option<f64>,
    other: Option<Other>,
}

impl Violation {
    /// Of a motion in `scene` that was to keep a clearance of `margin` (m).
    pub(crate) fn of(scene: &Scene, margin: f64, violation: &verify::Violation) -> Self {
        use verify::Violation as Kind;
        let blank = |kind: &str| Self {
            kind: kind.to_owned(),
            message: violation.told_of(Some(&scene.scene), scene.units(), margin),
            time: violation.time(),
            joint: None,
            link: None,
            depth: None,
            value: None,
            limit: None,
            other: None,
        };
        match *violation {
            Kind::Contact { link, against, depth, .. } => Self {
                link: Some(link),
                other: Some(Other::of(scene, against)),
                depth: Some(depth),
                ..blank("contact")
            },
            Kind::Undecided { link, against, .. } => {
                Self { link: Some(link), other: Some(Other::of(scene, against)), ..blank("undecided") }
            }
            Kind::JointLimit { joint, angle, limit, .. } => {
                Self { joint: Some(joint), value: Some(angle), limit: Some(limit), ..blank("joint_limit") }
            }
            Kind::MotionLimit { joint, rate, value, limit, .. } => Self {
                joint: Some(joint),
                value: Some(value),
                limit: Some(limit),
                ..blank(&format!("{}_limit", rate.name()))
            },
            Kind::Discontinuity { joint, what, jump, .. } => {
                Self { joint: Some(joint), value: Some(jump), ..blank(&format!("{}_jump", what.name())) }
            }
            Kind::NotAtRest { joint, at_end, value, .. } => Self {
                joint: Some(joint),
                value: Some(value),
                ..blank(if at_end { "moving_end" } else { "moving_start" })
            },
            Kind::NotJudged { lead, .. } => Self { value: Some(lead), ..blank("not_judged") },
            Kind::OtherArm { .. } => blank("other_arm"),
            Kind::TooLarge { joint, .. } => Self { joint: Some(joint), ..blank("too_large") },
            Kind::Stopped { .. } => blank("stopped"),
        }
    }

    pub(crate) fn message(&self) -> &str {
        &self.message
    }

    pub(crate) fn kind(&self) -> &str {
        &self.kind
    }

    pub(crate) fn time(&self) -> f64 {
        self.time
    }
}

#[pymethods]
impl Violation {
    /// The obstacle that the link is up against, by its place among the scene's, from 0.
    #[getter]
    fn obstacle(&self) -> Option<usize> {
        self.other.as_ref().and_then(|other| other.obstacle)
    }

    /// The obstacle's name, if it has one.
    #[getter]
    fn name(&self) -> Option<String> {
        self.other.as_ref().and_then(|other| other.name.clone())
    }

    /// The link that the link is up against, 1 for the one at the base.
    #[getter]
    fn other_link(&self) -> Option<usize> {
        self.other.as_ref().and_then(|other| other.link)
    }

    /// What the link is up against as texts call it: obstacles count from 1 there.
    #[getter]
    fn against(&self) -> Option<String> {
        self.other.as_ref().map(Other::in_words)
    }

    /// Return what goes with its kind as a dictionary.
    pub(crate) fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let part = PyDict::new(py);
        part.set_item("time", self.time)?;
        part.set_item("message", &self.message)?;
        part.set_item("kind", &self.kind)?;
        for (name, number) in [("joint", self.joint), ("link", self.link)] {
            if let Some(number) = number {
                part.set_item(name, number)?;
            }
        }
        if let Some(other) = &self.other {
            other.put_into(&part)?;
        }
        for (name, value) in [("depth", self.depth), ("value", self.value), ("limit", self.limit)] {
            if let Some(value) = value {
                part.set_item(name, value)?;
            }
        }
        Ok(part)
    }

    fn __repr__(&self) -> String {
        format!("<Violation {}: {}>", self.kind, self.message)
    }
}

/// The nearest that a link comes to an obstacle, or to a link that it has to keep clear of.
#[pyclass(frozen, eq, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct Clearance {
    /// Between the link's outside and the other (m); below 0 the depth.
    #[pyo3(get)]
    distance: f64,
    /// Proved for the whole motion: nothing is ever nearer than this (m); ``None`` in contact, or where that was not
    /// decided.
    #[pyo3(get)]
    at_least: Option<f64>,
    /// When (s).
    #[pyo3(get)]
    time: f64,
    /// Which link, 1 for the one at the base.
    #[pyo3(get)]
    link: usize,
    other: Other,
}

impl Clearance {
    pub(crate) fn of(scene: &Scene, least: &verify::Clearance) -> Self {
        Self {
            distance: least.distance,
            at_least: least.at_least,
            time: least.time,
            link: least.link,
            other: Other::of(scene, least.against),
        }
    }

    pub(crate) fn distance(&self) -> f64 {
        self.distance
    }
}

#[pymethods]
impl Clearance {
    /// The obstacle, by its place among the scene's, from 0; ``None`` for a link.
    #[getter]
    fn obstacle(&self) -> Option<usize> {
        self.other.obstacle
    }

    /// The obstacle's name, if it has one.
    #[getter]
    fn name(&self) -> Option<String> {
        self.other.name.clone()
    }

    /// The other link, 1 for the one at the base; ``None`` for an obstacle.
    #[getter]
    fn other_link(&self) -> Option<usize> {
        self.other.link
    }

    /// The obstacle or the other link as texts call it: obstacles count from 1 there.
    #[getter]
    fn against(&self) -> String {
        self.other.in_words()
    }

    /// Return it as a dictionary.
    pub(crate) fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let part = PyDict::new(py);
        part.set_item("distance", self.distance)?;
        part.set_item("at_least", self.at_least)?;
        part.set_item("time", self.time)?;
        part.set_item("link", self.link)?;
        self.other.put_into(&part)?;
        Ok(part)
    }

    fn __repr__(&self) -> String {
        let (distance, time) = (short(self.distance * 1e3), short(self.time));
        format!("<Clearance {distance} mm at {time} s, link {} and {}>", self.link, self.other.in_words())
    }
}

/// How near a joint comes to its limits.
#[pyclass(frozen, eq, get_all, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct JointMargin {
    /// To the nearer limit (rad); below 0 beyond it.
    distance: f64,
    /// When (s).
    time: f64,
}

impl JointMargin {
    pub(crate) fn of(margin: &verify::JointMargin) -> Self {
        Self { distance: margin.distance, time: margin.time }
    }

    pub(crate) fn as_pair(&self) -> (f64, f64) {
        (self.distance, self.time)
    }
}

#[pymethods]
impl JointMargin {
    fn __repr__(&self) -> String {
        format!("<JointMargin {} rad at {} s>", short(self.distance), short(self.time))
    }
}

/// The greatest absolute value of a rate, beside its limit.
#[pyclass(frozen, eq, get_all, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct MotionMargin {
    /// The greatest absolute value (rad/s, rad/s² or rad/s³).
    largest: f64,
    /// When (s).
    time: f64,
    /// What is allowed; ``None`` where the scene states no limit.
    limit: Option<f64>,
}

impl MotionMargin {
    fn of(margin: &verify::MotionMargin) -> Self {
        Self { largest: margin.largest, time: margin.time, limit: margin.limit }
    }

    fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let part = PyDict::new(py);
        part.set_item("largest", self.largest)?;
        part.set_item("time", self.time)?;
        part.set_item("limit", self.limit)?;
        Ok(part)
    }
}

#[pymethods]
impl MotionMargin {
    fn __repr__(&self) -> String {
        let limit =
            self.limit.map_or_else(|| "no limit".to_owned(), |limit| format!("limit {}", short(limit)));
        format!("<MotionMargin {} at {} s, {limit}>", short(self.largest), short(self.time))
    }
}

/// The greatest rates of one joint.
#[pyclass(frozen, eq, get_all, module = "elbowroom._core")]
#[derive(Clone, PartialEq)]
pub(crate) struct MotionMargins {
    /// In rad/s.
    velocity: MotionMargin,
    /// In rad/s².
    acceleration: MotionMargin,
    /// In rad/s³.
    jerk: MotionMargin,
}

impl MotionMargins {
    pub(crate) fn of(margins: &verify::MotionMargins) -> Self {
        Self {
            velocity: MotionMargin::of(&margins.velocity),
            acceleration: MotionMargin::of(&margins.acceleration),
            jerk: MotionMargin::of(&margins.jerk),
        }
    }

    pub(crate) fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let part = PyDict::new(py);
        part.set_item("velocity", self.velocity.as_dict(py)?)?;
        part.set_item("acceleration", self.acceleration.as_dict(py)?)?;
        part.set_item("jerk", self.jerk.as_dict(py)?)?;
        Ok(part)
    }
}

#[pymethods]
impl MotionMargins {
    fn __repr__(&self) -> String {
        let [velocity, acceleration, jerk] =
            [&self.velocity, &self.acceleration, &self.jerk].map(|margin| short(margin.largest));
        format!("<MotionMargins up to {velocity} rad/s, {acceleration} rad/s², {jerk} rad/s³>")
    }
}
