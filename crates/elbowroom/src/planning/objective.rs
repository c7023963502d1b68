//! What a motion shall cost little of: the one file that knows what each objective means, to planners and to bounds.

use crate::arm::{Arm, Configuration, joint_distance, lerp};
use crate::mesh::Measure;
use crate::optimise::Length;
use crate::path::JointPath;
use crate::trajectory::{Motion, SpeedLimits, fastest_durations, vias_at};

/// By how much a path's tip travel may be above the least and the path still be chosen for what the arm pays, as a share.
pub const NEARLY_EQUAL: f64 = 0.01;

/// What joint travel weighs where tip travel counts, as a share of the reach (m/rad): enough against needless self-motion.
const JOINT_SHARE: f64 = 0.02;

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

    /// By how much a path's tip travel may be above the least for the path to be a candidate, as a share.
    pub(crate) const fn slack(self) -> f64 {
        match self {
            Self::Tip => 0.0,
            Self::Joint | Self::Time => NEARLY_EQUAL,
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

    /// What a way in the plane of two joints measures: for time (s), that of joints at their greatest velocities all along.
    pub(crate) fn measure(self, limits: &[SpeedLimits]) -> Measure {
        match self {
            Self::Tip | Self::Joint => Measure::Euclidean,
            Self::Time => Measure::Greatest([0, 1].map(|j| 1.0 / limits[j].velocity)),
        }
    }

    /// What a radian of each of two joints weighs in the same plane.
    pub(crate) fn weights(self, limits: &[SpeedLimits]) -> [f64; 2] {
        match self {
            Self::Tip | Self::Joint => [1.0; 2],
            Self::Time => [0, 1].map(|j| 1.0 / limits[j].velocity),
        }
    }

    /// The least that a motion can cost whose way measures no less than `way`; not for one that is measured in the workspace.
    pub(crate) fn of_way(self, way: f64, limits: &[SpeedLimits]) -> f64 {
        match self {
            Self::Tip | Self::Joint => way,
            Self::Time => from_rest_to_rest(way, limits),
        }
    }
}

/// The least time (s) in which joints at rest cover a way that takes `way` (s) at greatest speeds and come to rest
/// again: one of them covers all of it, and has to speed up and slow down. A joint without a maximum speed takes no time.
fn from_rest_to_rest(way: f64, limits: &[SpeedLimits]) -> f64 {
    let least = |limit: &SpeedLimits| {
        let speeding_up = limit.velocity / limit.acceleration;
        if way >= speeding_up { way + speeding_up } else { 2.0 * (way * speeding_up).sqrt() }
    };
    limits.iter().filter(|limit| limit.velocity.is_finite()).map(least).reduce(f64::min).unwrap_or(0.0)
}
