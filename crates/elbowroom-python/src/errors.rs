//! From the core's typed errors to the classes of `elbowroom._errors`.

use elbowroom::free_space::{NotFree, Reason};
use elbowroom::online::ReplanError;
use elbowroom::planners::{self, PaperError};
use elbowroom::planning::PlanError;
use elbowroom::scene::{Place, SceneError, TwoLinkError};
use elbowroom::units::{Told, Units, stated};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use crate::scene::Scene;
use crate::verdict::Verdict;

/// The exception `elbowroom._errors.<class>(message, **fields)`.
fn exception<'py>(
    py: Python<'py>,
    class: &str,
    message: &str,
    fields: impl FnOnce(&Bound<'py, PyDict>) -> PyResult<()>,
) -> PyErr {
    let made = || -> PyResult<Bound<'py, PyAny>> {
        let kwargs = PyDict::new(py);
        fields(&kwargs)?;
        py.import("elbowroom._errors")?.getattr(class)?.call((message,), Some(&kwargs))
    };
    match made() {
        Ok(value) => PyErr::from_value(value),
        Err(error) => error,
    }
}

/// A number or name that makes no sense; `setting` is its name.
pub(crate) fn setting(py: Python<'_>, setting: &str, message: &str) -> PyErr {
    exception(py, "BadSetting", message, |fields| fields.set_item("setting", setting))
}

/// A part of a scene built in code that makes no sense; `key` names it as a scene file would.
pub(crate) fn part(py: Python<'_>, key: &str, message: &str) -> PyErr {
    exception(py, "SceneError", &format!("{key}: {message}"), |fields| fields.set_item("key", key))
}

/// Something that cannot happen did.
pub(crate) fn internal(py: Python<'_>, message: &str) -> PyErr {
    exception(py, "InternalError", &format!("a bug in elbowroom: {message}"), |_| Ok(()))
}

/// The system has no thread left to work on.
pub(crate) fn no_threads(py: Python<'_>) -> PyErr {
    exception(py, "ElbowroomError", "the system gives this process no threads to work on", |_| Ok(()))
}

/// The timeout, once it is known to be one.
pub(crate) fn timeout(seconds: Option<f64>) -> PyResult<Option<f64>> {
    match seconds {
        Some(s) if s.is_nan() || s < 0.0 => {
            let message = format!("timeout is {s} s, it must not be negative");
            Err(Python::attach(|py| setting(py, "timeout", &message)))
        }
        other => Ok(other),
    }
}

/// The task's `end` (start or goal) is not free.
pub(crate) fn not_free(py: Python<'_>, units: Units, task: &str, end: &str, refused: &NotFree) -> PyErr {
    exception(py, "NotFree", &format!("{end}: {}", refused.told(units)), |fields| {
        fields.set_item("task", task)?;
        fields.set_item("end", end)?;
        match &refused.place {
            Place::Tip(tip) => fields.set_item("tip", (tip.x, tip.y))?,
            Place::Configuration(q) => fields.set_item("configuration", PyTuple::new(py, q.iter())?)?,
        }
        let reasons = PyList::empty(py);
        for (posture, reason) in &refused.reasons {
            reasons.append(reason_fields(py, posture.map(|p| p.name()), reason)?)?;
        }
        fields.set_item("reasons", reasons)?;
        fields.set_item("nearest_free", refused.nearest_free.map(|p| (p.x, p.y)))
    })
}

