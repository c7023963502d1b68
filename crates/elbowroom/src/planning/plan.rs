use thiserror::Error;

use super::{AssumedLimit, Effort, Mismatch, Objective, PlanError, Problem, mismatch};
use crate::path::{JointPath, TipPath};
use crate::scene::{Scene, Task};
use crate::trajectory::Motion;
use crate::verify::{Trajectory, Verdict, VerifySettings};

/// Share by which rounding may put a cost below its bound.
const BOUND_ROUNDING: f64 = 1e-9;

/// Share by which a cost that is measured again may differ: rounding on another machine.
const COST_ROUNDING: f64 = 1e-9;

/// What a planner found: a motion that is proved to be safe and to do its task, and how it came to be.
///
/// Only [`plan`](super::plan()) makes one, and [`Plan::again`] of one that was kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    record: PlanRecord,
    trajectory: Trajectory,
}

/// All of a [`Plan`] but its motion, as plain data: what may be kept in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanRecord {
    /// What the motion costs, in terms of the objective: metres, radians or seconds.
    pub cost: f64,
    /// No motion costs less than this, proved by the verifier; `None` where it could not prove anything.
    pub lower_bound: Option<f64>,
    /// Length of the path that the motion was made from, tip travel along its edges (m).
    pub path_cost: f64,
    /// How many different paths the choice was among.
    pub paths_to_choose_from: usize,
    /// Where the tip is at each place of `joint_path`.
    pub tip_path: TipPath,
    /// Configurations from start to goal. Where the planner found a path, the straight moves between them are certified free;
    /// where it found a motion, they lie on it.
    pub joint_path: JointPath,
    /// Places of the path that the motion is led through, by their index.
    pub vias: Vec<usize>,
    /// How many of them, ends left out, it stops at.
    pub stops: usize,
    /// Motion limits that the scene does not state, and what was taken in their place.
    pub assumed_limits: Vec<AssumedLimit>,
    /// What the search took, for planners that count it.
    pub effort: Option<Effort>,
    /// The clearance that was asked for, and is proved to be kept (m).
    pub clearance: f64,
}

/// Why what was kept is no plan.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The verifier does not accept the motion.
    #[error("the plan was kept as safe, and its motion is not proved to be")]
    Refused(Box<Verdict>),
    /// The motion does not do the task.
    #[error("the plan was kept as one of its task, and {0}")]
    Mismatch(Mismatch),
    /// The path is not one of the arm's joints.
    #[error("the plan was kept with no path of its {joints} joints")]
    Path {
        /// Of the arm.
        joints: usize,
    },
    /// The cost is another.
    #[error("the plan was kept with a cost of {kept}; its motion costs {measured}")]
    Cost {
        /// As kept.
        kept: f64,
        /// As measured.
        measured: f64,
    },
    /// The bound cannot be one.
    #[error("the plan was kept with a lower bound above what its motion costs, {measured}")]
    Bound {
        /// As measured.
        measured: f64,
    },
}

impl Plan {
    /// A plan whose motion was accepted.
    pub(super) fn new(record: PlanRecord, trajectory: Trajectory) -> Self {
        Self { record, trajectory }
    }

    /// A plan of `task` that was kept: nothing that it claims of safety, cost or its ends is believed; the path and the lower bound
    /// are as they were kept.
    ///
    /// # Errors
    /// [`RecordError`]
    pub fn again(
        scene: &Scene,
        task: &Task,
        objective: Objective,
        motion: Motion,
        record: PlanRecord,
    ) -> Result<Self, RecordError> {
        let joints = scene.arm().links();
        if record.joint_path.0.is_empty() || record.joint_path.0.iter().any(|q| q.len() != joints) {
            return Err(RecordError::Path { joints });
        }
        let trajectory =
            Trajectory::certify(scene, motion, &keeping(record.clearance)).map_err(RecordError::Refused)?;
        if let Some(mismatch) =
            mismatch(scene, task, trajectory.motion(), &trajectory.verdict().posture_changes)
        {
            return Err(RecordError::Mismatch(mismatch));
        }
        let measured = objective.of_motion(scene.arm(), trajectory.motion());
        let off = (record.cost - measured).abs();
        if off.is_nan() || off > COST_ROUNDING * measured {
            return Err(RecordError::Cost { kept: record.cost, measured });
        }
        if record.lower_bound.is_some_and(|bound| bound.is_nan() || bound > measured * (1.0 + BOUND_ROUNDING))
        {
            return Err(RecordError::Bound { measured });
        }
        Ok(Self { record, trajectory })
    }

