//! Border between the core and Python: conversion and error mapping, nothing else. The GIL is released while the
//! core works, Ctrl-C stops it, and no panic gets across as one.

mod argument;
mod check;
mod errors;
mod fault;
mod free_space;
mod motion;
mod once;
mod online;
mod paper;
mod plan;
mod plan_kept;
mod planning;
mod proposed;
mod scene;
mod threads;
mod verdict;
mod verdict_parts;
mod verdict_rows;
mod watch;

use pyo3::prelude::*;

#[pymodule]
mod _core {
    #[pymodule_export]
    use super::check::{Check, check_again, interpolated, verify};
    #[pymodule_export]
    use super::free_space::{FreeSpace, free_space};
    #[pymodule_export]
    use super::motion::Motion;
    #[pymodule_export]
    use super::online::{Replanner, World};
    #[pymodule_export]
    use super::paper::{PaperPlan, plan_as_in_paper};
    #[pymodule_export]
    use super::plan::Plan;
    #[pymodule_export]
    use super::plan_kept::plan_again;
    #[pymodule_export]
    use super::planning::{
        default_planner, gap, mismatch, objectives, only_task, plan, planner_options, planners_known,
    };
    #[pymodule_export]
    use super::proposed::plan_proposed;
    #[pymodule_export]
    use super::scene::{
        Arm, Configuration, Grid, Joint, Obstacle, ObstacleMotion, Scene, Task, Units, measured, scene_again,
        stated,
    };
    #[pymodule_export]
    use super::verdict::{Verdict, verdict_again};
    #[pymodule_export]
    use super::verdict_parts::{Clearance, JointMargin, MotionMargin, MotionMargins, Violation};
    #[pymodule_export]
    use super::verdict_rows::{Allowed, Unjudged};

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        super::threads::begin();
        super::fault::keep();
        super::scene::add_shapes(module)?;
        module.add("TICK", elbowroom::trajectory::TICK)?;
        module.add("MAX_ROWS", elbowroom::trajectory::MAX_ROWS)?;
        module.add("ASSUMED_LIMITS", super::planning::assumed_limits(module.py())?)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