fn reason_fields<'py>(
    py: Python<'py>,
    posture: Option<&str>,
    reason: &Reason,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    fields.set_item("posture", posture)?;
    match reason {
        Reason::OutOfReach { distance, nearest, farthest } => {
            fields.set_item("reason", "out_of_reach")?;
            fields.set_item("distance", distance)?;
            fields.set_item("nearest", nearest)?;
            fields.set_item("farthest", farthest)?;
        }
        Reason::JointLimit { joint, angle, .. } => {
            fields.set_item("reason", "joint_limit")?;
            fields.set_item("joint", joint)?;
            fields.set_item("angle", angle)?;
        }
        Reason::Collision { link, obstacle, name, depth } => {
            fields.set_item("reason", "collision")?;
            fields.set_item("link", link)?;
            fields.set_item("obstacle", obstacle)?;
            fields.set_item("name", name)?;
            fields.set_item("depth", depth)?;
        }
        Reason::OtherArm { found, joints } => {
            fields.set_item("reason", "other_arm")?;
            fields.set_item("found", found)?;
            fields.set_item("joints", joints)?;
        }
        Reason::SelfCollision { link, other, depth } => {
            fields.set_item("reason", "self_collision")?;
            fields.set_item("link", link)?;
            fields.set_item("other_link", other)?;
            fields.set_item("depth", depth)?;
        }
    }
    Ok(fields)
}

/// Time ran out, in whatever was being done.
pub(crate) fn timed_out(py: Python<'_>, timeout: Option<f64>) -> PyErr {
    let message = match timeout {
        Some(seconds) => format!("nothing found within the timeout of {} s", stated(seconds)),
        None => "stopped".to_owned(),
    };
    exception(py, "TimedOut", &message, |fields| fields.set_item("timeout", timeout))
}

/// A task that the scene does not have, or none that is named where there is more than one, or none at all.
pub(crate) fn unknown_task(py: Python<'_>, name: Option<&str>, known: Vec<String>) -> PyErr {
    let list = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    let what =
        name.map_or_else(|| "name the task to plan".to_owned(), |name| format!("no task is called '{name}'"));
    exception(py, "UnknownTask", &format!("{what}; tasks of this scene: {list}"), |fields| {
        fields.set_item("name", name.unwrap_or_default())?;
        fields.set_item("known", known)
    })
}

/// The scene is none of those that `what` is for.
pub(crate) fn two_link(py: Python<'_>, what: &str, error: &TwoLinkError) -> PyErr {
    match error {
        TwoLinkError::Links { found } => {
            let message = format!("{what} needs an arm of 2 links; the arm of this scene has {found}");
            setting(py, "arm", &message)
        }
        TwoLinkError::Moving { .. } => setting(py, "scene", &format!("{what}: {error}")),
    }
}

/// Why the paper's system has no plan.
pub(crate) fn paper(
    py: Python<'_>,
    units: Units,
    task: &str,
    timeout: Option<f64>,
    error: &PaperError,
) -> PyErr {
    let message = error.told(units);
    match error {
        PaperError::Moving { .. } => setting(py, "scene", &message),
        PaperError::OtherArm { links } => {
            two_link(py, "the paper's system", &TwoLinkError::Links { found: *links })
        }
        PaperError::Swarm(_) => setting(py, "swarm", &message),
        PaperError::Duration { .. } => setting(py, "duration", &message),
        PaperError::Start(refused) => not_free(py, units, task, "start", refused),
        PaperError::Goal(refused) => not_free(py, units, task, "goal", refused),
        PaperError::NotFound { step } => not_found(py, &message, Some((*step, "m"))),
        PaperError::Stopped => timed_out(py, timeout),
        PaperError::Follow(_) | PaperError::GoalNode(_) | PaperError::Motion(_) => internal(py, &message),
    }
}

/// A scene file that is none.
pub(crate) fn scene_file(py: Python<'_>, error: &SceneError) -> PyErr {
    exception(py, "SceneError", &error.to_string(), |fields| {
        fields.set_item("key", &error.key)?;
        fields.set_item("file", &error.file)?;
        fields.set_item("line", error.location.map(|at| at.line))?;
        fields.set_item("column", error.location.map(|at| at.column))
    })
}