    /// The same, with the best bound that is known by now.
    pub(super) fn with_lower_bound(mut self, lower_bound: Option<f64>) -> Self {
        self.record.lower_bound = lower_bound;
        self
    }

    /// The same plan in `scene`, where it was made in [`Scene::with_clearance`] of it: judged anew, with `clearance` (m) as the margin.
    ///
    /// # Errors
    /// [`PlanError::Refused`], [`PlanError::Stopped`]
    pub(super) fn with_clearance(
        self,
        problem: &Problem<'_>,
        scene: &Scene,
        planner: &str,
        clearance: f64,
    ) -> Result<Self, PlanError> {
        let keep_going = || problem.monitor.keep_going();
        let motion = self.trajectory.motion().clone();
        let judged = Trajectory::certify_until(scene, motion, &keeping(clearance), &keep_going);
        let trajectory = judged.map_err(|verdict| match problem.go_on() {
            Ok(()) => PlanError::Refused { planner: planner.to_owned(), verdict },
            Err(stopped) => stopped,
        })?;
        Ok(Self { record: PlanRecord { clearance, ..self.record }, trajectory })
    }

    /// The motion, with the verifier's verdict.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// All but the motion.
    pub fn record(&self) -> &PlanRecord {
        &self.record
    }

    /// What the motion costs, in terms of the objective: metres, radians or seconds.
    pub fn cost(&self) -> f64 {
        self.record.cost
    }

    /// No motion costs less than this, proved by the verifier; `None` where it could not prove anything.
    pub fn lower_bound(&self) -> Option<f64> {
        self.record.lower_bound
    }

    /// How much more it costs than the lower bound, as a share of it: no motion is better by more. `None` where there
    /// is no bound.
    pub fn gap(&self) -> Option<f64> {
        gap(self.cost(), self.lower_bound()?)
    }

    /// Configurations from start to goal, see [`PlanRecord::joint_path`].
    pub fn joint_path(&self) -> &JointPath {
        &self.record.joint_path
    }

    /// What the search took, for planners that count it.
    pub fn effort(&self) -> Option<&Effort> {
        self.record.effort.as_ref()
    }
}

/// What is asked of a motion that keeps `clearance` (m).
fn keeping(clearance: f64) -> VerifySettings {
    VerifySettings { margin: clearance, ..VerifySettings::default() }
}

/// Refuses a `cost` below what was proved to be the least: one of the two is wrong.
///
/// # Errors
/// [`PlanError::BelowBound`]
pub(super) fn check_bound(cost: f64, bound: f64) -> Result<(), PlanError> {
    if cost < bound * (1.0 - BOUND_ROUNDING) {
        return Err(PlanError::BelowBound { cost, bound });
    }
    Ok(())
}

/// How much more `cost` is than `bound`, as a share of it; `None` where a bound of 0 or less says nothing.
pub fn gap(cost: f64, bound: f64) -> Option<f64> {
    if cost <= bound {
        return Some(0.0);
    }
    (bound > 0.0).then(|| cost / bound - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cost_below_its_bound_is_an_error_and_no_gap_of_zero() {
        assert_eq!(check_bound(2.0, 4.0), Err(PlanError::BelowBound { cost: 2.0, bound: 4.0 }));
        assert_eq!(check_bound(1.0 - 1e-8, 1.0), Err(PlanError::BelowBound { cost: 1.0 - 1e-8, bound: 1.0 }));
        for (cost, bound) in [(1.0 - 1e-10, 1.0), (1.0, 1.0), (0.0, 0.0), (2.0, 1.0)] {
            assert_eq!(check_bound(cost, bound), Ok(()));
        }
    }
}
