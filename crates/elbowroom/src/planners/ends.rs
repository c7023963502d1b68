//! Where a task begins and ends, for arms of any number of links.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::{Monitor, PlanError};
use crate::arm::{Arm, Joint, JointLimits, PlanarArm, Posture, joint_distance};
use crate::free_space::{self, NotFree, Reason, reason_against};
use crate::geometry::Point;
use crate::scene::{Place, Scene, Task, TaskPosture};

/// Configurations from which the tip is led to its place, one after the other.
const MOST_TRIES: usize = 512;

/// Different configurations after which the search ends.
const ENOUGH: usize = 16;

/// Configurations nearer to each other than this are one (rad).
const DIFFERENT: f64 = 0.1;

/// Angles drawn for a joint whose stops are farther from 0 than this are drawn as if they stood there (rad).
const WIDEST_DRAW: f64 = std::f64::consts::PI;

/// A task in configurations: any of the starts will do, and any of the goals.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ends {
    /// Free configurations, a position per joint each (rad).
    pub(crate) starts: Vec<Vec<f64>>,
    /// The same.
    pub(crate) goals: Vec<Vec<f64>>,
}

impl Ends {
    /// The free configurations of `task`: all of them where there are two links or the task names them, else some that
    /// were found from `seed`.
    pub(crate) fn new(
        scene: &Scene<PlanarArm>,
        task: &Task,
        seed: u64,
        monitor: &impl Monitor,
    ) -> Result<Self, PlanError> {
        let find = |place: &Place, end: &'static str| {
            let wrap: fn(NotFree) -> PlanError =
                if end == "start" { PlanError::Start } else { PlanError::Goal };
            match scene.two_link() {
                Some(scene) => free_space::configurations(&scene, place)
                    .map(|found| found.into_iter().map(|q| q.0.to_vec()).collect())
                    .map_err(wrap),
                None => configurations(scene, place, seed, monitor, (end, wrap)),
            }
        };
        let (starts, mut goals): (Vec<Vec<f64>>, Vec<Vec<f64>>) =
            (find(&task.start, "start")?, find(&task.goal, "goal")?);
        let links = scene.arm.lengths().len();
        if links > 2 && task.posture != TaskPosture::Any {
            return Err(PlanError::PostureOfMany { links });
        }
        let wanted = match task.posture {
            TaskPosture::Up => Some(Posture::ElbowUp),
            TaskPosture::Down => Some(Posture::ElbowDown),
            TaskPosture::Any | TaskPosture::Keep => None,
        };
        if let Some(wanted) = wanted {
            // With the links in line it is either posture.
            goals.retain(|q| posture(q).is_none_or(|posture| posture == wanted));
            if goals.is_empty() {
                return Err(PlanError::GoalPosture { wanted });
            }
        }
        Ok(Self { starts, goals })
    }
}

/// The posture of an arm of two links at `q`; `None` with the links in line, and for other arms.
pub(crate) fn posture(q: &[f64]) -> Option<Posture> {
    Posture::of(&crate::arm::Configuration(<[f64; 2]>::try_from(q).ok()?))
}

/// `goal` with every continuous joint counted on by whole turns to where it is nearest to `from` (rad).
pub(crate) fn nearest_turn(arm: &PlanarArm, from: &[f64], goal: &[f64]) -> Vec<f64> {
    let joints = arm.joints().iter().zip(from.iter().zip(goal));
    joints
        .map(|(joint, (&from, &goal))| match joint.limits {
            JointLimits::Continuous => from + crate::geometry::angle_difference(from, goal),
            JointLimits::Range { .. } => goal,
        })
        .collect()
}

fn configurations(
    scene: &Scene<PlanarArm>,
    place: &Place,
    seed: u64,
    monitor: &impl Monitor,
    (end, wrap): (&'static str, fn(NotFree) -> PlanError),
) -> Result<Vec<Vec<f64>>, PlanError> {
    let not_free = |reasons| wrap(NotFree { place: place.clone(), reasons, nearest_free: None });
    let tip = match place {
        Place::Configuration(q) => {
            return match reason_against(scene, q) {
                None => Ok(vec![q.clone()]),
                Some(reason) => Err(not_free(vec![(None, reason)])),
            };
        }
        Place::Tip(tip) => *tip,
    };
    let [nearest, farthest] = scene.arm.reach();
    let distance = tip.distance(scene.arm.base());
    if !(nearest..=farthest).contains(&distance) {
        return Err(not_free(vec![(None, Reason::OutOfReach { distance, nearest, farthest })]));
    }
    let found = reaching(scene, tip, seed, monitor)?;
    if found.is_empty() {
        return Err(PlanError::EndNotFound { end, tip, tries: MOST_TRIES });
    }
    Ok(found)
}

/// Free configurations that put the tip at `tip`, different from each other.
fn reaching(
    scene: &Scene<PlanarArm>,
    tip: Point,
    seed: u64,
    monitor: &impl Monitor,
) -> Result<Vec<Vec<f64>>, PlanError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for _ in 0..MOST_TRIES {
        if found.len() == ENOUGH {
            break;
        }
        if !monitor.keep_going() {
            return Err(PlanError::Stopped);
        }
        let from: Vec<f64> = scene.arm.joints().iter().map(|joint| drawn(joint, &mut rng)).collect();
        let Some(q) = scene.arm.inverse_near(tip, &from) else { continue };
        let is_new = found.iter().all(|known| {
            let nearest = nearest_turn(&scene.arm, known, &q);
            joint_distance(known, &nearest) > DIFFERENT
        });
        if is_new && reason_against(scene, &q).is_none() {
            found.push(q);
        }
    }
    Ok(found)
}

/// A place of the joint (rad), evenly drawn.
fn drawn(joint: &Joint, rng: &mut ChaCha8Rng) -> f64 {
    let (min, max) = match joint.limits {
        JointLimits::Continuous => (-WIDEST_DRAW, WIDEST_DRAW),
        JointLimits::Range { min, max } => (min.max(-WIDEST_DRAW).min(max), max.min(WIDEST_DRAW).max(min)),
    };
    let unit = (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    min + unit * (max - min)
}
