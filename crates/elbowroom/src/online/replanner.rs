use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;
use thiserror::Error;

use super::routes::Routes;
use super::search::{HOLD, Search, standing};
use crate::arm::{Configuration, joint_distance};
use crate::free_space::{NotFree, configurations};
use crate::planners::{PlanError, motion_limits};
use crate::scene::{Mover, Place, Scene};
use crate::trajectory::{Motion, SpeedLimits, State, TICK};
use crate::verify::{Verdict, Violation};

/// Updates between two looks for a motion that is better than the safe one that runs.
const LOOK_EVERY: u64 = 10;

/// How far the arm may be from where its motion has it before the motion counts as lost (rad, rad/s).
const ASTRAY: f64 = 1e-6;

/// What the arm is to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Decision {
    /// Go on: the motion that runs is still safe.
    Keep,
    /// Run this motion from now on; it takes over where the arm is, without a jump.
    New(Motion),
    /// Come to rest on this motion: nothing better was found in time.
    Stop(Motion),
}

/// What an update came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Update {
    /// What the arm is to do.
    pub decision: Decision,
    /// Whether the motion that now runs ends at a goal.
    pub reaches_goal: bool,
    /// What the verifier says of what is left of it, until it has come to rest and, among obstacles whose course is
    /// known, for eight seconds more. Not safe only where nothing safe was found, braking included.
    pub verdict: Verdict,
}

/// Why there is no replanner.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ReplanError {
    /// The arm cannot stand at the goal whatever moves.
    #[error("goal: {0}")]
    Goal(NotFree),
    /// It cannot stand where it is, or numbers are beyond what a search serves.
    #[error(transparent)]
    Routes(#[from] PlanError),
}

/// Keeps an arm of two links going to a goal, safely, among obstacles that move.
///
/// What it has the arm run always ends at rest, and is verified in space and time from the arm's present position,
/// velocity and acceleration: until the arm has come to rest among all obstacles that are known of, and for eight seconds
/// more among those whose course is known. Obstacles whose course is not known may be anywhere that their greatest speed
/// allows.
pub struct Replanner {
    scene: Scene,
    limits: Vec<SpeedLimits>,
    routes: Routes,
    motion: Motion,
    reaches_goal: bool,
    updates: u64,
    rng: ChaCha8Rng,
}

impl Replanner {
    /// For the arm of `scene` standing at `start`, to get to `goal`. The scene's obstacles are where it has them as long
    /// as no mover says otherwise.
    ///
    /// # Errors
    /// [`ReplanError`] where the arm cannot stand at the goal even without the obstacles that are in `movers`, or at
    /// `start` without any.
    pub fn new(
        scene: Scene,
        movers: &[Mover],
        start: Configuration<2>,
        goal: &Place,
        seed: u64,
    ) -> Result<Self, ReplanError> {
        let mut still = scene.clone();
        let mut index = 0;
        still.obstacles.retain(|_| {
            index += 1;
            movers.iter().all(|mover| mover.obstacle() != index - 1)
        });
        let goals = configurations(&still, goal).map_err(ReplanError::Goal)?;
        let (limits, _) = motion_limits(&scene.arm);
        let reaches_goal = goals.iter().any(|goal| goal.distance(&start) < ASTRAY);
        Ok(Self {
            routes: Routes::new(&scene, &start, goal)?,
            limits,
            motion: standing(&start.0, 0.0, HOLD),
            reaches_goal,
            updates: 0,
            rng: ChaCha8Rng::seed_from_u64(seed),
            scene,
        })
    }

    /// The motion that runs; before its start and after its end the arm stands.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Whether it ends at a goal.
    pub fn reaches_goal(&self) -> bool {
        self.reaches_goal
    }

    /// What to do now (s), with the arm in `state` and `movers` as they are known now. `keep_going` is asked between
    /// steps of a fraction of a millisecond to some milliseconds each; after it says no, what has been found decides.
    pub fn update(
        &mut self,
        movers: &[Mover],
        now: f64,
        state: &State,
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> Update {
        self.updates += 1;
        let search = Search::new((&self.scene, &self.limits), movers, now, state, keep_going);
        let rest = self.rest(now, state);
        let verdict_of_rest = rest.as_ref().map(|rest| search.judge(rest));
        let is_safe = verdict_of_rest.as_ref().is_some_and(Verdict::is_safe);
        if is_safe && self.reaches_goal && !self.updates.is_multiple_of(LOOK_EVERY) {
            return self.keep(verdict_of_rest);
        }
        let arrival = if is_safe && self.reaches_goal { self.motion.end() } else { f64::INFINITY };
        let refused = match search.to_goal(&mut self.routes, arrival) {
            Ok((motion, verdict)) => return self.run(motion, true, verdict),
            Err(refused) => refused,
        };
        if arrival.is_infinite()
            && let Some((motion, verdict)) = refused.iter().find_map(|motion| search.part_of(motion, true))
        {
            return self.run(motion, false, verdict);
        }
        if is_safe {
            let may_look = !self.reaches_goal && self.updates.is_multiple_of(LOOK_EVERY);
            let safer = rest.filter(|_| may_look).and_then(|rest| search.safer(&rest, &mut self.rng));
            return match safer {
                Some((motion, verdict)) => self.run(motion, false, verdict),
                None => self.keep(verdict_of_rest),
            };
        }
        let motion = search.retreat(&mut self.rng);
        let verdict = search.judge(&motion);
        if verdict.is_safe() {
            return self.run(motion, false, verdict);
        }
        // A part that may lead into a trap leaves more time than one that is not safe now.
        if let Some((motion, verdict)) = refused.iter().find_map(|motion| search.part_of(motion, false)) {
            return self.run(motion, false, verdict);
        }
        // Nothing is proved to be safe: what is safe the longest leaves the most time to find something.
        let going_on =
            rest.zip(verdict_of_rest).filter(|(_, other)| first_fault(other) >= first_fault(&verdict));
        if let Some((_, verdict)) = going_on {
            return self.keep(Some(verdict));
        }
        self.motion = motion.clone();
        self.reaches_goal = false;
        Update { decision: Decision::Stop(motion), reaches_goal: false, verdict }
    }

    /// What is left of the motion that runs, or of standing at its end; `None` if the arm is not on it.
    fn rest(&self, now: f64, state: &State) -> Option<Motion> {
        let planned = self.motion.at(now);
        let off = joint_distance(&planned.position, &state.position)
            .max(joint_distance(&planned.velocity, &state.velocity));
        let left = || self.motion.after(now).unwrap_or_else(|| standing(&planned.position, now, TICK));
        (off <= ASTRAY).then(left)
    }

    fn keep(&self, verdict: Option<Verdict>) -> Update {
        let verdict = verdict.unwrap_or_else(|| Verdict {
            violations: Vec::new(),
            least_clearance: None,
            joint_margins: Vec::new(),
            motion_margins: Vec::new(),
            posture_changes: Vec::new(),
        });
        Update { decision: Decision::Keep, reaches_goal: self.reaches_goal, verdict }
    }

    fn run(&mut self, motion: Motion, reaches_goal: bool, verdict: Verdict) -> Update {
        self.motion = motion.clone();
        self.reaches_goal = reaches_goal;
        Update { decision: Decision::New(motion), reaches_goal, verdict }
    }
}

/// When the first thing goes wrong (s); infinite if nothing does.
fn first_fault(verdict: &Verdict) -> f64 {
    verdict.violations.first().map_or(f64::INFINITY, Violation::time)
}
