use thiserror::Error;

use super::{LONGEST_DURATION, Mismatch, NoPath, SHORTEST_DURATION};
use crate::arm::Posture;
use crate::free_space::NotFree;
use crate::geometry::Point;
use crate::scene::{TwoLinkError, obstacle_in_words};
use crate::search::GoalError;
use crate::trajectory::MotionError;
use crate::units::{Told, Units, stated};
use crate::verify::Verdict;

/// What planners say of a scene in which an obstacle moves.
pub(crate) fn static_only(obstacle: usize, name: Option<&str>) -> String {
    let which = obstacle_in_words(obstacle, name);
    format!(
        "plan supports static obstacles only, and {which} moves; use elbowroom follow, or Replanner in Python"
    )
}

/// What may help where a grid connects nothing.
pub(crate) const FINER: &str =
    "a finer grid step may find one, or, for 2 links, planner optimal, which needs no grid";

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// An obstacle of the scene moves.
    #[error("{}", static_only(*obstacle, name.as_deref()))]
    Moving {
        /// Its number, from 0.
        obstacle: usize,
        /// Its name, if it has one.
        name: Option<String>,
    },
    /// The planner's own settings make no sense.
    #[error("planner {planner}: {reason}")]
    BadSettings {
        /// Its name.
        planner: String,
        /// What is wrong with them, and what is allowed.
        reason: String,
    },
    /// The planner could not go on, for a reason of its own.
    #[error("planner {planner} failed: {reason}")]
    Failed {
        /// Its name.
        planner: String,
        /// In its own words.
        reason: String,
    },
    /// The motion shall take no time, a time that is no number, or one beyond all measure.
    #[error("duration is {duration:?} s, it must be from {SHORTEST_DURATION} to {LONGEST_DURATION} s")]
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
    #[error("{}", self.told(Units::SI))]
    Start(NotFree),
    /// The task ends at a place that is not free.
    #[error("{}", self.told(Units::SI))]
    Goal(NotFree),
    /// The goal is free, but not in the posture asked for.
    #[error("goal: not free {}, the posture asked for", wanted.name())]
    GoalPosture {
        /// Which was asked for.
        wanted: Posture,
    },
    /// The grid does not connect start and goal; a finer one may.
    #[error("{}", self.told(Units::SI))]
    NotFound {
        /// Distance between grid points (m).
        step: f64,
    },
    /// The planner searches the grid, and an end of the task lies beyond it.
    #[error("{}", self.told(Units::SI))]
    OutsideGrid {
        /// `start` or `goal`.
        end: &'static str,
        /// Where its tip is (m).
        tip: Point,
        /// What the grid ranges over along x (m).
        x: [f64; 2],
        /// The same along y (m).
        y: [f64; 2],
    },
    /// What the planner took to be free, this much less than all that is, does not connect start and goal.
    #[error("{}", self.told(Units::SI))]
    NotFoundOverJoints {
        /// Least distance kept from forbidden angles (rad).
        distance: f64,
    },
    /// The planner cannot serve an arm of so many links.
    #[error("planner {planner} is for arms of {}; this one has {links}", links_in_words(*least, *most))]
    OtherArm {
        /// Its name.
        planner: String,
        /// The fewest links that it serves.
        least: usize,
        /// The most.
        most: usize,
        /// How many the arm has.
        links: usize,
    },
    /// A posture is asked for of an arm that has no two.
    #[error("postures up, down and keep are for arms of 2 links; this one has {links}: any")]
    PostureOfMany {
        /// How many links the arm has.
        links: usize,
    },
    /// No free configuration was found for an end of the task; there may be one.
    #[error("{}", self.told(Units::SI))]
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
        "not found in {evaluations} evaluations: the best candidate is still in contact or beyond limits; a larger budget of \
         evaluations may find one"
    )]
    NotFoundInBudget {
        /// How many candidates were judged.
        evaluations: usize,
    },
    /// No motion does it: proved.
    #[error("{0}")]
    NoPath(NoPath),
    /// A gap is asked of a planner that searches only once.
    #[error("gap is for planners that search in rounds, such as optimal, not for {planner}")]
    GapOfOneRound {
        /// Its name.
        planner: String,
    },
    /// The gap to be reached makes no sense.
    #[error("gap is {gap}, it must be 0 or greater")]
    Gap {
        /// What was asked.
        gap: f64,
    },
    /// The slack makes no sense.
    #[error("slack is {slack}, it must be 0 or greater")]
    Slack {
        /// What was asked.
        slack: f64,
    },
    /// The clearance makes no sense, or is more than links or obstacles can be thickened by.
    #[error("{}", self.told(Units::SI))]
    Clearance {
        /// What was asked (m).
        clearance: f64,
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
    /// A path is not free, or not proved to be: the planner was wrong.
    #[error(
        "planner {planner}: the straight move from place {from} of its path, counted from 0, to the next is not certified free"
    )]
    Uncertified {
        /// Its name.
        planner: String,
        /// Index of the configuration that it begins at.
        from: usize,
    },
    /// The verifier does not accept the motion: the planner was wrong.
    #[error("{}", self.told(Units::SI))]
    Refused {
        /// Its name.
        planner: String,
        /// What the verifier found.
        verdict: Box<Verdict>,
    },
    /// The motion is safe and does something else: the planner was wrong.
    #[error("{}", self.told(Units::SI))]
    Mismatch {
        /// Its name.
        planner: String,
        /// What is wrong with it.
        mismatch: Mismatch,
    },
}

