use crate::scene::{Course, Mover, Scene};
use crate::trajectory::{Motion, Piece, SpeedLimits, State, TICK, brake};
use crate::verify::{Verdict, VerifySettings, clear_until, verify_among};

/// How long a motion's end has to stay clear of obstacles whose course is known (s).
pub(super) const HOLD: f64 = 8.0;

/// How long it is best to stay clear (s), for motions that end elsewhere than at a goal.
pub(super) const FAR: f64 = 25.0;

/// One update's view of the world.
pub(super) struct Search<'a> {
    pub(super) scene: &'a Scene,
    pub(super) limits: &'a [SpeedLimits],
    pub(super) movers: &'a [Mover],
    /// Those of them whose course is known.
    certain: Vec<Mover>,
    pub(super) now: f64,
    pub(super) state: &'a State,
    pub(super) keep_going: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Search<'a> {
    pub(super) fn new(
        (scene, limits): (&'a Scene, &'a [SpeedLimits]),
        movers: &'a [Mover],
        now: f64,
        state: &'a State,
        keep_going: &'a (dyn Fn() -> bool + Sync),
    ) -> Self {
        let certain = movers
            .iter()
            .map(|mover| if is_doubtful(mover) { mover.on(Course::Absent) } else { mover.clone() })
            .collect();
        Self { scene, limits, movers, certain, now, state, keep_going }
    }

    /// The verifier on `motion`: to its end among all, and for [`HOLD`] more among those whose course is known.
    pub(super) fn judge(&self, motion: &Motion) -> Verdict {
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
    pub(super) fn safe_until(&self, motion: &Motion) -> f64 {
        self.clear_until(motion, FAR, false)
    }

    /// Whether [`judge`](Self::judge) will call `motion` safe.
    fn is_safe(&self, motion: &Motion) -> bool {
        self.clear_until(motion, HOLD, true) == f64::INFINITY
    }

    pub(super) fn safe(&self, motion: Motion) -> Option<(Motion, Verdict)> {
        if !self.is_safe(&motion) {
            return None;
        }
        let verdict = self.judge(&motion);
        verdict.is_safe().then_some((motion, verdict))
    }

    pub(super) fn is_at_rest(&self) -> bool {
        self.state.velocity.iter().chain(&self.state.acceleration).all(|rate| rate.abs() < 1e-9)
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

/// `motion`, and standing at its end for `hold` (s).
fn held(motion: &Motion, hold: f64) -> Option<Motion> {
    let end = motion.end();
    motion.clone().then(standing(&motion.at(end).position, end, hold)).ok()
}

/// Whether nobody knows where it will be.
fn is_doubtful(mover: &Mover) -> bool {
    matches!(mover.course(), Course::Unknown { .. } | Course::Chase { .. })
}
