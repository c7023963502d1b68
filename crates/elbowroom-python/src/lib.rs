//! Border between the core and Python: conversion and error mapping, nothing else. The GIL is released while the
//! core works, Ctrl-C stops it, and no panic gets across as one.

mod check;
mod errors;
mod free_space;
mod motion;
mod online;
mod paper;
mod plan;
mod scene;
mod scene_parts;
mod verdict;
mod watch;

use pyo3::prelude::*;

#[pymodule]
mod _core {
    #[pymodule_export]
    use super::check::{interpolated, verify};
    #[pymodule_export]
    use super::free_space::{FreeSpace, free_space};
    #[pymodule_export]
    use super::motion::Motion;
    #[pymodule_export]
    use super::online::{Replanner, World};
    #[pymodule_export]
    use super::paper::{PaperPlan, plan_as_in_paper};
    #[pymodule_export]
    use super::plan::{Plan, plan, planner_options, planners_known};
    #[pymodule_export]
    use super::scene::{Scene, SceneFile};

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("TICK", elbowroom::trajectory::TICK)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
