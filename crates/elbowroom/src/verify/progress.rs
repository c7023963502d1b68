//! What one joint cannot help doing on its way through a sequence of intervals.

use smallvec::SmallVec;

use super::bound::ANGLE_ROUNDING;
use crate::trajectory::{SpeedLimits, Stop, least_time};

/// Places that are nearer than this count as one where two ways are compared (rad): far less than is given away of each.
const SAME: f64 = 1e-12;

/// What every way does that visits the same intervals in order: it is led by the laziest, which stays where it is until the next
/// interval lies elsewhere and then goes to the nearer end of it.
///
/// # Proof
/// Where the laziest way turns, it was at the end of an interval: any other way is there or beyond, at one time after the other. So it
/// has a farthest place between two of these times, where its velocity is zero, and from each to the next it goes at least as far.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Progress {
    /// Where it began and where it turned (rad).
    turns: SmallVec<[f64; 4]>,
    /// Where it is (rad).
    at: f64,
    /// The least time up to the last turn (s).
    spent: f64,
}

impl Progress {
    /// At rest at `start` (rad).
    pub(super) fn new(start: f64) -> Self {
        Self { turns: [start].into_iter().collect(), at: start, spent: 0.0 }
    }

    /// The way that visits `low` to `high` (rad) next.
    pub(super) fn through(&self, [low, high]: [f64; 2], limits: &SpeedLimits) -> Self {
        let to = self.at.max(low).min(high);
        let mut next = self.clone();
        if self.turns_back(to) {
            next.spent += self.run(self.at, Stop::Turn, limits);
            next.turns.push(self.at);
        }
        next.at = to;
        next
    }

    /// A lower bound of the time (s) of every such way that comes to rest at `goal` (rad) at last.
    pub(super) fn least_time(&self, goal: f64, limits: &SpeedLimits) -> f64 {
        let to = self.through([goal; 2], limits);
        to.spent + to.run(goal, Stop::Rest, limits)
    }

    /// Where it is (rad).
    pub(super) fn at(&self) -> f64 {
        self.at
    }

    /// Whether all that is known of this way is true of every way of which `other` is known.
    pub(super) fn is_implied_by(&self, other: &Self) -> bool {
        let mut visited = other.turns.iter().chain([&other.at]).peekable();
        if self.turns[0] != other.turns[0] {
            return false;
        }
        let mut before = self.turns[0];
        self.turns[1..].iter().chain([&self.at]).all(|&place| {
            let goes_up = place >= before;
            let is_beyond = |other: f64| if goes_up { other >= place - SAME } else { other <= place + SAME };
            before = place;
            // One place may do for the next as well.
            while visited.next_if(|other| !is_beyond(**other)).is_some() {}
            visited.peek().is_some()
        })
    }

    fn last(&self) -> f64 {
        self.turns[self.turns.len() - 1]
    }

    /// Whether it has to turn to get to `to`.
    fn turns_back(&self, to: f64) -> bool {
        (to - self.at) * (self.at - self.last()) < 0.0
    }

