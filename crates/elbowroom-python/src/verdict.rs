//! A verdict as plain data.

use elbowroom::scene::Scene;
use elbowroom::verify::{Against, FLOOR, MotionMargin, Verdict, Violation};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

pub(crate) fn as_dict<'py>(
    py: Python<'py>,
    scene: &Scene,
    verdict: &Verdict,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    fields.set_item("safe", verdict.is_safe())?;
    let violations = PyList::empty(py);
    for violation in &verdict.violations {
        violations.append(violation_fields(py, scene, violation)?)?;
    }
    fields.set_item("violations", violations)?;
    fields.set_item("floor", FLOOR)?;
    let clearance = verdict.least_clearance.map(|least| -> PyResult<_> {
        let part = PyDict::new(py);
        part.set_item("distance", least.distance)?;
        part.set_item("at_least", least.at_least)?;
        part.set_item("time", least.time)?;
        part.set_item("link", least.link)?;
        set_against(&part, scene, least.against)?;
        Ok(part)
    });
    fields.set_item("least_clearance", clearance.transpose()?)?;
    let stops =
        verdict.joint_margins.iter().map(|margin| margin.map(|margin| (margin.distance, margin.time)));
    fields.set_item("joint_margins", stops.collect::<Vec<_>>())?;
    let motion = PyList::empty(py);
    for margins in &verdict.motion_margins {
        let part = PyDict::new(py);
        part.set_item("velocity", margin_fields(py, &margins.velocity)?)?;
        part.set_item("acceleration", margin_fields(py, &margins.acceleration)?)?;
        part.set_item("jerk", margin_fields(py, &margins.jerk)?)?;
        motion.append(part)?;
    }
    fields.set_item("motion_margins", motion)?;
    fields.set_item("posture_changes", &verdict.posture_changes)?;
    Ok(fields)
}

fn margin_fields<'py>(py: Python<'py>, margin: &MotionMargin) -> PyResult<Bound<'py, PyDict>> {
    let part = PyDict::new(py);
    part.set_item("largest", margin.largest)?;
    part.set_item("time", margin.time)?;
    part.set_item("limit", margin.limit)?;
    Ok(part)
}

fn violation_fields<'py>(
    py: Python<'py>,
    scene: &Scene,
    violation: &Violation,
) -> PyResult<Bound<'py, PyDict>> {
    let part = PyDict::new(py);
    part.set_item("time", violation.time())?;
    part.set_item("message", violation.to_string())?;
    match *violation {
        Violation::Contact { link, against, depth, .. } => {
            part.set_item("kind", "contact")?;
            part.set_item("link", link)?;
            set_against(&part, scene, against)?;
            part.set_item("depth", depth)?;
        }
        Violation::Undecided { link, against, .. } => {
            part.set_item("kind", "undecided")?;
            part.set_item("link", link)?;
            set_against(&part, scene, against)?;
        }
        Violation::JointLimit { joint, angle, limit, .. } => {
            part.set_item("kind", "joint_limit")?;
            part.set_item("joint", joint)?;
            part.set_item("value", angle)?;
            part.set_item("limit", limit)?;
        }
        Violation::MotionLimit { joint, rate, value, limit, .. } => {
            part.set_item("kind", format!("{}_limit", rate.name()))?;
            part.set_item("joint", joint)?;
            part.set_item("value", value)?;
            part.set_item("limit", limit)?;
        }
        Violation::Discontinuity { joint, what, jump, .. } => {
            part.set_item("kind", format!("{}_jump", what.name()))?;
            part.set_item("joint", joint)?;
            part.set_item("value", jump)?;
        }
        Violation::OtherArm { .. } => part.set_item("kind", "other_arm")?,
        Violation::TooLarge { joint, .. } => {
            part.set_item("kind", "too_large")?;
            part.set_item("joint", joint)?;
        }
        Violation::Stopped { .. } => part.set_item("kind", "stopped")?,
    }
    Ok(part)
}

/// The obstacle and its name, or the other link.
fn set_against(part: &Bound<'_, PyDict>, scene: &Scene, against: Against) -> PyResult<()> {
    match against {
        Against::Obstacle(obstacle) => {
            part.set_item("obstacle", obstacle)?;
            part.set_item("name", scene.obstacles().get(obstacle).and_then(|o| o.name.as_deref()))
        }
        Against::Link(link) => part.set_item("other_link", link),
    }
}
