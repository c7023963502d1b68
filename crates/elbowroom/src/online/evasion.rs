use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use rand_core::Rng;

use super::search::{Certified, Search, after_waiting, standing};
use super::settings::{
    ATTEMPTS, FARTHER_TRIES, HOLD, LONGEST_WAIT, MOST_TRIES, NEAREST_TRY, TRIES, WORTH_LEAVING,
};
use crate::arm::JointLimits;
use crate::random::unit;
use crate::trajectory::{Motion, State, departing, fastest_durations, quintic_through, vias_at};

/// Motions to rest, and until when the arm may stay there (s).
struct Ways {
    best: (Motion, f64),
    /// Those from whose end another may go on.
    rests: Vec<(Motion, f64)>,
}

impl Ways {
    fn consider(&mut self, motion: Motion, until: f64) {
        if until > motion.end() {
            self.rests.push((motion.clone(), until));
        }
        if until > self.best.1 {
            self.best = (motion, until);
        }
    }

    fn is_best_possible(&self) -> bool {
        self.best.1.is_infinite()
    }

    fn is_safe(&self) -> bool {
        self.best.1 >= self.best.0.end() + HOLD
    }
}

impl Search<'_> {
    /// A safe motion that is so for longer than `rest`, which leads nowhere, if that is not safe as far as is looked ahead.
    pub(super) fn safer(&self, rest: &Motion, rng: &mut ChaCha8Rng) -> Option<Certified> {
        let until = self.safe_until(rest);
        if until.is_infinite() {
            return None;
        }
        let motion = self.evade(rng);
        (self.safe_until(&motion) > until + WORTH_LEAVING).then(|| self.safe(motion)).flatten()
    }

    /// Whether the arm, standing at the end of a safe motion until something comes there at `until` (s), would be caught: whether nothing
    /// leads away for good any more, as far as is looked ahead, when it has to leave.
    pub(super) fn is_caught(&self, motion: &Motion, until: f64, rng: &ChaCha8Rng) -> bool {
        let state = State::rest(&motion.at(motion.end()).position);
        let later = Search { now: (until - HOLD).max(motion.end()), state: &state, ..*self };
        later.safe_until(&later.evade(&mut rng.clone())).is_finite()
    }

    /// A motion to rest somewhere, on the spot or at places around, with rests in between if it must be: one that is safe
    /// as far as is looked ahead, or else the one that is safe the longest.
    ///
    /// Random ways come first, for mostly one of the first will do; then searches in space and time, which miss little: a
    /// quick one, and others where nothing is safe.
    pub(super) fn evade(&self, rng: &mut ChaCha8Rng) -> Motion {
        let stop = self.stop().unwrap_or_else(|| standing(&self.state.position, self.now, HOLD));
        let until = self.safe_until(&stop);
        let mut ways = Ways { rests: vec![(stop.clone(), until)], best: (stop, until) };
        self.try_random(0..TRIES, &mut ways, rng);
        for (i, attempt) in ATTEMPTS.iter().enumerate() {
            if ways.is_best_possible() || (ways.is_safe() && i > 0) {
                break;
            }
            self.evade_by_sipp(attempt).into_iter().for_each(|(motion, until)| ways.consider(motion, until));
        }
        if !ways.is_safe() {
            self.try_random(TRIES..MOST_TRIES, &mut ways, rng);
        }
        ways.best.0
    }

    /// Straight turns to random places, from where the arm is or from where it could come to rest.
    fn try_random(&self, tries: Range<usize>, ways: &mut Ways, rng: &mut ChaCha8Rng) {
        for i in tries {
            if ways.is_best_possible() || !(self.keep_going)() {
                break;
            }
            let far = NEAREST_TRY + FARTHER_TRIES * (i % TRIES) as f64 / TRIES as f64;
            let motion = if i % 2 == 0 {
                let places = [self.state.position.clone(), self.near(&self.state.position, far, rng)];
                departing(self.now, self.state, &vias_at(&places), self.limits).ok().flatten()
            } else {
                let (way, until) = &ways.rests[(rng.next_u64() % ways.rests.len() as u64) as usize];
                let wait = unit(rng) * (until - way.end()).clamp(0.0, LONGEST_WAIT);
                let to = self.near(&way.at(way.end()).position, far, rng);
                self.going_on(way, wait, &to)
            };
            let Some(motion) = motion else { continue };
            let until = self.safe_until(&motion);
            ways.consider(motion, until);
        }
    }

    /// `way`, a wait (s) at its end, and a straight joint motion to rest at `to` (rad).
    fn going_on(&self, way: &Motion, wait: f64, to: &[f64]) -> Option<Motion> {
        let places = [way.at(way.end()).position, to.to_vec()];
        let vias = vias_at(&places);
        after_waiting(way, wait, &quintic_through(&vias, &fastest_durations(&vias, self.limits)))
    }

    /// A random place no farther than `far` (rad) from `q` in any joint, within the limits.
    fn near(&self, q: &[f64], far: f64, rng: &mut ChaCha8Rng) -> Vec<f64> {
        let joints = q.iter().zip(self.known.all().arm().joints());
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
