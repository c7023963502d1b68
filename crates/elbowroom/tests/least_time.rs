//! The least time of one joint against closed forms, numerical integration, and linear programs over pieces of constant jerk.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use elbowroom::trajectory::{SpeedLimits, Stop, least_time, least_time_of_start};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

const NONE: f64 = f64::INFINITY;

/// Ten to the power of something evenly drawn.
fn magnitude(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    10f64.powf(low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64)
}

fn drawn(rng: &mut ChaCha8Rng, spread: f64, some_are_none: bool) -> SpeedLimits {
    let mut limit = || {
        let value = magnitude(rng, -spread, spread);
        if some_are_none && rng.next_u64().is_multiple_of(4) { NONE } else { value }
    };
    SpeedLimits { velocity: limit(), acceleration: limit(), jerk: limit() }
}

/// The time of the double-S from rest to rest, case by case as in textbooks (Biagiotti and Melchiorri 2008, 3.4).
fn double_s(distance: f64, limits: &SpeedLimits) -> f64 {
    let &SpeedLimits { velocity: v, acceleration: a, jerk: j } = limits;
    let rise = a / j;
    match (v.is_finite(), a.is_finite(), j.is_finite()) {
        (false, false, false) => return 0.0,
        (true, false, false) => return distance / v,
        _ => {}
    }
    // Jerk alone; with acceleration; with velocity.
    let by_jerk = if j.is_finite() { 4.0 * (distance / (2.0 * j)).cbrt() } else { 0.0 };
    let by_both = if a.is_finite() {
        let rise = if j.is_finite() { rise } else { 0.0 };
        let steady = (rise * rise + 4.0 * distance / a).sqrt() + rise;
        if by_jerk / 4.0 < rise && j.is_finite() { by_jerk } else { steady }
    } else {
        by_jerk
    };
    let ramp = match (a.is_finite(), j.is_finite()) {
        (true, true) if v * j >= a * a => v / a + rise,
        (true, false) => v / a,
        _ => 2.0 * (v / j).sqrt(),
    };
    if distance >= v * ramp { distance / v + ramp } else { by_both }
}

#[test]
fn from_rest_to_rest_it_is_the_double_s() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for case in 0..20_000 {
        let limits = drawn(&mut rng, if case % 10 == 0 { 6.0 } else { 2.0 }, true);
        let distance = magnitude(&mut rng, -6.0, 4.0);
        let (time, known) = (least_time(distance, &limits, [Stop::Rest; 2]), double_s(distance, &limits));
        assert!((time - known).abs() <= 1e-12 * known, "{distance} under {limits:?}: {time}, {known}");
    }
}

#[test]
fn nowhere_to_go_takes_no_time_and_what_is_not_limited_costs_none() {
    let limits = SpeedLimits { velocity: 1.0, acceleration: 2.0, jerk: 3.0 };
    let free = SpeedLimits { velocity: NONE, acceleration: NONE, jerk: NONE };
    for stops in [[Stop::Rest; 2], [Stop::Rest, Stop::Turn], [Stop::Turn, Stop::Rest], [Stop::Turn; 2]] {
        assert!([0.0, -1.0].iter().all(|&distance| least_time(distance, &limits, stops) == 0.0));
        assert!(least_time(1e3, &free, stops) == 0.0);
        let speed = SpeedLimits { velocity: 2.0, ..free };
        assert!((least_time(1e3, &speed, stops) - 500.0).abs() < 1e-9);
        assert!(least_time(1e-300, &limits, stops) < 1e-90);
    }
    assert!(least_time_of_start(0.0, &limits) == 0.0 && least_time_of_start(1.0, &free) == 0.0);
}

#[test]
fn it_grows_with_the_distance_falls_with_the_limits_and_a_turn_saves_time() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..5_000 {
        let limits = drawn(&mut rng, 3.0, true);
        let distance = magnitude(&mut rng, -4.0, 3.0);
        let more = magnitude(&mut rng, 0.0, 2.0);
        let kinds = [[Stop::Turn; 2], [Stop::Rest, Stop::Turn], [Stop::Rest; 2]];
        let times = kinds.map(|stops| least_time(distance, &limits, stops));
        let start = least_time_of_start(distance, &limits);
        let sorted = |pair: &[f64]| pair[0] <= pair[1] * (1.0 + 1e-12);
        assert!(sorted(&[start, times[2]]) && times.windows(2).all(sorted), "{start}, {times:?}: {limits:?}");
        assert!(
            (least_time(distance, &limits, [Stop::Turn, Stop::Rest]) - times[1]).abs() <= 1e-12 * times[1]
        );
        for stops in kinds {
            let farther = least_time(distance * more, &limits, stops);
            let time = least_time(distance, &limits, stops);
            assert!(sorted(&[time, farther]));
            let SpeedLimits { velocity, acceleration, jerk } = limits;
            for quicker in [
                SpeedLimits { velocity: velocity * more, ..limits },
                SpeedLimits { acceleration: acceleration * more, ..limits },
                SpeedLimits { jerk: jerk * more, ..limits },
            ] {
                assert!(sorted(&[least_time(distance, &quicker, stops), time]), "{limits:?}, {quicker:?}");
            }
            // On another scale of time.
            let scaled = SpeedLimits {
                velocity: velocity * more,
                acceleration: acceleration * more * more,
                jerk: jerk * more * more * more,
            };
            assert!((least_time(distance, &scaled, stops) * more - time).abs() <= 1e-9 * time);
        }
    }
}

