//! Polynomials over time: end conditions, continuity, peaks, and the choice of vias.

use elbowroom::trajectory::{
    Curve, Interpolated, Motion, MotionError, Piece, Samples, SamplesError, SpeedLimits, State, TICK,
    durations_by_length, fastest_durations, interpolate, quartic, quintic_through, random_vias, rescaled,
    stretch, vias_at,
};

/// Seeded uniform numbers in [-1, 1).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn state(&mut self) -> State {
        let mut pair = |scale: f64| vec![self.next() * scale, self.next() * scale];
        State { position: pair(3.0), velocity: pair(2.0), acceleration: pair(5.0), jerk: vec![0.0; 2] }
    }

    fn configurations(&mut self, count: usize) -> Vec<[f64; 2]> {
        (0..count).map(|_| [self.next() * 3.0, self.next() * 2.0]).collect()
    }
}

fn near(a: impl AsRef<[f64]>, b: impl AsRef<[f64]>, tolerance: f64) -> bool {
    let (a, b) = (a.as_ref(), b.as_ref());
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

#[test]
fn quintic_meets_its_six_end_conditions() {
    let mut numbers = Numbers(1);
    for _ in 0..10_000 {
        let (from, to) = (numbers.state(), numbers.state());
        let duration = 0.05 + 5.0 * numbers.next().abs();
        let piece = Piece::quintic(2.0, duration, &from, &to);
        let (a, b) = (piece.at(0.0), piece.at(duration));
        let slack = 1e-9 * (1.0 + 1.0 / (duration * duration));
        for (got, want) in [(a, from), (b, to)] {
            assert!(near(&got.position, &want.position, slack));
            assert!(near(&got.velocity, &want.velocity, slack));
            assert!(near(&got.acceleration, &want.acceleration, slack * 10.0));
        }
    }
}

#[test]
fn rest_to_rest_is_the_smooth_step() {
    // 10 τ³ - 15 τ⁴ + 6 τ⁵ and its derivatives, whose peaks are known.
    let (h, t) = (1.7, 2.3);
    let piece = Piece::quintic(0.0, t, &State::rest(&[0.2, 0.0]), &State::rest(&[0.2 + h, -h]));
    for i in 0..=100 {
        let tau = f64::from(i) / 100.0;
        let step = tau.powi(3) * (10.0 - 15.0 * tau + 6.0 * tau * tau);
        assert!(near(piece.at(tau * t).position, [0.2 + h * step, -h * step], 1e-12));
    }
    let (velocity, acceleration, jerk) =
        (15.0 / 8.0 * h / t, 10.0 / 3f64.sqrt() * h / t.powi(2), 60.0 * h / t.powi(3));
    let only = |v, a, j| {
        let limits = SpeedLimits { velocity: v, acceleration: a, jerk: j };
        stretch(&piece, &[limits, limits])
    };
    assert!((only(velocity, 1e9, 1e9) - 1.0).abs() < 1e-12);
    assert!(
        (only(1e9, acceleration / 4.0, 1e9) - 2.0).abs() < 1e-12,
        "twice as long for a quarter of the push"
    );
    assert!((only(1e9, 1e9, jerk / 8.0) - 2.0).abs() < 1e-12);
}

#[test]
fn derivatives_are_derivatives() {
    let mut numbers = Numbers(2);
    let step = 1e-5;
    for _ in 0..1000 {
        let piece = Piece::quintic(0.0, 1.0, &numbers.state(), &numbers.state());
        let s = 0.1 + 0.8 * numbers.next().abs();
        let (before, at, after) = (piece.at(s - step), piece.at(s), piece.at(s + step));
        for j in 0..2 {
            let slope = |f: fn(&State) -> &Vec<f64>| (f(&after)[j] - f(&before)[j]) / (2.0 * step);
            let scale = 1e-5 * (1.0 + at.jerk[j].abs() * 10.0 + 3000.0);
            assert!((slope(|s| &s.position) - at.velocity[j]).abs() < scale);
            assert!((slope(|s| &s.velocity) - at.acceleration[j]).abs() < scale);
            assert!((slope(|s| &s.acceleration) - at.jerk[j]).abs() < scale);
        }
    }
}

#[test]
fn motion_through_vias_passes_them_and_is_smooth() {
    let mut numbers = Numbers(3);
    for case in 0..2000 {
        let places = numbers.configurations(2 + case % 9);
        let vias = vias_at(&places);
        let durations = durations_by_length(&vias, 10.0);
        let motion = Motion::new(quintic_through(&vias, &durations)).unwrap();
        assert!((motion.duration() - 10.0).abs() < 1e-9);
        assert!(near(motion.at(0.0).position, places[0], 0.0), "the start is exact");
        assert!(near(motion.at(10.0).position, places[places.len() - 1], 1e-9));
        assert!(near(motion.at(0.0).velocity, [0.0; 2], 0.0));
        assert!(near(motion.at(10.0).velocity, [0.0; 2], 1e-9));
        for (i, pair) in motion.pieces().windows(2).enumerate() {
            let (end, begin) = (pair[0].at(pair[0].duration), pair[1].at(0.0));
            assert!(near(&end.position, places[i + 1], 1e-9));
            assert!(near(&end.position, &begin.position, 1e-9));
            assert!(near(&end.velocity, &begin.velocity, 1e-8));
            assert!(near(&end.acceleration, &begin.acceleration, 1e-6));
        }
    }
}

#[test]
fn between_stops_the_motion_is_straight() {
    let mut numbers = Numbers(4);
    for _ in 0..500 {
        let places = numbers.configurations(2);
        let vias = vias_at(&places);
        let piece = &quintic_through(&vias, &[1.5])[0];
        for i in 0..=20 {
            let q = piece.at(1.5 * f64::from(i) / 20.0).position;
            let along: [f64; 2] = std::array::from_fn(|j| places[1][j] - places[0][j]);
            let cross = (q[0] - places[0][0]) * along[1] - (q[1] - places[0][1]) * along[0];
            assert!(cross.abs() < 1e-12);
        }
    }
}

#[test]
fn repeated_vias_and_standing_still() {
    let a = [0.1, 0.2];
    let b = [0.5, -0.2];
    assert_eq!(vias_at(&[a, a, b, b, b]).len(), 2);
    let places = [a, a];
    let vias = vias_at(&places);
    let durations = durations_by_length(&vias, 10.0);
    let motion = Motion::new(quintic_through(&vias, &durations)).unwrap();
    assert_eq!((motion.duration(), motion.at(3.0)), (0.0, State::rest(&a)));
}

#[test]
fn fastest_is_within_limits_and_close_to_them() {
    let mut numbers = Numbers(5);
    for case in 0..500 {
        let places = numbers.configurations(2 + case % 8);
        let vias = vias_at(&places);
        let limit =
            |scale: f64| SpeedLimits { velocity: scale, acceleration: 3.0 * scale, jerk: 20.0 * scale };
        let limits = [limit(0.5 + numbers.next().abs()), limit(0.5 + numbers.next().abs())];
        let durations = fastest_durations(&vias, &limits);
        let pieces = quintic_through(&vias, &durations);
        let worst = pieces.iter().map(|piece| stretch(piece, &limits)).fold(0.0, f64::max);
        assert!(worst <= 1.0 && worst > 0.9, "worst stretch {worst}");
        for duration in &durations {
            let ticks = duration / TICK;
            assert!((ticks - ticks.round()).abs() < 1e-9 && ticks.round() >= 1.0, "{duration} s");
        }
        for piece in &pieces {
            for i in 0..=200 {
                let state = piece.at(piece.duration * f64::from(i) / 200.0);
                for (j, limit) in limits.iter().enumerate() {
                    assert!(state.velocity[j].abs() <= limit.velocity * (1.0 + 1e-12));
                    assert!(state.acceleration[j].abs() <= limit.acceleration * (1.0 + 1e-12));
                    assert!(state.jerk[j].abs() <= limit.jerk * (1.0 + 1e-12));
                }
            }
        }
        let proportional = durations_by_length(&vias, 1.0);
        let stretched = quintic_through(&vias, &proportional);
        let plain = stretched.iter().map(|piece| stretch(piece, &limits)).fold(0.0, f64::max);
        let rounding = 3.0 * TICK * durations.len() as f64;
        assert!(
            durations.iter().sum::<f64>() <= plain * (1.0 + 1e-6) + rounding,
            "evening out never costs time"
        );
    }
}

#[test]
fn pieces_that_make_no_motion() {
    let piece = |start: f64, duration: f64| Piece { start, duration, coefficients: vec![[0.0; 6]; 2] };
    assert_eq!(Motion::new(vec![]), Err(MotionError::Empty));
    assert!(matches!(
        Motion::new(vec![piece(0.0, 1.0), piece(1.5, 1.0)]),
        Err(MotionError::Gap { piece: 1, .. })
    ));
    assert!(matches!(
        Motion::new(vec![piece(0.0, 1.0), piece(1.0, 0.0)]),
        Err(MotionError::Duration { piece: 1, .. })
    ));
    assert!(matches!(Motion::new(vec![piece(0.0, -1.0)]), Err(MotionError::Duration { piece: 0, .. })));
    assert!(matches!(Motion::new(vec![piece(0.0, f64::NAN)]), Err(MotionError::NotFinite { piece: 0 })));
    let narrower = Piece { coefficients: vec![[0.0; 6]], ..piece(1.0, 1.0) };
    assert_eq!(
        Motion::new(vec![piece(0.0, 1.0), narrower]),
        Err(MotionError::Joints { piece: 1, found: 1, joints: 2 })
    );
    let mut bad = piece(0.0, 1.0);
    bad.coefficients[1][5] = f64::INFINITY;
    assert_eq!(Motion::new(vec![bad]), Err(MotionError::NotFinite { piece: 0 }));
    assert!(Motion::new(vec![piece(0.0, 0.0)]).is_ok(), "an arm that is already there");
}

#[test]
fn random_vias_are_seeded_ordered_and_evenly_drawn() {
    assert_eq!(random_vias(50, 5, 9), random_vias(50, 5, 9));
    assert_ne!(random_vias(50, 5, 9), random_vias(50, 5, 10));
    assert_eq!(random_vias(1, 5, 0), [0]);
    assert_eq!(random_vias(2, 5, 0), [0, 1]);
    assert_eq!(random_vias(4, 5, 0), [0, 1, 2, 3]);
    assert!(random_vias(0, 5, 0).is_empty());
    let mut counts = [0; 20];
    for seed in 0..20_000 {
        let vias = random_vias(20, 6, seed);
        assert_eq!(vias.len(), 8);
        assert!(vias.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!((vias[0], vias[7]), (0, 19));
        vias.iter().for_each(|&place| counts[place] += 1);
    }
    for count in &counts[1..19] {
        // 20,000 draws at 1/3 each: six standard deviations are 400.
        assert!((count - 6667i32).abs() < 400, "{counts:?}");
    }
}

#[test]
fn a_rescaled_motion_lasts_what_was_asked_and_meets_its_vias_on_ticks() {
    let durations = [0.3, 0.51, 0.2, 1.0];
    for total in [1.0, 2.01, 2.5, 7.77, 30.0] {
        let scaled = rescaled(&durations, total);
        assert!((scaled.iter().sum::<f64>() - total).abs() < 1e-12);
        let mut end = 0.0;
        for duration in &scaled[..3] {
            end += duration;
            assert!(((end / TICK) - (end / TICK).round()).abs() < 1e-6, "{end}");
        }
    }
    // Too short for a tick each: shared as they are.
    let short = rescaled(&durations, 0.02);
    assert!((short[0] / short[1] - 0.3 / 0.51).abs() < 1e-12);
}

#[test]
fn samples_become_the_curve_a_controller_would_run() {
    let rows = |rows: [[f64; 2]; 3]| rows.map(|row| row.to_vec()).to_vec();
    let times = vec![0.0, 0.5, 2.0];
    let positions = rows([[0.0, 1.0], [1.0, 0.0], [3.0, 0.5]]);
    let velocities = rows([[0.0, 0.0], [1.5, -1.0], [0.0, 2.0]]);
    let accelerations = rows([[0.5, 0.0], [-1.0, 1.0], [0.0, 3.0]]);
    let samples = |v: bool, a: bool| Samples {
        times: times.clone(),
        positions: positions.clone(),
        velocities: v.then(|| velocities.clone()),
        accelerations: a.then(|| accelerations.clone()),
    };
    for (v, a, curve) in
        [(false, false, Curve::Linear), (true, false, Curve::Cubic), (true, true, Curve::Quintic)]
    {
        let Interpolated { motion, ends, least } = interpolate(&samples(v, a)).unwrap();
        assert_eq!((least, ends, motion.pieces().len()), (curve, [curve; 2], 2));
        for (i, piece) in motion.pieces().iter().enumerate() {
            for (state, row) in [(piece.at(0.0), i), (piece.at(piece.duration), i + 1)] {
                assert!(near(&state.position, &positions[row], 1e-12));
                assert!(!v || near(&state.velocity, &velocities[row], 1e-12));
                assert!(!a || near(&state.acceleration, &accelerations[row], 1e-11));
            }
        }
    }
    let empty = Samples { times: vec![], positions: vec![], velocities: None, accelerations: None };
    assert_eq!(interpolate(&empty), Err(SamplesError::Rows { found: 0 }));
    let mut turned = samples(false, false);
    turned.times[2] = 0.5;
    assert!(matches!(interpolate(&turned), Err(SamplesError::Times { row: 3, .. })));
    let mut lost = samples(true, false);
    lost.positions[1][0] = f64::NAN;
    assert_eq!(interpolate(&lost), Err(SamplesError::NotFinite { row: 2 }));
    let mut fewer = samples(true, true);
    fewer.accelerations = Some(vec![vec![0.0; 2]]);
    assert!(matches!(
        interpolate(&fewer),
        Err(SamplesError::Counts { what: "accelerations", found: 1, rows: 3 })
    ));
    // A row without velocities has straight lines beside it.
    let mut bare = samples(true, true);
    bare.velocities.as_mut().unwrap()[0] = vec![];
    let mixed = interpolate(&bare).unwrap();
    assert_eq!((mixed.least, mixed.ends), (Curve::Linear, [Curve::Linear, Curve::Quintic]));
    assert!(near(&mixed.motion.pieces()[0].at(0.25).position, [0.5, 0.5], 1e-12));
    bare.accelerations.as_mut().unwrap()[2] = vec![];
    assert_eq!(interpolate(&bare).unwrap().ends, [Curve::Linear, Curve::Cubic]);
    // The last row moves, and no curve takes that: nobody knows what is meant.
    bare.velocities.as_mut().unwrap()[1] = vec![];
    assert_eq!(interpolate(&bare), Err(SamplesError::EndVelocity { row: 3 }));
    let mut narrower = samples(true, false);
    narrower.velocities.as_mut().unwrap()[1] = vec![0.0];
    assert_eq!(interpolate(&narrower), Err(SamplesError::Joints { row: 2, found: 1, joints: 2 }));
}

#[test]
fn lengths_of_a_motion_are_those_of_its_curve() {
    use elbowroom::arm::{Arm, Joint};
    use elbowroom::geometry::Point;
    let arm =
        Arm::new(Point::new(0.3, -0.1), vec![0.4, 0.2], 0.0, vec![Joint::CONTINUOUS; 2], false).unwrap();
    let places = [[0.2, 0.5], [1.7, 0.5]];
    let vias = vias_at(&places);
    let motion = Motion::new(quintic_through(&vias, &[2.0])).unwrap();
    // Joint 1 alone: the tip goes round a circle about the base.
    let radius = arm.tip(&[0.2, 0.5]).distance(arm.base());
    assert!((motion.tip_length(&arm) - 1.5 * radius).abs() < 1e-9);
    assert!((motion.joint_length() - 1.5).abs() < 1e-9);
    let mut numbers = Numbers(9);
    for _ in 0..100 {
        let places = numbers.configurations(5);
        let vias = vias_at(&places);
        let motion = Motion::new(quintic_through(&vias, &durations_by_length(&vias, 3.0))).unwrap();
        let samples: Vec<_> =
            (0..=40_000).map(|i| motion.at(3.0 * f64::from(i) / 40_000.0).position).collect();
        let joints: f64 = samples.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
        let tips: Vec<_> = samples.iter().map(|q| arm.tip(q)).collect();
        let tip: f64 = tips.windows(2).map(|w| w[0].distance(w[1])).sum();
        assert!((motion.joint_length() - joints).abs() < 1e-5 * joints);
        assert!((motion.tip_length(&arm) - tip).abs() < 1e-5 * tip, "{} {tip}", motion.tip_length(&arm));
    }
}

#[test]
fn a_quartic_begins_and_ends_as_asked_and_tells_its_last_acceleration() {
    let mut numbers = Numbers(9);
    for _ in 0..2000 {
        let start = [3.0, 2.0, 5.0].map(|scale| scale * numbers.next());
        let end = [3.0, 2.0].map(|scale| scale * numbers.next());
        let duration = 1.1 + numbers.next();
        let (terms, last) = quartic(start, end, duration);
        let piece = Piece { start: 0.0, duration, coefficients: vec![terms] };
        let of = |state: State| [state.position[0], state.velocity[0], state.acceleration[0]];
        assert!(near(of(piece.at(0.0)), start, 1e-12) && terms[5] == 0.0);
        let size = 1e-9 * (1.0 + 1.0 / (duration * duration));
        assert!(near(of(piece.at(duration)), [end[0], end[1], last], size));
    }
}
