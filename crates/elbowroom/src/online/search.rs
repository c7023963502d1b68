use super::known::KnownScene;
use super::settings::{HOLD, LOOK_AHEAD, STANDS};
use crate::trajectory::{Motion, Piece, SpeedLimits, State, TICK, brake};
use crate::verify::{Trajectory, Verdict, VerifySettings, clear_until, verify};

/// One update's view of the world.
pub(super) struct Search<'a> {
    pub(super) known: &'a KnownScene,
    pub(super) limits: &'a [SpeedLimits],
    pub(super) now: f64,
    pub(super) state: &'a State,
    pub(super) keep_going: &'a (dyn Fn() -> bool + Sync),
}

/// A motion that is safe, also where it ends.
pub(super) struct Certified {
    /// To the end of the motion.
    pub(super) trajectory: Trajectory,
    /// What [`Search::judge`] says of it.
    pub(super) verdict: Verdict,
}

impl Certified {
    pub(super) fn end(&self) -> f64 {
        self.trajectory.motion().end()
    }
}

impl Search<'_> {
    /// The verifier on `motion`: to its end among all, and for [`HOLD`] more among those whose course is known.
    pub(super) fn judge(&self, motion: &Motion) -> Verdict {
        let settings = VerifySettings::default();
        if !self.known.is_certain() {
            let verdict = verify(self.known.all(), motion, &settings);
            if !verdict.is_safe() {
                return verdict;
            }
        }
        verify(self.known.certain(), &held(motion, HOLD), &settings)
    }

    /// `motion` as a trajectory if [`judge`](Self::judge) calls it safe.
    ///
    /// # Errors
    /// The verdict, if it does not.
    pub(super) fn certify(&self, motion: Motion) -> Result<Certified, Box<Verdict>> {
        let settings = VerifySettings::default();
        let (end, held) = (motion.end(), held(&motion, HOLD));
        if self.known.is_certain() {
            let whole = Trajectory::certify(self.known.all(), held, &settings)?;
            let verdict = whole.verdict().clone();
            // A motion that takes no time is its hold.
            let trajectory = whole.clone().before(end).unwrap_or(whole);
            return Ok(Certified { trajectory, verdict });
        }
        let trajectory = Trajectory::certify(self.known.all(), motion, &settings)?;
        let verdict = verify(self.known.certain(), &held, &settings);
        if verdict.is_safe() { Ok(Certified { trajectory, verdict }) } else { Err(Box::new(verdict)) }
    }

    /// Until when the arm is safe that runs `motion` and then stands for `hold` (s); infinite if it is all along. A time
    /// when it is not, which need not be the first, if `any_will_do`.
    fn clear_until(&self, motion: &Motion, hold: f64, any_will_do: bool) -> f64 {
        let settings = VerifySettings::default();
        if !self.known.is_certain() {
            let until = clear_until(self.known.all(), motion, &settings, any_will_do);
            if until < f64::INFINITY {
                return until;
            }
        }
        clear_until(self.known.certain(), &held(motion, hold), &settings, any_will_do)
    }

    /// Until when the arm is safe that runs `motion` and then stands, as far as is looked ahead (s).
    pub(super) fn safe_until(&self, motion: &Motion) -> f64 {
        self.clear_until(motion, LOOK_AHEAD, false)
    }

    /// `motion`, if it is safe: a quick look first, for most are not.
    pub(super) fn safe(&self, motion: Motion) -> Option<Certified> {
        let may_be = self.clear_until(&motion, HOLD, true) == f64::INFINITY;
        may_be.then(|| self.certify(motion).ok()).flatten()
    }

    pub(super) fn is_at_rest(&self) -> bool {
        self.state.velocity.iter().chain(&self.state.acceleration).all(|rate| rate.abs() < STANDS)
    }

    pub(super) fn stop(&self) -> Option<Motion> {
        if self.is_at_rest() {
            return Some(standing(&self.state.position, self.now, TICK));
        }
        Motion::new(vec![brake(self.now, self.state, self.limits)?]).ok()
    }
}

/// `way`, a wait (s) at its end, and then `pieces`, whose times count from there.
pub(super) fn after_waiting(way: &Motion, wait: f64, pieces: &[Piece]) -> Option<Motion> {
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

/// Standing at `q` (rad) from `start` on for so long (s).
pub(super) fn standing(q: &[f64], start: f64, duration: f64) -> Motion {
    let coefficients = q.iter().map(|&q| [q, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
    Motion::of(Piece { start, duration, coefficients })
}

/// `motion`, and standing at its end for `hold` (s); no more than `motion` where that begins later than numbers can tell.
fn held(motion: &Motion, hold: f64) -> Motion {
    let end = motion.end();
    let hold = standing(&motion.at(end).position, end, hold);
    motion.clone().then(hold).unwrap_or_else(|_| motion.clone())
}
