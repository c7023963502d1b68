use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use thiserror::Error;

use super::routes::Routes;
use crate::arm::{Configuration, JointLimits, joint_distance};
use crate::free_space::{NotFree, configurations};
use crate::path::{JointPath, simplify};
use crate::planners::{PlanError, motion_limits};
use crate::scene::{Course, Mover, Place, Scene};
use crate::trajectory::{
    Motion, Piece, SpeedLimits, State, TICK, brake, departing, fastest_durations, quintic_through, vias_at,
};
use crate::verify::{Verdict, VerifySettings, Violation, clear_until, verify_among};

/// How long a motion's end has to stay clear of obstacles whose course is known (s).
const HOLD: f64 = 8.0;

/// How long the arm may wait before it goes (s), tried one after the other.
const WAITS: [f64; 10] = [0.0, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.5, 6.5];

/// How much earlier (s) another motion has to arrive to be preferred to the one that runs.
const WORTH_CHANGING: f64 = 0.25;

/// Updates between two looks for a motion that arrives earlier.
const LOOK_EVERY: u64 = 10;

/// How long the arm follows a motion that is not safe to its end before it brakes (s), tried one after the other.
const STRETCHES: [f64; 4] = [1.2, 0.6, 0.3, 0.1];

/// How far the arm may be from where its motion has it before the motion counts as lost (rad, rad/s).
const ASTRAY: f64 = 1e-6;

/// Ways to get out of the way that are tried to find the best, and as long as none is safe.
const RETREATS: usize = 60;
const MOST_RETREATS: usize = 300;

/// How far after its end a motion out of the way is looked at (s): not needed for it to be safe, but better.
const FAR: f64 = 25.0;

/// How much longer (s) another place has to be safe for the arm to go there.
const WORTH_LEAVING: f64 = 1.0;

/// How long the arm waits at a rest on its way out of the way (s), at most.
const LONGEST_WAIT: f64 = 4.0;

/// How far a motion may stray from a path before the verifier is asked, in grid steps.
const TOLERANCE: f64 = 1.0;

/// Rounds of following the path more closely where the verifier refuses.
const ROUNDS: usize = 3;

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
        let certain = movers
            .iter()
            .map(|mover| if is_doubtful(mover) { mover.on(Course::Absent) } else { mover.clone() })
            .collect();
        let search =
            Search { scene: &self.scene, limits: &self.limits, movers, certain, now, state, keep_going };
        let rest = self.rest(now, state);
        let verdict_of_rest = rest.as_ref().map(|rest| search.judge(rest));
        let is_safe = verdict_of_rest.as_ref().is_some_and(Verdict::is_safe);
        if is_safe && self.reaches_goal && !self.updates.is_multiple_of(LOOK_EVERY) {
            return self.keep(verdict_of_rest);
        }
        let arrival = if is_safe && self.reaches_goal { self.motion.end() } else { f64::INFINITY };
        if let Some(found) = search.to_goal(&mut self.routes, arrival) {
            return self.run(found.motion, found.reaches_goal, found.verdict);
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

/// A safe motion towards a goal.
struct Found {
    motion: Motion,
    verdict: Verdict,
    /// Whether it is all of the way.
    reaches_goal: bool,
}

/// One update's view of the world.
struct Search<'a> {
    scene: &'a Scene,
    limits: &'a [SpeedLimits],
    movers: &'a [Mover],
    /// Those of them whose course is known.
    certain: Vec<Mover>,
    now: f64,
    state: &'a State,
    keep_going: &'a (dyn Fn() -> bool + Sync),
}