/// Why there is no plan.
pub(crate) fn plan(
    py: Python<'_>,
    units: Units,
    task: &str,
    timeout: Option<f64>,
    error: &PlanError,
) -> PyErr {
    let message = error.told(units);
    match error {
        PlanError::BadSettings { .. } => setting(py, "planner", &message),
        PlanError::Duration { .. } | PlanError::TooFast { .. } => setting(py, "duration", &message),
        PlanError::Start(refused) => not_free(py, units, task, "start", refused),
        PlanError::Goal(refused) => not_free(py, units, task, "goal", refused),
        PlanError::GoalPosture { .. } => setting(py, "posture", &message),
        PlanError::OutsideGrid { .. } => setting(py, "grid", &message),
        PlanError::NotFound { step } => not_found(py, &message, Some((*step, "m"))),
        PlanError::NotFoundOverJoints { distance } => not_found(py, &message, Some((*distance, "rad"))),
        PlanError::NoPath(proof) => exception(py, "NoPath", &message, |fields| {
            fields.set_item("task", task)?;
            fields.set_item("reachable", &proof.reachable)?;
            fields.set_item("starts", &proof.starts)?;
            fields.set_item("goals", &proof.goals)?;
            fields.set_item("clearance", proof.clearance)
        }),
        PlanError::Gap { .. } | PlanError::GapOfOneRound { .. } => setting(py, "gap", &message),
        PlanError::Slack { .. } => setting(py, "slack", &message),
        PlanError::Clearance { .. } => setting(py, "clearance", &message),
        PlanError::Moving { .. } => setting(py, "scene", &message),
        PlanError::OtherArm { links, .. } => {
            let serving = planners::all().into_iter().filter(|known| known.links().contains(links));
            let names: Vec<String> = serving.map(|known| known.name().to_owned()).collect();
            setting(py, "planner", &format!("{message}; those that serve it: {}", names.join(", ")))
        }
        PlanError::PostureOfMany { .. } => setting(py, "posture", &message),
        PlanError::EndNotFound { .. } | PlanError::NotFoundInBudget { .. } => not_found(py, &message, None),
        PlanError::Stopped => timed_out(py, timeout),
        // A planner of ours was wrong, numbers overflow, or a node is none.
        _ => internal(py, &message),
    }
}

/// Why there is no plan by a planner of somebody else's, whose faults are its own.
pub(crate) fn proposed(
    py: Python<'_>,
    scene: &Scene,
    (planner, task): (&str, &str),
    timeout: Option<f64>,
    error: &PlanError,
) -> PyErr {
    let verdict = match error {
        PlanError::Refused { verdict, .. } => match Py::new(py, Verdict::new(scene, verdict, None)) {
            Ok(verdict) => Some(verdict),
            Err(error) => return error,
        },
        PlanError::Uncertified { .. }
        | PlanError::Failed { .. }
        | PlanError::Mismatch { .. }
        | PlanError::BelowBound { .. } => None,
        other => return plan(py, scene.units(), task, timeout, other),
    };
    exception(py, "PlannerFault", &error.told(scene.units()), |fields| {
        fields.set_item("planner", planner)?;
        fields.set_item("verdict", verdict)
    })
}

/// Why there is no replanner for `task`.
pub(crate) fn replan(py: Python<'_>, units: Units, what: &str, task: &str, error: &ReplanError) -> PyErr {
    match error {
        ReplanError::Arm(error) => two_link(py, what, error),
        ReplanError::Goal(refused) => not_free(py, units, task, "goal", refused),
        ReplanError::Routes(refused) => plan(py, units, task, None, refused),
        other => internal(py, &other.to_string()),
    }
}

/// Nothing was found, at this resolution and its unit if that is what it was for.
fn not_found(py: Python<'_>, message: &str, resolution: Option<(f64, &str)>) -> PyErr {
    exception(py, "NotFound", message, |fields| {
        fields.set_item("resolution", resolution.map(|(value, _)| value))?;
        fields.set_item("unit", resolution.map(|(_, unit)| unit))
    })
}

/// What was kept of a plan, check or verdict does not hold; with what the verifier says now, if it was asked.
pub(crate) fn refuted(py: Python<'_>, message: &str, verdict: Option<Py<Verdict>>) -> PyErr {
    exception(py, "Refuted", message, |fields| fields.set_item("verdict", verdict))
}

/// Samples or a file that are no trajectory.
pub(crate) fn trajectory(py: Python<'_>, message: &str) -> PyErr {
    exception(py, "TrajectoryError", message, |_| Ok(()))
}
