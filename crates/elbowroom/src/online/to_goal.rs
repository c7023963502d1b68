use super::routes::Routes;
use super::search::{Search, after_waiting};
use crate::arm::Configuration;
use crate::path::{JointPath, simplify};
use crate::trajectory::{
    Motion, Piece, State, brake, departing, fastest_durations, quintic_through, vias_at,
};
use crate::verify::Verdict;

/// How long the arm may wait before it goes (s), tried one after the other.
const WAITS: [f64; 10] = [0.0, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.5, 6.5];

/// How much earlier (s) another motion has to arrive to be preferred to the one that runs.
const WORTH_CHANGING: f64 = 0.25;

/// How long the arm follows a motion that is not safe to its end before it brakes (s), tried one after the other.
const STRETCHES: [f64; 4] = [1.2, 0.6, 0.3, 0.1];

/// How far a motion may stray from a path before the verifier is asked, in grid steps.
const TOLERANCE: f64 = 1.0;

/// Rounds of following the path more closely where the verifier refuses.
const ROUNDS: usize = 3;

impl Search<'_> {
    /// The safe motion to a goal that arrives first, at least a little before `arrival` (s): at once past the obstacles
    /// as they are, or past those that stand still, after a wait where it must be.
    ///
    /// # Errors
    /// Where there is none, motions to a goal of which a first part may be safe.
    pub(super) fn to_goal(
        &self,
        routes: &mut Routes,
        arrival: f64,
    ) -> Result<(Motion, Verdict), Vec<Motion>> {
        let mut refused: Vec<Motion> = Vec::new();
        let [a, b] = self.state.position[..] else { return Err(refused) };
        let here = Configuration([a, b]);
        let mut best: Option<(Motion, Verdict)> = None;
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
            let end = stop.at(stop.end()).position;
            let there = Configuration([end[0], end[1]]);
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
        best.ok_or(refused)
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

    /// As much of `motion` as is safe with a brake after it and standing there: as far as is looked ahead if `far`, for the
    /// way that is open for now may be a trap, else as long as every motion has to be.
    pub(super) fn part_of(&self, motion: &Motion, far: bool) -> Option<(Motion, Verdict)> {
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
            let verdict = self.judge(&part);
            verdict.is_safe().then_some((part, verdict))
        })
    }
}