impl Search<'_> {
    /// The verifier on `motion`: to its end among all, and for [`HOLD`] more among those whose course is known.
    fn judge(&self, motion: &Motion) -> Verdict {
        let settings = VerifySettings::default();
        if self.movers.iter().any(is_doubtful) {
            let verdict = verify_among(self.scene, self.movers, motion, &settings, &|| true);
            if !verdict.is_safe() {
                return verdict;
            }
        }
        match held(motion, HOLD) {
            Some(held) => verify_among(self.scene, &self.certain, &held, &settings, &|| true),
            None => verify_among(self.scene, self.movers, motion, &settings, &|| true),
        }
    }

    /// Until when the arm is safe that runs `motion` and then stands for `hold` (s); infinite if it is all along. A time
    /// when it is not, which need not be the first, if `any_will_do`.
    fn clear_until(&self, motion: &Motion, hold: f64, any_will_do: bool) -> f64 {
        let settings = VerifySettings::default();
        let look = |movers: &[Mover], motion: &Motion| {
            clear_until(self.scene, movers, motion, &settings, any_will_do)
        };
        if self.movers.iter().any(is_doubtful) {
            let until = look(self.movers, motion);
            if until < f64::INFINITY {
                return until;
            }
        }
        match held(motion, hold) {
            Some(held) => look(&self.certain, &held),
            None => look(self.movers, motion),
        }
    }

    /// Until when the arm is safe that runs `motion` and then stands, as far as is looked ahead (s).
    fn safe_until(&self, motion: &Motion) -> f64 {
        self.clear_until(motion, FAR, false)
    }

    /// Whether [`judge`](Self::judge) will call `motion` safe.
    fn is_safe(&self, motion: &Motion) -> bool {
        self.clear_until(motion, HOLD, true) == f64::INFINITY
    }

    fn safe(&self, motion: Motion) -> Option<(Motion, Verdict)> {
        if !self.is_safe(&motion) {
            return None;
        }
        let verdict = self.judge(&motion);
        verdict.is_safe().then_some((motion, verdict))
    }

    fn is_at_rest(&self) -> bool {
        self.state.velocity.iter().chain(&self.state.acceleration).all(|rate| rate.abs() < 1e-9)
    }

    fn stop(&self) -> Option<Motion> {
        if self.is_at_rest() {
            return Some(standing(&self.state.position, self.now, TICK));
        }
        Motion::new(vec![brake(self.now, self.state, self.limits)?]).ok()
    }

    /// The safe motion to a goal that arrives first, at least a little before `arrival` (s): at once past the obstacles
    /// as they are, or past those that stand still, after a wait where it must be; or the first part of one.
    fn to_goal(&self, routes: &mut Routes, arrival: f64) -> Option<Found> {
        let here = Configuration(<[f64; 2]>::try_from(self.state.position.as_slice()).ok()?);
        let mut best: Option<(Motion, Verdict)> = None;
        let mut refused: Vec<Motion> = Vec::new();
        let latest = |best: &Option<(Motion, Verdict)>| {
            best.as_ref().map_or(arrival - WORTH_CHANGING, |(motion, _)| motion.end())
        };
        let all = routes.past_all(self.movers, self.now, &here, self.keep_going);
        for path in all.iter() {
            for motion in self.along(path, self.state, self.now) {
                if motion.end() < latest(&best) {
                    match self.safe(motion.clone()) {
                        Some(found) => best = Some(found),
                        None => refused.push(motion),
                    }
                }
            }
        }
        if let Some(stop) = self.stop().filter(|_| (self.keep_going)()) {
            let end = stop.at(stop.end());
            let there = Configuration(<[f64; 2]>::try_from(end.position.as_slice()).ok()?);
            let still = routes.past_still(self.movers, &there, self.keep_going);
            for path in still.iter().chain(all.iter().filter(|_| self.is_at_rest())) {
                let pieces = self.rest_to_rest(path);
                for wait in WAITS {
                    if !(self.keep_going)() || stop.end() + wait >= latest(&best) {
                        break;
                    }
                    let Some(motion) = after_waiting(&stop, wait, &pieces) else { break };
                    if motion.end() >= latest(&best) {
                        break;
                    }
                    if let Some(found) = self.safe(motion) {
                        best = Some(found);
                        break;
                    }
                }
            }
        }
        if best.is_none() && arrival.is_infinite() {
            let part = refused.iter().find_map(|motion| self.part_of(motion));
            return part.map(|(motion, verdict)| Found { motion, verdict, reaches_goal: false });
        }
        best.map(|(motion, verdict)| Found { motion, verdict, reaches_goal: true })
    }

    /// Along `path` from rest to rest, from time 0 on; no pieces where it leads nowhere.
    fn rest_to_rest(&self, path: &JointPath) -> Vec<Piece> {
        let chosen: Vec<&Configuration<2>> =
            simplify(&self.scene.arm, &path.0, TOLERANCE * self.scene.grid.step())
                .into_iter()
                .map(|i| &path.0[i])
                .collect();
        let vias = vias_at(&chosen);
        if vias.len() < 2 {
            return Vec::new();
        }
        quintic_through(&vias, &fastest_durations(&vias, self.limits))
    }

    /// Motions along `path` from a moving arm, ever closer to it.
    fn along(&self, path: &JointPath, state: &State, now: f64) -> Vec<Motion> {
        let mut tolerance = TOLERANCE * self.scene.grid.step();
        let mut motions: Vec<Motion> = Vec::new();
        let mut last = 0;
        for _ in 0..ROUNDS {
            let chosen: Vec<&Configuration<2>> =
                simplify(&self.scene.arm, &path.0, tolerance).into_iter().map(|i| &path.0[i]).collect();
            tolerance *= 0.3;
            let vias = vias_at(&chosen);
            if vias.len() == last {
                continue;
            }
            last = vias.len();
            motions.extend(departing(now, state, &vias, self.limits).ok().flatten());
        }
        motions
    }

    /// As much of `motion` as is safe with a brake after it.
    fn part_of(&self, motion: &Motion) -> Option<(Motion, Verdict)> {
        STRETCHES.iter().filter(|stretch| **stretch < motion.duration()).find_map(|stretch| {
            if !(self.keep_going)() {
                return None;
            }
            let end = self.now + stretch;
            let first = motion.before(end)?;
            let stop = brake(end, &motion.at(end), self.limits)?;
            self.safe(first.then(Motion::new(vec![stop]).ok()?).ok()?)
        })
    }

    /// A safe motion that is so for longer than `rest`, which leads nowhere, if that is not safe as far as is looked ahead.
    fn safer(&self, rest: &Motion, rng: &mut ChaCha8Rng) -> Option<(Motion, Verdict)> {
        let until = self.safe_until(rest);
        if until.is_infinite() {
            return None;
        }
        let motion = self.retreat(rng);
        (self.safe_until(&motion) > until + WORTH_LEAVING).then(|| self.safe(motion)).flatten()
    }

    /// A motion to rest somewhere, on the spot or at places around, with rests in between if it must be: one that is safe
    /// as far as is looked ahead, or else the one that is safe the longest.
    fn retreat(&self, rng: &mut ChaCha8Rng) -> Motion {
        let stop = self.stop().unwrap_or_else(|| standing(&self.state.position, self.now, HOLD));
        // Motions to rests, and until when the arm may stay there.
        let mut rests = vec![(stop.clone(), self.safe_until(&stop))];
        let (mut best, mut latest) = rests[0].clone();
        for i in 0..MOST_RETREATS {
            let is_safe = latest >= best.end() + HOLD;
            if latest.is_infinite() || (is_safe && i >= RETREATS) || !(self.keep_going)() {
                break;
            }
            let far = 0.2 + 2.8 * (i % RETREATS) as f64 / RETREATS as f64;
            let motion = if i % 2 == 0 {
                let places = [self.state.position.clone(), self.near(&self.state.position, far, rng)];
                departing(self.now, self.state, &vias_at(&places), self.limits).ok().flatten()
            } else {
                let (way, until) = &rests[(rng.next_u64() % rests.len() as u64) as usize];
                let wait = unit(rng) * (until - way.end()).clamp(0.0, LONGEST_WAIT);
                let to = self.near(&way.at(way.end()).position, far, rng);
                self.going_on(way, wait, &to)
            };
            let Some(motion) = motion else { continue };
            let until = self.safe_until(&motion);
            if until > motion.end() {
                rests.push((motion.clone(), until));
            }
            if until > latest {
                (best, latest) = (motion, until);
            }
        }
        best
    }

    /// `way`, a wait (s) at its end, and a straight turn to rest at `to` (rad).
    fn going_on(&self, way: &Motion, wait: f64, to: &[f64]) -> Option<Motion> {
        let places = [way.at(way.end()).position, to.to_vec()];
        let vias = vias_at(&places);
        after_waiting(way, wait, &quintic_through(&vias, &fastest_durations(&vias, self.limits)))
    }

    /// A random place no farther than `far` (rad) from `q` in any joint, within the stops.
    fn near(&self, q: &[f64], far: f64, rng: &mut ChaCha8Rng) -> Vec<f64> {
        let joints = q.iter().zip(self.scene.arm.joints());
        joints
            .map(|(q, joint)| {
                let to = q + far * (2.0 * unit(rng) - 1.0);
                match joint.limits {
                    JointLimits::Continuous => to,
                    JointLimits::Range { min, max } => to.clamp(min, max),
                }
            })
            .collect()
    }
}