impl PlanError {
    /// Why `planner`, for two links among static obstacles, does not serve a scene.
    pub(crate) fn not_two_link(planner: &str, error: TwoLinkError) -> Self {
        match error {
            TwoLinkError::Links { found } => {
                Self::OtherArm { planner: planner.to_owned(), least: 2, most: 2, links: found }
            }
            TwoLinkError::Moving { obstacle, name } => Self::Moving { obstacle, name },
        }
    }
}

fn links_in_words(least: usize, most: usize) -> String {
    match (least, most) {
        (least, most) if least == most => format!("{least} links"),
        (least, usize::MAX) => format!("{least} links or more"),
        (least, most) => format!("{least} to {most} links"),
    }
}

impl PlanError {
    /// The same where `clearance` (m) was asked for, and contact is all that comes nearer.
    pub(super) fn within(self, clearance: f64) -> Self {
        match self {
            Self::Start(refused) => Self::Start(NotFree { clearance, ..refused }),
            Self::Goal(refused) => Self::Goal(NotFree { clearance, ..refused }),
            Self::NoPath(proof) => Self::NoPath(NoPath { clearance, ..proof }),
            other => other,
        }
    }
}

impl Told for PlanError {
    fn told(&self, units: Units) -> String {
        match self {
            Self::Start(refused) => format!("start: {}", refused.told(units)),
            Self::Goal(refused) => format!("goal: {}", refused.told(units)),
            &Self::NotFound { step } => format!(
                "not found at this resolution: no certified path over the free grid points, {} apart; {FINER}",
                units.stated_length(step)
            ),
            Self::OutsideGrid { end, tip, x, y } => {
                let range =
                    |[min, max]: [f64; 2]| [min, max].map(|value| stated(units.of_metres(value))).join(", ");
                format!(
                    "{end} {} lies outside the grid, x [{}], y [{}] {}; extend the grid, or use planner optimal, which needs none",
                    units.place(tip.x, tip.y),
                    range(*x),
                    range(*y),
                    units.length.name()
                )
            }
            &Self::NotFoundOverJoints { distance } => format!(
                "not found at this resolution: no certified path that keeps joint angles {} away from all obstacles, and narrower \
                 passages are not searched",
                units.angle(distance)
            ),
            Self::EndNotFound { end, tip, tries } => format!(
                "{end}: no free configuration found that puts the tip at {}, in {tries} tries",
                units.place(tip.x, tip.y)
            ),
            Self::Refused { planner, verdict } => {
                format!(
                    "planner {planner}: its motion is not proved to be safe: {}",
                    complaints(verdict, units)
                )
            }
            Self::Mismatch { planner, mismatch } => format!("planner {planner}: {}", mismatch.told(units)),
            &Self::Clearance { clearance } => format!(
                "clearance is {}, it must be 0 or greater, and neither links nor obstacles become too thick by it",
                units.stated_length(clearance)
            ),
            Self::NoPath(proof) => proof.told(units),
            other => other.to_string(),
        }
    }
}

/// The first things that the verifier complains about.
fn complaints(verdict: &Verdict, units: Units) -> String {
    let said = verdict.violations.iter().take(2).map(|violation| violation.told_of(None, units, 0.0));
    said.collect::<Vec<String>>().join("; ")
}
