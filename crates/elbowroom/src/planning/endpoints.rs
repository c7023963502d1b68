//! Where a task begins and ends: the first stage of every planner.

use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;

use super::{Monitor, PlanError};
use crate::arm::{Configuration, Joint, JointLimits, Posture};
use crate::free_space::{self, NotFree, Reason, reason_against};
use crate::geometry::Point;
use crate::path::pairs;
use crate::random::within;
use crate::scene::{Place, Scene, Task, TaskPosture, TwoLinkError};

/// Configurations from which the tip is led to its place, one after the other.
const MOST_TRIES: usize = 512;

/// Different configurations after which the search ends.
const ENOUGH: usize = 16;

/// Configurations nearer to each other than this are one (rad).
const DIFFERENT: f64 = 0.1;

/// Angles drawn for a joint whose limits are farther from 0 than this are drawn as if they stood there (rad).
const WIDEST_DRAW: f64 = std::f64::consts::PI;

/// A task in configurations: any of the starts will do, and any of the goals.
#[derive(Debug, Clone, PartialEq)]
pub struct Endpoints {
    /// Free configurations.
    pub starts: Vec<Configuration>,
    /// The same.
    pub goals: Vec<Configuration>,
    /// Whether the whole motion has to keep the posture it starts in: of an arm of two links only.
    pub keep_posture: bool,
}

impl Endpoints {
    /// The free configurations of `task`: all of them where there are two links or the task names them, else some that
    /// were found from `seed`.
    ///
    /// # Errors
    /// [`PlanError::Start`], [`PlanError::Goal`] and its kin where there are none; [`PlanError::Stopped`]
    pub fn new(scene: &Scene, task: &Task, seed: u64, monitor: &dyn Monitor) -> Result<Self, PlanError> {
        let starts = free_at(scene, &task.start, seed, monitor, ("start", PlanError::Start))?;
        let mut goals = free_at(scene, &task.goal, seed, monitor, ("goal", PlanError::Goal))?;
        let links = scene.arm().links();
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
            goals.retain(|q| Posture::at(q).is_none_or(|posture| posture == wanted));
            if goals.is_empty() {
                return Err(PlanError::GoalPosture { wanted });
            }
        }
        Ok(Self { starts, goals, keep_posture: task.posture == TaskPosture::Keep })
    }

    /// A start that is a goal already.
    pub fn already_there(&self) -> Option<&Configuration> {
        self.starts.iter().find(|start| self.goals.contains(start))
    }

    /// Starts and goals as the closed forms of two links have them; none of an arm of more.
    pub fn pairs(&self) -> [Vec<[f64; 2]>; 2] {
        [pairs(&self.starts), pairs(&self.goals)]
    }
}

/// What an end of a task is called, and what it is that it is not free.
type End = (&'static str, fn(NotFree) -> PlanError);

fn free_at(
    scene: &Scene,
    place: &Place,
    seed: u64,
    monitor: &dyn Monitor,
    (end, wrap): End,
) -> Result<Vec<Configuration>, PlanError> {
    match scene.two_link() {
        Ok(scene) => {
            let found = free_space::configurations(scene, place).map_err(wrap)?;
            return Ok(found.into_iter().map(Configuration::from).collect());
        }
        Err(TwoLinkError::Links { .. }) => {}
        Err(TwoLinkError::Moving { obstacle, name }) => return Err(PlanError::Moving { obstacle, name }),
    }
    let not_free =
        |reasons| wrap(NotFree { place: place.clone(), reasons, nearest_free: None, clearance: 0.0 });
    let tip = match place {
        Place::Configuration(q) => {
            return match reason_against(scene, q) {
                None => Ok(vec![q.clone()]),
                Some(reason) => Err(not_free(vec![(None, reason)])),
            };
        }
        Place::Tip(tip) => *tip,
    };
    let [nearest, farthest] = scene.arm().reach();
    let distance = tip.distance(scene.arm().base());
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
    scene: &Scene,
    tip: Point,
    seed: u64,
    monitor: &dyn Monitor,
) -> Result<Vec<Configuration>, PlanError> {
    let arm = scene.arm();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut found: Vec<Configuration> = Vec::new();
    for _ in 0..MOST_TRIES {
        if found.len() == ENOUGH {
            break;
        }
        if !monitor.keep_going() {
            return Err(PlanError::Stopped);
        }
        let from: Configuration = arm.joints().iter().map(|joint| drawn(joint, &mut rng)).collect();
        let Some(q) = arm.inverse_near(tip, &from) else { continue };
        let is_new = found.iter().all(|known| arm.distance(known, &q) > DIFFERENT);
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
    within(rng, min, max)
}
