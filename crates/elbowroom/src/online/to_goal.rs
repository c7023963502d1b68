use super::routes::Routes;
use super::search::{Certified, Search, after_waiting};
use super::settings::{ROUNDS, STRETCHES, TIGHTER, TOLERANCE, WAITS, WORTH_CHANGING};
use crate::arm::Configuration;
use crate::path::{JointPath, simplify};
use crate::trajectory::{Motion, Piece, brake, departing, fastest_durations, quintic_through, vias_at};

impl Search<'_> {
    /// The safe motion to a goal that arrives first, at least a little before `arrival` (s): at once past the obstacles
    /// as they are, or past the static ones, after a wait where it must be.
    ///
    /// # Errors
    /// Where there is none, motions to a goal of which a first part may be safe.
    pub(super) fn to_goal(&self, routes: &mut Routes, arrival: f64) -> Result<Certified, Vec<Motion>> {
        let mut refused: Vec<Motion> = Vec::new();
        let Some(here) = pair(&self.state.position) else { return Err(refused) };
        let mut best: Option<Certified> = None;
        let latest =
            |best: &Option<Certified>| best.as_ref().map_or(arrival - WORTH_CHANGING, Certified::end);
        let all = routes.past_all(self.known.all(), self.now, &here, self.keep_going);
        for path in all.iter() {
            for motion in self.along(path) {
                if motion.end() < latest(&best) {
                    match self.safe(motion.clone()) {
                        Some(found) => best = Some(found),
                        None => refused.push(motion),
                    }
                }
            }
        }
        let stop = self.stop().filter(|_| (self.keep_going)());
        if let Some((there, stop)) = stop.and_then(|stop| Some((pair(&stop.at(stop.end()).position)?, stop)))
        {
            let still = routes.past_still(self.known.all(), &there, self.keep_going);
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
        best.ok_or(refused)
    }

    /// Along `path` from rest to rest, from time 0 on; no pieces where it leads nowhere.
    fn rest_to_rest(&self, path: &JointPath) -> Vec<Piece> {
        let chosen = self.simplified(path, TOLERANCE);
        let vias = vias_at(&chosen);
        if vias.len() < 2 {
            return Vec::new();
        }
        quintic_through(&vias, &fastest_durations(&vias, self.limits))
    }

    /// Motions along `path` from where the arm is, as it moves, ever closer to it.
    fn along(&self, path: &JointPath) -> Vec<Motion> {
        let mut tolerance = TOLERANCE;
        let mut motions: Vec<Motion> = Vec::new();
        let mut last = 0;
        for _ in 0..ROUNDS {
            let chosen = self.simplified(path, tolerance);
            tolerance *= TIGHTER;
            let vias = vias_at(&chosen);
            if vias.len() == last {
                continue;
            }
            last = vias.len();
            motions.extend(departing(self.now, self.state, &vias, self.limits).ok().flatten());
        }
        motions
    }

    /// Configurations of `path` that tell of it to within so many grid steps.
    fn simplified<'p>(&self, path: &'p JointPath, tolerance: f64) -> Vec<&'p Configuration> {
        let scene = self.known.all();
        let chosen = simplify(scene.arm(), &path.0, tolerance * scene.grid().step());
        chosen.into_iter().map(|i| &path.0[i]).collect()
    }

    /// As much of `motion` as is safe with a brake after it and standing there: as far as is looked ahead if `far`, for the
    /// way that is open for now may be a trap, else as long as every motion has to be.
    pub(super) fn part_of(&self, motion: &Motion, far: bool) -> Option<Certified> {
        STRETCHES.iter().filter(|stretch| **stretch < motion.duration()).find_map(|stretch| {
            if !(self.keep_going)() {
                return None;
            }
            let end = self.now + stretch;
            let first = motion.before(end)?;
            let stop = brake(end, &motion.at(end), self.limits)?;
            let part = first.then(Motion::new(vec![stop]).ok()?).ok()?;
            if far && self.safe_until(&part) < f64::INFINITY {
                return None;
            }
            self.certify(part).ok()
        })
    }
}

/// `q` as a configuration of two joints; the replanner serves no other arms.
fn pair(q: &[f64]) -> Option<[f64; 2]> {
    q.try_into().ok()
}