/// The farthest that a joint gets in `time` between stops by pieces of constant jerk, all as long, within limits: a linear program.
fn farthest(time: f64, limits: &SpeedLimits, stops: [Stop; 2]) -> Option<f64> {
    const PIECES: usize = 60;
    let h = time / PIECES as f64;
    // In units of the time and the jerk. Unknown: the acceleration at the start, and the jerk of each piece.
    let unit = limits.jerk * time;
    let [most_a, most_v] = [limits.acceleration / unit, limits.velocity / (unit * time)];
    // Velocity bends between two knots.
    let bend = h * h * limits.jerk / 8.0 / (unit * time);
    let count = PIECES + 1;
    let (mut rows, mut most) = (Vec::new(), Vec::new());
    let mut at_most = |row: &[f64], limit: f64| {
        if limit.is_finite() {
            for sign in [1.0, -1.0] {
                rows.push(row.iter().map(|value| sign * value).collect::<Vec<f64>>());
                most.push(limit);
            }
        }
    };
    let step = 1.0 / PIECES as f64;
    let (mut a, mut v, mut d) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    a[0] = 1.0;
    at_most(&a, if stops[0] == Stop::Rest { 0.0 } else { most_a });
    for piece in 1..=PIECES {
        for i in 0..count {
            d[i] += step * v[i] + step * step / 2.0 * a[i];
            v[i] += step * a[i];
        }
        d[piece] += step * step * step / 6.0;
        v[piece] += step * step / 2.0;
        a[piece] += step;
        let jerk: Vec<f64> = (0..count).map(|i| f64::from(u8::from(i == piece))).collect();
        at_most(&jerk, 1.0);
        at_most(&a, most_a);
        at_most(&v, most_v - bend);
    }
    at_most(&v, 0.0);
    at_most(&a, if stops[1] == Stop::Rest { 0.0 } else { most_a });
    let triplets = rows.iter().enumerate().flat_map(|(r, row)| {
        row.iter().enumerate().filter(|(_, value)| **value != 0.0).map(move |(c, value)| (r, c, *value))
    });
    let (mut row, mut column, mut value) = (vec![], vec![], vec![]);
    for (r, c, v) in triplets {
        row.push(r);
        column.push(c);
        value.push(v);
    }
    let matrix = CscMatrix::new_from_triplets(rows.len(), count, row, column, value);
    let cost: Vec<f64> = d.iter().map(|value| -value).collect();
    let cones = [SupportedConeT::NonnegativeConeT(rows.len())];
    let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
    let mut solver =
        DefaultSolver::new(&CscMatrix::zeros((count, count)), &cost, &matrix, &most, &cones, settings)
            .unwrap();
    solver.solve();
    (solver.solution.status == SolverStatus::Solved).then(|| -solver.solution.obj_val * unit * time * time)
}

#[test]
fn no_pieces_of_constant_jerk_get_farther_and_fine_ones_nearly_as_far() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut judged, mut near) = (0, 0);
    for case in 0..400 {
        let jerk = magnitude(&mut rng, -1.0, 1.0);
        let mut limit =
            || if rng.next_u64().is_multiple_of(4) { NONE } else { magnitude(&mut rng, -1.0, 1.0) };
        let limits = SpeedLimits { velocity: limit(), acceleration: limit(), jerk };
        let distance = magnitude(&mut rng, -2.0, 1.0);
        let stops =
            [[Stop::Rest; 2], [Stop::Rest, Stop::Turn], [Stop::Turn, Stop::Rest], [Stop::Turn; 2]][case % 4];
        let time = least_time(distance, &limits, stops);
        let Some(found) = farthest(time, &limits, stops) else { continue };
        judged += 1;
        assert!(found <= distance * (1.0 + 1e-6), "{found} of {distance}: {limits:?}, {stops:?}");
        // Pieces much shorter than what the limits make of a ramp.
        if jerk * (time / 60.0).powi(2) < 0.05 * limits.velocity
            && jerk * time / 60.0 < 0.2 * limits.acceleration
        {
            assert!(found >= distance * 0.98, "{found} of {distance}: {limits:?}, {stops:?}");
            near += 1;
        }
    }
    assert!(judged > 350 && near > 150, "{judged}, {near}");
}

#[test]
fn a_start_covers_what_its_velocity_integrates_to() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for case in 0..300 {
        let limits = drawn(&mut rng, 1.0, case % 2 == 0);
        let distance = magnitude(&mut rng, -3.0, 1.0);
        let time = least_time_of_start(distance, &limits);
        let (mut covered, steps) = (0.0, 20_000);
        let h = time / f64::from(steps);
        // Trapezoids between exact velocities.
        let velocity = |t: f64| {
            let &SpeedLimits { velocity, acceleration, jerk } = &limits;
            let rise = acceleration / jerk;
            let speed = if acceleration.is_infinite() && jerk.is_infinite() {
                NONE
            } else if jerk.is_infinite() {
                acceleration * t
            } else if acceleration.is_infinite() || t <= rise {
                jerk * t * t / 2.0
            } else {
                acceleration * (t - rise / 2.0)
            };
            speed.min(velocity)
        };
        for k in 0..steps {
            let t = f64::from(k) * h;
            covered += h * (velocity(t) + velocity(t + h)) / 2.0;
        }
        if time > 0.0 {
            assert!((covered - distance).abs() < 1e-4 * distance, "{covered} of {distance}: {limits:?}");
        }
    }
}