    /// The least time (s) from the last turn to `to`, beyond it, a little given away for rounding.
    fn run(&self, to: f64, stop: Stop, limits: &SpeedLimits) -> f64 {
        let from = if self.turns.len() == 1 { Stop::Rest } else { Stop::Turn };
        least_time((to - self.last()).abs() - 4.0 * ANGLE_ROUNDING, limits, [from, stop])
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::{Rng, SeedableRng};

    use super::*;
    use crate::random::within;
    use crate::trajectory::{Motion, Via, fastest_durations, quintic_through};

    const LIMITS: SpeedLimits = SpeedLimits { velocity: 1.5, acceleration: 4.0, jerk: 20.0 };

    /// A motion of one joint through random places.
    fn motion(rng: &mut ChaCha8Rng) -> Motion {
        let places: Vec<[f64; 1]> = (0..2 + rng.next_u64() % 4).map(|_| [within(rng, -2.0, 2.0)]).collect();
        let stop = |i: usize| i == 0 || i + 1 == places.len();
        let vias: Vec<Via> = places.iter().enumerate().map(|(i, q)| Via { q, stop: stop(i) }).collect();
        Motion::new(quintic_through(&vias, &fastest_durations(&vias, &[LIMITS]))).unwrap()
    }

    /// Intervals around places of `motion`, one after the other in time.
    fn intervals(rng: &mut ChaCha8Rng, motion: &Motion, size: f64) -> Vec<[f64; 2]> {
        let mut times: Vec<f64> = (0..8).map(|_| within(rng, 0.0, motion.end())).collect();
        times.sort_by(f64::total_cmp);
        let around = |time: f64| {
            let q = motion.at(time).position[0];
            [q - within(rng, 0.0, size), q + within(rng, 0.0, size)]
        };
        times.into_iter().map(around).collect()
    }

    fn through(start: f64, intervals: &[[f64; 2]]) -> Progress {
        intervals.iter().fold(Progress::new(start), |way, interval| way.through(*interval, &LIMITS))
    }

    #[test]
    fn no_motion_through_the_intervals_is_faster_and_some_are_hardly_slower() {
        let mut rng = ChaCha8Rng::seed_from_u64(5);
        let mut nearest = 0.0_f64;
        for case in 0..4_000 {
            let motion = motion(&mut rng);
            let [start, goal] = [0.0, motion.end()].map(|time| motion.at(time).position[0]);
            let intervals = intervals(&mut rng, &motion, if case % 2 == 0 { 0.05 } else { 1.0 });
            let least = through(start, &intervals).least_time(goal, &LIMITS);
            assert!(least <= motion.duration(), "{least} s of {}: {intervals:?}", motion.duration());
            nearest = nearest.max(least / motion.duration());
        }
        assert!(nearest > 0.8, "{nearest}");
    }

    #[test]
    fn out_and_back_takes_two_runs_with_a_turn_between() {
        let way = through(0.0, &[[-1.0, 1.0], [0.5, 2.0], [0.7, 0.9], [-3.0, 3.0]]);
        assert!(way.at() == 0.7 && way.turns.len() == 1);
        let runs = [(0.7, [Stop::Rest, Stop::Turn]), (0.4, [Stop::Turn, Stop::Rest])];
        let known: f64 = runs.iter().map(|&(way, stops)| least_time(way, &LIMITS, stops)).sum();
        assert!((way.least_time(0.3, &LIMITS) - known).abs() < 1e-6);
        assert!((way.least_time(1.3, &LIMITS) - least_time(1.3, &LIMITS, [Stop::Rest; 2])).abs() < 1e-6);
    }

    #[test]
    fn what_is_implied_is_done_by_whoever_does_the_other() {
        let mut rng = ChaCha8Rng::seed_from_u64(6);
        let (mut implied, mut not) = (0, 0);
        for _ in 0..4_000 {
            let motion = motion(&mut rng);
            let start = motion.at(0.0).position[0];
            let narrow = intervals(&mut rng, &motion, 0.3);
            let wide: Vec<[f64; 2]> = narrow.iter().map(|[low, high]| [low - 0.2, high + 0.2]).collect();
            let [one, other] = [through(start, &wide), through(start, &narrow)];
            assert!(one.is_implied_by(&other), "{wide:?} in {narrow:?}");
            // Of two that have nothing to do with each other: whoever does what the one asks, stop by stop, does what the other asks.
            let elsewhere: Vec<[f64; 2]> =
                (0..4).map(|_| within(&mut rng, -2.0, 2.0)).map(|low| [low, low + 0.5]).collect();
            let another = through(start, &elsewhere);
            if another.is_implied_by(&other) {
                implied += 1;
                let mut stops = other.turns[1..].iter().chain([&other.at]).copied();
                let visits = |place: f64, up: bool| {
                    move |at: f64| if up { at >= place - 1e-9 } else { at <= place + 1e-9 }
                };
                let mut before = start;
                let mut at = start;
                for &place in another.turns[1..].iter().chain([&another.at]) {
                    let is_there = visits(place, place >= before);
                    while !is_there(at) {
                        at = stops.next().expect("it goes there");
                    }
                    before = place;
                }
            } else {
                not += 1;
            }
        }
        assert!(implied > 100 && not > 100, "{implied}, {not}");
    }
}
