use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;
use thiserror::Error;

use super::known::{KnownError, KnownMotion, KnownScene};
use super::placed::{AWAY, still};
use super::roadmap::Kept;
use super::routes::Routes;
use super::search::{Certified, Search, standing};
use super::settings::{ASTRAY, HOLD, LOOK_EVERY};
use super::traps::Traps;
use super::update::{Decision, Update};
use crate::arm::joint_distance;
use crate::free_space::{NotFree, configurations};
use crate::planning::{PlanError, motion_limits};
use crate::scene::{Place, Scene, TwoLinkError};
use crate::trajectory::{Motion, SpeedLimits, State, TICK};
use crate::units::{Told, Units};
use crate::verify::{Verdict, Violation};

/// Why there is no replanner.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ReplanError {
    /// The arm is not one of two links.
    #[error(transparent)]
    Arm(TwoLinkError),
    /// The arm cannot stand at the goal whatever moves.
    #[error("{}", self.told(Units::SI))]
    Goal(NotFree),
    /// It cannot stand where it is, or numbers are beyond what a search serves.
    #[error(transparent)]
    Routes(#[from] PlanError),
}

impl Told for ReplanError {
    fn told(&self, units: Units) -> String {
        match self {
            Self::Goal(refused) => format!("goal: {}", refused.told(units)),
            Self::Routes(error) => error.told(units),
            Self::Arm(error) => error.to_string(),
        }
    }
}

/// Keeps an arm of two links going to a goal, safely, among obstacles that move.
///
/// What it has the arm run always ends at rest, and is verified in space and time from the arm's present position,
/// velocity and acceleration: until the arm has come to rest among all obstacles that are known of, and for eight seconds
/// more among those whose course is known. Obstacles whose course is not known may be anywhere that their maximum speed
/// allows.
pub struct Replanner {
    known: KnownScene,
    goals: Vec<[f64; 2]>,
    limits: Vec<SpeedLimits>,
    routes: Routes,
    motion: Motion,
    reaches_goal: bool,
    updates: u64,
    traps: Traps,
    rng: ChaCha8Rng,
}

/// The configurations at `goal` (rad) in which the arm of `scene` may stand whatever moves.
///
/// # Errors
/// [`ReplanError::Goal`] if there is none, [`ReplanError::Arm`].
pub fn goal_configurations(scene: &Scene, goal: &Place) -> Result<Vec<[f64; 2]>, ReplanError> {
    let still = still(scene, |_, obstacle| obstacle.motion.as_ref().map(|_| AWAY));
    configurations(still.two_link().map_err(ReplanError::Arm)?, goal).map_err(ReplanError::Goal)
}

impl Replanner {
    /// For the arm of `scene` standing at `start` (rad), to get to `goal`. The obstacles that have a motion are those that
    /// may move, whatever it is: each update is told what is known of it.
    ///
    /// # Errors
    /// [`ReplanError`] for an arm of more links than two, and where it cannot stand at the goal even without the obstacles
    /// that move, or at `start` without any.
    pub fn new(scene: Scene, start: [f64; 2], goal: &Place, seed: u64) -> Result<Self, ReplanError> {
        let goals = goal_configurations(&scene, goal)?;
        let (limits, _) = motion_limits(scene.arm());
        let mut replanner = Self {
            routes: Routes::new(&scene, start, goal)?,
            known: KnownScene::new(scene),
            goals,
            limits,
            motion: standing(&start, 0.0, HOLD),
            reaches_goal: false,
            updates: 0,
            traps: Traps::default(),
            rng: ChaCha8Rng::seed_from_u64(seed),
        };
        replanner.reaches_goal = replanner.is_at_goal(&State::rest(&start));
        Ok(replanner)
    }

    /// The motion that runs; before its start and after its end the arm stands.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Whether it ends at a goal.
    pub fn reaches_goal(&self) -> bool {
        self.reaches_goal
    }

    /// What its roadmaps keep, past all obstacles and past the static ones. All else is as large as the scene, the motion that
    /// runs and what is known of the obstacles.
    pub fn kept(&self) -> [Kept; 2] {
        self.routes.kept()
    }

    /// Whether an arm in `state` rests at a goal.
    pub fn is_at_goal(&self, state: &State) -> bool {
        let arm = self.known.all().arm();
        let is_at = |goal: &[f64; 2]| arm.distance(goal, &state.position) < ASTRAY;
        let mut rates = state.velocity.iter().chain(&state.acceleration);
        state.position.len() == arm.links()
            && rates.all(|rate| rate.abs() < ASTRAY)
            && self.goals.iter().any(is_at)
    }