/// `way`, a wait (s) at its end, and then `pieces`, whose times count from there.
fn after_waiting(way: &Motion, wait: f64, pieces: &[Piece]) -> Option<Motion> {
    let start = way.end() + wait;
    let mut motion = way.clone();
    if wait > 0.0 {
        motion = motion.then(standing(&way.at(way.end()).position, way.end(), wait)).ok()?;
    }
    if pieces.is_empty() {
        return Some(motion);
    }
    let later = pieces.iter().map(|piece| Piece { start: piece.start + start, ..piece.clone() }).collect();
    motion.then(Motion::new(later).ok()?).ok()
}

/// In [0, 1).
fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Whether nobody knows where it will be.
fn is_doubtful(mover: &Mover) -> bool {
    matches!(mover.course(), Course::Unknown { .. } | Course::Chase { .. })
}

/// `motion`, and standing at its end for `hold` (s).
fn held(motion: &Motion, hold: f64) -> Option<Motion> {
    let end = motion.end();
    motion.clone().then(standing(&motion.at(end).position, end, hold)).ok()
}

/// When the first thing goes wrong (s); infinite if nothing does.
fn first_fault(verdict: &Verdict) -> f64 {
    verdict.violations.first().map_or(f64::INFINITY, Violation::time)
}

/// Standing at `q` (rad) from `start` on for so long (s).
fn standing(q: &[f64], start: f64, duration: f64) -> Motion {
    let coefficients = q.iter().map(|&q| [q, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
    Motion::of(Piece { start, duration, coefficients })
}
