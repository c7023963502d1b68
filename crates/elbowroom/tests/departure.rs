//! Motions that begin in motion: brakes, departures, and what is left of a motion.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

use elbowroom::trajectory::{
    Motion, SpeedLimits, State, TICK, brake, departing, fastest_durations, quintic_through, vias_at,
};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

struct Numbers(ChaCha8Rng);

impl Numbers {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn places(&mut self, count: usize, joints: usize) -> Vec<Vec<f64>> {
        (0..count).map(|_| (0..joints).map(|_| self.within(-2.0, 2.0)).collect()).collect()
    }
}

fn limits(joints: usize) -> Vec<SpeedLimits> {
    vec![SpeedLimits { velocity: 1.5, acceleration: 4.0, jerk: 30.0 }; joints]
}

fn planned(numbers: &mut Numbers, joints: usize) -> Motion {
    let places = numbers.places(2 + joints, joints);
    let vias = vias_at(&places);
    let durations = fastest_durations(&vias, &limits(joints));
    Motion::new(quintic_through(&vias, &durations)).unwrap()
}

/// Greatest excess over the limits at many instants.
fn excess(motion: &Motion, limits: &[SpeedLimits]) -> f64 {
    let mut most = 0.0_f64;
    for i in 0..=4000 {
        let state = motion.at(motion.start() + motion.duration() * f64::from(i) / 4000.0);
        for (j, limit) in limits.iter().enumerate() {
            most = most
                .max(state.velocity[j].abs() / limit.velocity)
                .max(state.acceleration[j].abs() / limit.acceleration)
                .max(state.jerk[j].abs() / limit.jerk);
        }
    }
    most
}

fn near(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

#[test]
fn a_brake_takes_over_as_it_is_and_ends_at_rest_within_the_limits() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(1));
    let (mut found, mut cases) = (0, 0);
    for case in 0..400 {
        let joints = 2 + case % 3;
        let motion = planned(&mut numbers, joints);
        let at = motion.duration() * numbers.within(0.0, 1.0);
        let state = motion.at(at);
        cases += 1;
        let Some(piece) = brake(at, &state, &limits(joints)) else { continue };
        found += 1;
        let stop = Motion::new(vec![piece]).unwrap();
        let (first, last) = (stop.at(at), stop.at(stop.end()));
        assert!(near(&first.position, &state.position, 0.0) && near(&first.velocity, &state.velocity, 0.0));
        assert!(near(&first.acceleration, &state.acceleration, 1e-15));
        assert!(near(&last.velocity, &vec![0.0; joints], 1e-12), "{last:?}");
        assert!(near(&last.acceleration, &vec![0.0; joints], 1e-11), "{last:?}");
        assert!(excess(&stop, &limits(joints)) <= 1.0 + 1e-12);
        assert!((stop.duration() / TICK - (stop.duration() / TICK).round()).abs() < 1e-9);
    }
    assert!(found * 10 > cases * 9, "{found} of {cases}");
    let rest = State::rest(&[0.3, -0.2]);
    assert_eq!(brake(1.0, &rest, &limits(2)).unwrap().duration, TICK, "at rest already");
    let mad = State { velocity: vec![9.0, 0.0], ..State::rest(&[0.0, 0.0]) };
    assert_eq!(brake(0.0, &mad, &limits(2)), None, "faster than allowed at once");
}

#[test]
fn a_departure_goes_on_from_where_the_arm_is_and_keeps_the_limits() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(2));
    let (mut found, mut cases) = (0, 0);
    for case in 0..400 {
        let joints = 2 + case % 3;
        let motion = planned(&mut numbers, joints);
        let at = motion.duration() * numbers.within(0.0, 1.0);
        let state = motion.at(at);
        let mut places = vec![state.position.clone()];
        places.extend(numbers.places(1 + case % 4, joints));
        let vias = vias_at(&places);
        cases += 1;
        let Some(next) = departing(at, &state, &vias, &limits(joints)).unwrap() else { continue };
        found += 1;
        let (first, last) = (next.at(at), next.at(next.end()));
        assert!(near(&first.position, &state.position, 0.0) && near(&first.velocity, &state.velocity, 0.0));
        assert!(near(&first.acceleration, &state.acceleration, 1e-15));
        assert!(near(&last.position, places.last().unwrap(), 1e-9));
        assert!(near(&last.velocity, &vec![0.0; joints], 1e-9));
        assert!(excess(&next, &limits(joints)) <= 1.0 + 1e-9);
        for (pair, place) in next.pieces().windows(2).zip(&places[1..]) {
            let (end, begin) = (pair[0].at(pair[0].duration), pair[1].at(0.0));
            assert!(near(&end.position, place, 1e-9) && near(&end.velocity, &begin.velocity, 1e-8));
            assert!(near(&end.acceleration, &begin.acceleration, 1e-6));
        }
    }
    assert!(found * 10 > cases * 9, "{found} of {cases}");
    let alone = [vec![0.0, 0.0]];
    assert_eq!(departing(0.0, &State::rest(&[0.0, 0.0]), &vias_at(&alone), &limits(2)).unwrap(), None);
}

#[test]
fn what_is_left_of_a_motion_is_the_motion() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(3));
    for case in 0..500 {
        let motion = planned(&mut numbers, 2 + case % 3);
        let t = motion.duration() * numbers.within(0.001, 0.999);
        let (before, after) = (motion.before(t).unwrap(), motion.after(t).unwrap());
        assert!(before.start() == 0.0 && (after.start() - t).abs() < 1e-12);
        assert!((before.end() - t).abs() < 1e-12 && (after.end() - motion.end()).abs() < 1e-9);
        for i in 0..=100 {
            let time = motion.duration() * f64::from(i) / 100.0;
            let part = if time < t { &before } else { &after };
            let (a, b) = (motion.at(time), part.at(time));
            assert!(near(&a.position, &b.position, 1e-12) && near(&a.velocity, &b.velocity, 1e-10));
            assert!(near(&a.acceleration, &b.acceleration, 1e-9));
        }
        let joined = before.then(after).unwrap();
        assert!((joined.duration() - motion.duration()).abs() < 1e-9);
        assert_eq!(motion.after(motion.end()), None);
        assert_eq!(motion.before(0.0), None);
    }
}