    /// What to do now (s), with the arm in `state` and the obstacles as they are `known` now: those that are left out stand
    /// where the scene has them. `keep_going` is asked between steps of a fraction of a millisecond to some milliseconds
    /// each; after it says no, what has been found decides.
    ///
    /// # Errors
    /// [`KnownError`] where what is known is not of this scene; the motion that runs is as it was then.
    pub fn update(
        &mut self,
        known: &[KnownMotion],
        now: f64,
        state: &State,
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Result<Update, KnownError> {
        self.known.learn(known)?;
        self.updates += 1;
        let may_look = self.updates.is_multiple_of(LOOK_EVERY);
        let search = Search { known: &self.known, limits: &self.limits, now, state, keep_going };
        let rest = self.rest(now, state).map(|rest| (search.judge(&rest), rest));
        let (safe, faulty) = match rest {
            Some((verdict, rest)) if verdict.is_safe() => (Some((verdict, rest)), None),
            other => (None, other),
        };
        let arrives = safe.is_some() && self.reaches_goal;
        if let Some((verdict, _)) = safe.as_ref().filter(|_| arrives && !may_look) {
            return Ok(self.keep(verdict.clone()));
        }
        let arrival = if arrives { self.motion.end() } else { f64::INFINITY };
        let refused = match search.to_goal(&mut self.routes, arrival) {
            Ok(found) if self.traps.has(&search, found.trajectory.motion(), self.updates, &self.rng) => {
                Vec::new()
            }
            Ok(found) => return Ok(self.run(found, true)),
            Err(refused) => refused,
        };
        if !arrives && let Some(part) = refused.iter().find_map(|motion| search.part_of(motion, true)) {
            return Ok(self.run(part, false));
        }
        if let Some((verdict, rest)) = safe {
            let leaves = |traps: &mut Traps| traps.has(&search, &rest, self.updates, &self.rng);
            let looks = may_look && (!self.reaches_goal || leaves(&mut self.traps));
            let safer = if looks { search.safer(&rest, &mut self.rng) } else { None };
            return Ok(match safer {
                Some(safer) => self.run(safer, false),
                None => self.keep(verdict),
            });
        }
        let motion = search.evade(&mut self.rng);
        let verdict = match search.certify(motion.clone()) {
            Ok(found) => return Ok(self.run(found, false)),
            Err(verdict) => *verdict,
        };
        // A part that may lead into a trap leaves more time than one that is not safe now.
        if let Some(part) = refused.iter().find_map(|motion| search.part_of(motion, false)) {
            return Ok(self.run(part, false));
        }
        // Nothing is proved to be safe: what is safe the longest leaves the most time to find something.
        Ok(match faulty {
            Some((other, _)) if first_fault(&other) >= first_fault(&verdict) => self.keep(other),
            _ => self.stop(motion, verdict),
        })
    }

    /// What is left of the motion that runs, or of standing at its end; `None` if the arm is not on it.
    fn rest(&self, now: f64, state: &State) -> Option<Motion> {
        let planned = self.motion.at(now);
        let off = joint_distance(&planned.position, &state.position)
            .max(joint_distance(&planned.velocity, &state.velocity));
        let left = || self.motion.after(now).unwrap_or_else(|| standing(&planned.position, now, TICK));
        (off <= ASTRAY).then(left)
    }

    fn keep(&self, verdict: Verdict) -> Update {
        Update { decision: Decision::Keep, reaches_goal: self.reaches_goal, verdict }
    }

    fn run(&mut self, Certified { trajectory, verdict }: Certified, reaches_goal: bool) -> Update {
        self.motion = trajectory.motion().clone();
        self.reaches_goal = reaches_goal;
        Update { decision: Decision::New(trajectory), reaches_goal, verdict }
    }

    fn stop(&mut self, motion: Motion, verdict: Verdict) -> Update {
        self.motion = motion.clone();
        self.reaches_goal = false;
        Update { decision: Decision::Stop(motion), reaches_goal: false, verdict }
    }
}

/// When the first thing goes wrong (s); infinite if nothing does.
fn first_fault(verdict: &Verdict) -> f64 {
    verdict.violations.first().map_or(f64::INFINITY, Violation::time)
}
