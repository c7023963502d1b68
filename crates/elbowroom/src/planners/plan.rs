use thiserror::Error;

use super::limits::AssumedLimit;
use crate::arm::Posture;
use crate::free_space::NotFree;
use crate::geometry::Point;
use crate::path::{JointPath, TipPath};
use crate::scene::in_words;
use crate::search::GoalError;
use crate::swarm::{BoundsError, CulturalError, GuidedSwarmError, SwarmError};
use crate::trajectory::MotionError;
use crate::verify::{Trajectory, Verdict};

/// What a planner found: a motion that is proved to be safe, and how it came to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
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
    /// Configurations from start to goal; the straight turns between them are certified free.
    pub joint_path: JointPath,
    /// Places of the path that the motion is led through, by their index.
    pub vias: Vec<usize>,
    /// How many of them, ends left out, it stops at.
    pub stops: usize,
    /// The motion, with the verifier's verdict.
    pub trajectory: Trajectory,
    /// Motion limits that the scene does not state, and what was taken in their place.
    pub assumed_limits: Vec<AssumedLimit>,
    /// What the search took, for planners that count it.
    pub effort: Option<Effort>,
}

/// What a search by evaluations took.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Effort {
    /// How many candidates were judged.
    pub evaluations: usize,
    /// Evaluations made, and the cost of the best feasible candidate by then, each time that fell.
    pub convergence: Vec<(usize, f64)>,
}

impl Plan {
    /// How much more it costs than the lower bound, as a share of it: no motion is better by more. `None` where there
    /// is no bound.
    pub fn gap(&self) -> Option<f64> {
        gap(self.cost, self.lower_bound?)
    }
}

/// Share by which rounding may put a cost below its bound.
const BOUND_ROUNDING: f64 = 1e-9;

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

/// The proof that no motion does a task: what can be reached from the start lies within cells whose walls are
/// forbidden all along, and no goal lies there.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("no path: proved, forbidden configurations part all that the start can reach from the goal")]
pub struct NoPath {
    /// Corners of convex cells that hold all configurations that can be reached (rad), each counter-clockwise.
    pub reachable: Vec<Vec<[f64; 2]>>,
    /// The configurations it may start from (rad).
    pub starts: Vec<[f64; 2]>,
    /// Those that would do as a goal (rad).
    pub goals: Vec<[f64; 2]>,
}

/// What planners say of a scene in which an obstacle moves.
pub(super) fn standing_still(obstacle: usize, name: Option<&str>) -> String {
    let which = in_words(obstacle, name);
    format!(
        "planners take obstacles to stand still; {which} moves: the command follow and Replanner serve those that move"
    )
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlanError {
    /// An obstacle of the scene moves.
    #[error("{}", standing_still(*obstacle, name.as_deref()))]
    Moving {
        /// Its number, from 0.
        obstacle: usize,
        /// Its name, if it has one.
        name: Option<String>,
    },
    /// A setting of the swarm makes no sense.
    #[error(transparent)]
    Swarm(#[from] GuidedSwarmError),
    /// Settings of a swarm over vias or way-points make no sense.
    #[error(transparent)]
    Particles(SwarmError),
    /// The same of one with a culture.
    #[error(transparent)]
    Culture(CulturalError),
    /// There is nothing for a swarm to search.
    #[error(transparent)]
    Bounds(BoundsError),
    /// The motion shall take no time, or a time that is no number.
    #[error("duration is {duration} s, it must be finite and greater than 0")]
    Duration {
        /// What was asked (s).
        duration: f64,
    },
    /// The motion limits of the scene do not allow so short a duration along the path found.
    #[error(
        "duration is {duration} s, the motion limits allow {fastest:.6} s at the fastest along the path found"
    )]
    TooFast {
        /// What was asked (s).
        duration: f64,
        /// What is possible (s).
        fastest: f64,
    },
    /// The task begins at a place that is not free.
    #[error("start: {0}")]
    Start(NotFree),
    /// The task ends at a place that is not free.
    #[error("goal: {0}")]
    Goal(NotFree),
    /// The goal is free, but not in the posture asked for.
    #[error("goal: not free {}, the posture asked for", wanted.name())]
    GoalPosture {
        /// Which was asked for.
        wanted: Posture,
    },
    /// The grid does not connect start and goal; a finer one may.
    #[error("not found at this resolution: no certified path over the free grid points, {step} m apart")]
    NotFound {
        /// Distance between grid points (m).
        step: f64,
    },
    /// What the planner took to be free, this much less than all that is, does not connect start and goal.
    #[error("not found at this resolution: no certified path {distance} rad away from all obstacles")]
    NotFoundOverJoints {
        /// Least distance kept from forbidden angles (rad).
        distance: f64,
    },
    /// The planner cannot serve an arm of so many links.
    #[error("planner {planner} is for arms of 2 links; this one has {links}")]
    OtherArm {
        /// Its name.
        planner: &'static str,
        /// How many links the arm has.
        links: usize,
    },
    /// A posture is asked for of an arm that has no two.
    #[error("postures up, down and keep are for arms of 2 links; this one has {links}: any")]
    PostureOfMany {
        /// How many links the arm has.
        links: usize,
    },
    /// No free configuration was found for an end of the task; there may be one.
    #[error("{end}: no free configuration found that puts the tip at ({} m, {} m), in {tries} tries", tip.x, tip.y)]
    EndNotFound {
        /// `start` or `goal`.
        end: &'static str,
        /// Where the tip shall be (m).
        tip: Point,
        /// From how many configurations it was led there.
        tries: usize,
    },
    /// No candidate was free of contact; a greater budget may find one.
    #[error(
        "not found in {evaluations} evaluations: the best candidate still is in contact or beyond limits"
    )]
    NotFoundInBudget {
        /// How many candidates were judged.
        evaluations: usize,
    },
    /// No motion does it: proved.
    #[error("{0}")]
    NoPath(NoPath),
    /// The gap to be reached makes no sense.
    #[error("gap is {gap}, it must be 0 or greater")]
    Gap {
        /// What was asked.
        gap: f64,
    },
    /// A fault of ours: the motion costs less than what was proved to be the least.
    #[error(
        "the motion costs {cost}, less than the {bound} that was proved to be the least: one of the two is wrong"
    )]
    BelowBound {
        /// Of the motion, in terms of the objective (m, rad or s).
        cost: f64,
        /// What was proved (m, rad or s).
        bound: f64,
    },
    /// The monitor stopped it.
    #[error("stopped before a path was found")]
    Stopped,
    /// A goal is no node of the graph.
    #[error(transparent)]
    GoalNode(#[from] GoalError),
    /// The polynomials overflow.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The verifier refuses straight turns that the planner certified.
    #[error("the verifier refuses certified turns: {:?}", .0.violations)]
    Refused(Box<Verdict>),
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
