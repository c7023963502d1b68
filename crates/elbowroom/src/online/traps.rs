//! Goals at which the arm would be caught.

use rand_chacha::ChaCha8Rng;

use super::search::Search;
use super::settings::{LOOK_EVERY, LOOKS_PER_TRAP};
use crate::trajectory::Motion;

/// Times this near to each other are the same contact (s).
const SAME_TIME: f64 = 0.1;

/// What was found out last: when something comes to a goal (s), in which update that was looked at, and whether the arm would be caught.
#[derive(Debug, Default)]
pub(super) struct Traps(Option<(f64, u64, bool)>);

impl Traps {
    /// Whether `motion`, a safe one, leads where the arm would be caught: something is known to come there, as far as is looked ahead,
    /// and when the arm has to leave nothing leads away any more.
    pub(super) fn has(
        &mut self,
        search: &Search<'_>,
        motion: &Motion,
        update: u64,
        rng: &ChaCha8Rng,
    ) -> bool {
        let until = search.safe_until(motion);
        if until.is_infinite() {
            return false;
        }
        match self.0 {
            Some((known, at, caught))
                if (known - until).abs() < SAME_TIME && update - at < LOOK_EVERY * LOOKS_PER_TRAP =>
            {
                caught
            }
            _ => {
                let caught = search.is_caught(motion, until, rng);
                self.0 = Some((until, update, caught));
                caught
            }
        }
    }
}
