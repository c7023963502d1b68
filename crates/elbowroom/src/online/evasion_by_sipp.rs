use super::safe_intervals::SafeIntervals;
use super::search::Search;
use super::settings::{Attempt, LOOK_AHEAD, PACE};
use super::sipp::{Lattice, Stay, earliest_safe_place};
use crate::arm::lerp_pair;
use crate::trajectory::{Motion, spline_along, third_point};

impl Search<'_> {
    /// A motion to where the arm can stay for good or, if there is no such place, the longest; and until when that is safe
    /// (s). None where the arm is in contact already, or will be before it can do anything.
    pub(super) fn evade_by_sipp(&self, attempt: &Attempt) -> Option<(Motion, f64)> {
        if !(self.keep_going)() {
            return None;
        }
        let step = attempt.control;
        let speeds = self.limits.iter().map(|limits| {
            let eased = attempt.vigour * (limits.acceleration * step).min(limits.jerk * step * step);
            eased.min(PACE * limits.velocity)
        });
        let speed = speeds.fold(f64::INFINITY, f64::min);
        let free = SafeIntervals {
            scene: self.known.all(),
            clearance: attempt.clearance,
            now: self.now + step,
            horizon: self.now + LOOK_AHEAD,
        };
        let start = <[f64; 2]>::try_from(third_point(self.state, step)).ok()?;
        let lattice = Lattice { step: attempt.lattice, time: attempt.lattice / speed };
        let way = earliest_safe_place(&free, &start, lattice, self.keep_going)?;
        let motion =
            spline_along(self.now, self.state, step, way.last()?.arrive, |time| place_at(&way, time))?;
        let until = self.safe_until(&motion);
        Some((motion, until))
    }
}

/// Where an arm on `way` is at `time` (s).
fn place_at(way: &[Stay], time: f64) -> Vec<f64> {
    let next = way.partition_point(|stay| stay.arrive <= time).clamp(1, way.len().max(2) - 1);
    match (way.get(next - 1), way.get(next)) {
        (Some(stay), Some(next)) => {
            let fraction = ((time - stay.leave) / (next.arrive - stay.leave)).clamp(0.0, 1.0);
            lerp_pair(&stay.q, &next.q, fraction).to_vec()
        }
        (stay, _) => stay.map_or_else(Vec::new, |stay| stay.q.to_vec()),
    }
}
