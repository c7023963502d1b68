//! What a motion shall cost little of: the one file that knows what each objective means, to planners and to bounds.

use super::END_ROUNDING;
use crate::arm::{Arm, Configuration, joint_distance, lerp};
use crate::mesh::Measure;
use crate::optimise::Length;
use crate::path::JointPath;
use crate::roadmap::StepCost;
use crate::scene::{Place, TwoLinkScene};
use crate::trajectory::{Motion, SpeedLimits, fastest_durations, vias_at};
use crate::verify::{
    BoundError, OpenJoints, Reachability, bound_over_joints, bound_over_time, least_time_between,
};

/// What joint travel weighs where tip travel counts, as a share of the reach (m/rad): enough against needless self-motion.
const JOINT_SHARE: f64 = 0.02;

/// Share of a straight way that is given away for rounding.
const STRAIGHT_ROUNDING: f64 = 1e-9;

/// What a motion shall cost little of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Objective {
    /// Length of the tip's way (m).
    #[default]
    Tip,
    /// Length of the way in configuration space (rad).
    Joint,
    /// Time under the motion limits (s).
    Time,
}

impl Objective {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Tip, Self::Joint, Self::Time];

    /// The word for it in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tip => "tip",
            Self::Joint => "joint",
            Self::Time => "time",
        }
    }

    /// What it is measured in.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Tip => "m",
            Self::Joint => "rad",
            Self::Time => "s",
        }
    }

    /// What it is a number of.
    pub const fn quantity(self) -> &'static str {
        match self {
            Self::Tip => "tip travel",
            Self::Joint => "joint travel",
            Self::Time => "duration",
        }
    }

    /// What `motion` costs (m, rad or s).
    pub fn of_motion(self, arm: &Arm, motion: &Motion) -> f64 {
        match self {
            Self::Tip => motion.tip_length(arm),
            Self::Joint => motion.joint_length(),
            Self::Time => motion.duration(),
        }
    }

    /// What straight moves along `path` cost (m or rad), stops at its corners included; `None` for time, which the path does not
    /// tell.
    pub fn of_path(self, arm: &Arm, path: &JointPath) -> Option<f64> {
        match self {
            Self::Tip => Some(path.tip_travel(arm)),
            Self::Joint => Some(path.length()),
            Self::Time => None,
        }
    }

    /// The length that counts, if one does.
    pub(crate) const fn length(self) -> Option<Length> {
        match self {
            Self::Tip => Some(Length::Tip),
            Self::Joint => Some(Length::Joint),
            Self::Time => None,
        }
    }

    /// What a motion through `looks`, of this `duration` (s), is taken to cost: the way from sample to sample is straight.
    pub(crate) fn of_looks(self, arm: &Arm, looks: &[Vec<f64>], duration: f64) -> f64 {
        match self {
            Self::Tip => {
                let tips: Vec<_> = looks.iter().map(|q| arm.tip(q)).collect();
                tips.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
            }
            Self::Joint => looks.windows(2).map(|pair| joint_distance(&pair[0], &pair[1])).sum(),
            Self::Time => duration,
        }
    }

    /// What a straight move is taken to cost: tip travel by chords between so many `looks`, time with each joint at its greatest
    /// velocity.
    pub(crate) fn of_move(
        self,
        arm: &Arm,
        limits: &[SpeedLimits],
        (from, to): (&[f64], &[f64]),
        looks: impl FnOnce() -> usize,
    ) -> f64 {
        match self {
            Self::Tip => {
                let looks = looks();
                let tip = |i: usize| arm.tip(&lerp::<Configuration>(from, to, i as f64 / looks as f64));
                let mut last = tip(0);
                let mut chord = |i: usize| {
                    let next = tip(i);
                    std::mem::replace(&mut last, next).distance(next)
                };
                (1..=looks).map(&mut chord).sum()
            }
            Self::Joint => joint_distance(from, to),
            Self::Time => {
                let joints = from.iter().zip(to).zip(limits);
                joints.map(|((a, b), limit)| (b - a).abs() / limit.velocity).fold(0.0, f64::max)
            }
        }
    }

    /// What a motion along a path promises to cost, by the path's tip travel (m), its joint travel (rad), or its corners: only
    /// what counts is worked out.
    pub(crate) fn estimate(
        self,
        limits: &[SpeedLimits],
        tip_travel: impl FnOnce() -> f64,
        joint_travel: impl FnOnce() -> f64,
        corners: impl FnOnce() -> Vec<Configuration>,
    ) -> f64 {
        match self {
            Self::Tip => tip_travel(),
            Self::Joint => joint_travel(),
            Self::Time => fastest_durations(&vias_at(&corners()), limits).iter().sum(),
        }
    }

    /// What a stretch of a path weighs when a shortcut is tried in its place.
    pub(crate) fn weight(self, arm: &Arm, places: &[Configuration]) -> f64 {
        let joint: f64 = places.windows(2).map(|pair| joint_distance(&pair[0], &pair[1])).sum();
        match self {
            Self::Tip => JointPath(places.to_vec()).tip_travel(arm) + JOINT_SHARE * arm.reach()[1] * joint,
            Self::Joint | Self::Time => joint,
        }
    }

    /// Whether ways are measured in the workspace, by the tip, and not in the plane of the joints.
    pub(crate) const fn is_in_workspace(self) -> bool {
        matches!(self, Self::Tip)
    }

    /// Whether corners cost: a path with fewer and softer ones may be better though it is longer.
    pub(crate) const fn minds_corners(self) -> bool {
        matches!(self, Self::Time)
    }

    /// Whether the motion limits matter to it.
    pub(crate) const fn regards_limits(self) -> bool {
        matches!(self, Self::Time)
    }

    /// What a way in the plane of two joints measures: for time (s), that of joints at their greatest velocities all along.
    pub(crate) fn measure(self, limits: &[SpeedLimits]) -> Measure {
        match self {
            Self::Tip | Self::Joint => Measure::Euclidean,
            Self::Time => Measure::Greatest([0, 1].map(|j| 1.0 / limits[j].velocity)),
        }
    }

    /// What steps of a graph over places and postures cost: by tip travel (m), joint travel (rad) or time (s), that of joints at their
    /// greatest velocities all along.
    pub(crate) fn step_cost(self, limits: &[SpeedLimits]) -> StepCost {
        match self {
            Self::Tip => StepCost::Tip,
            Self::Joint | Self::Time => StepCost::Joints(self.measure(limits)),
        }
    }

    /// What a radian of each of two joints weighs in the same plane.
    pub(crate) fn weights(self, limits: &[SpeedLimits]) -> [f64; 2] {
        match self {
            Self::Tip | Self::Joint => [1.0; 2],
            Self::Time => [0, 1].map(|j| 1.0 / limits[j].velocity),
        }
    }

    /// What every motion over what `claim` leaves open costs at least, proved by the verifier; not for one that is measured in the
    /// workspace.
    ///
    /// # Errors
    /// [`BoundError`]
    pub(crate) fn least_over_joints(
        self,
        scene: TwoLinkScene<'_>,
        claim: &OpenJoints<'_>,
        limits: &[SpeedLimits],
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Result<Reachability, BoundError> {
        match self {
            Self::Tip | Self::Joint => bound_over_joints(scene, claim, self.measure(limits), keep_going),
            Self::Time => bound_over_time(scene, claim, limits, keep_going),
        }
    }

    /// What every motion from rest at `start` to rest at `goal`, or as near as motions have to be, costs at least, whatever is in the
    /// way; `None` where that takes configurations and a place is one of the tip's.
    pub(crate) fn least_between(
        self,
        arm: &Arm,
        limits: &[SpeedLimits],
        start: &Place,
        goal: &Place,
    ) -> Option<f64> {
        let less = |way: f64, away: f64| (way * (1.0 - STRAIGHT_ROUNDING) - 2.0 * away).max(0.0);
        let tip = |place: &Place| match place {
            Place::Tip(tip) => *tip,
            Place::Configuration(q) => arm.tip(q),
        };
        match (self, start, goal) {
            // The tip is no farther away than all joints may bring it.
            (Self::Tip, _, _) => {
                let away = END_ROUNDING * arm.lengths().iter().sum::<f64>() * arm.links() as f64;
                Some(less(tip(start).distance(tip(goal)), away.max(END_ROUNDING)))
            }
            (Self::Joint, Place::Configuration(start), Place::Configuration(goal)) => {
                Some(less(arm.distance(start, goal), END_ROUNDING * (arm.links() as f64).sqrt()))
            }
            (Self::Time, Place::Configuration(start), Place::Configuration(goal)) => {
                Some(least_time_between(arm, limits, start, goal, END_ROUNDING))
            }
            _ => None,
        }
    }
}
