//! Rows of other tools: what is proved of them, what is not judged, and that contact knows nothing of it.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use build::circle;
use elbowroom::arm::{Joint, MotionLimits};
use elbowroom::scene::{Obstacle, Scene};
use elbowroom::trajectory::{Curve, Motion, Samples, interpolate};
use elbowroom::verify::{
    Allowance, Quantity, Rate, Rows, Unknown, Verdict, VerifySettings, Violation, verify, verify_rows,
};

/// So fast a joint gathers speed (rad/s²).
const ACCELERATION: f64 = 2.0;

fn scene(motion: MotionLimits, obstacles: Vec<Obstacle>) -> Scene {
    let joint = Joint { motion, ..Joint::CONTINUOUS };
    build::scene(build::arm_of(&[1.0, 0.5], 0.01, &[joint, Joint::CONTINUOUS]), obstacles)
}

/// Joint 1 gathers speed evenly for a second, told every `period` by positions, and by velocities too.
fn parabola(period: f64, velocities: bool) -> Motion {
    let count = (1.0 / period).round() as usize;
    let times: Vec<f64> = (0..=count).map(|i| i as f64 * period).collect();
    let positions = times.iter().map(|t| vec![0.5 * ACCELERATION * t * t, 0.0]).collect();
    let rates = times.iter().map(|t| vec![ACCELERATION * t, 0.0]).collect();
    let samples = Samples { times, positions, velocities: velocities.then_some(rates), accelerations: None };
    interpolate(&samples).unwrap().motion
}

fn judged(scene: &Scene, motion: &Motion, rows: &Rows) -> Verdict {
    let continuous = match rows.curve {
        Some(Curve::Linear) => Quantity::Position,
        Some(Curve::Cubic) => Quantity::Velocity,
        _ => Quantity::Acceleration,
    };
    let settings = VerifySettings { continuous, ..VerifySettings::default() };
    verify_rows(scene, motion, rows, &settings, &|| true)
}

fn rows(curve: Curve, quantum: f64, tolerance: f64) -> Rows {
    Rows { curve: Some(curve), quanta: vec![[quantum; 3]; 2], time_quantum: 0.0, tolerance }
}

#[test]
fn positions_alone_prove_an_acceleration_or_leave_it_open() {
    // Second differences of a parabola are its acceleration, to the last digits.
    for (limit, broken) in [(ACCELERATION * 1.0001, false), (ACCELERATION * 0.9999, true)] {
        let scene = scene(MotionLimits { acceleration: Some(limit), ..MotionLimits::default() }, vec![]);
        let verdict = judged(&scene, &parabola(0.01, false), &rows(Curve::Linear, 0.0, 0.0));
        if broken {
            let [Violation::MotionLimit { joint: 1, rate: Rate::Acceleration, value, .. }] =
                verdict.violations[..]
            else {
                panic!("{verdict:?}")
            };
            assert!((value - ACCELERATION).abs() < 1e-9, "{value}");
        } else {
            assert!(verdict.is_safe(), "{verdict:?}");
            let [one] = verdict.unjudged[..] else { panic!("{verdict:?}") };
            assert!(matches!(one.cause, Unknown::Spacing { reached: None, .. }));
            assert!((one.at_least - ACCELERATION).abs() < 1e-9);
        }
    }
}

#[test]
fn rows_far_apart_are_via_points_whose_velocity_jumps() {
    let scene = scene(MotionLimits { acceleration: Some(9.0), ..MotionLimits::default() }, vec![]);
    let verdict = judged(&scene, &parabola(0.05, false), &rows(Curve::Linear, 0.0, 0.0));
    assert!(matches!(verdict.violations[..], [Violation::Discontinuity { what: Quantity::Velocity, .. }]));
}

#[test]
fn rounding_makes_a_rate_uncertain_and_wide_differences_prove_it_all_the_same() {
    let motion = parabola(0.01, false);
    let coarse = rows(Curve::Linear, 1e-3, 0.0);
    for (limit, broken) in [(1.05 * ACCELERATION, false), (0.95 * ACCELERATION, true)] {
        let scene = scene(MotionLimits { acceleration: Some(limit), ..MotionLimits::default() }, vec![]);
        let verdict = judged(&scene, &motion, &coarse);
        assert_eq!(verdict.is_safe(), !broken, "{verdict:?}");
    }
    // Half of 1e-3 rad at either end of 0.01 s: 0.1 rad/s.
    let slow = scene(MotionLimits { velocity: Some(1.7), ..MotionLimits::default() }, vec![]);
    let unknown = judged(&slow, &parabola(0.01, false), &Rows { quanta: vec![[0.1; 3]; 2], ..coarse });
    let [one] = unknown.unjudged[..] else { panic!("{unknown:?}") };
    let Unknown::Rounding { what: Quantity::Position, quantum, spacing, error } = one.cause else {
        panic!("{unknown:?}")
    };
    assert!((quantum - 0.1).abs() < 1e-15 && (spacing - 0.01).abs() < 1e-12 && (error - 10.0).abs() < 1e-6);
}

#[test]
fn what_rounding_explains_passes_and_no_more() {
    // The speed of the last piece is 1.99 rad/s, as it is known to within 1e-4.
    let motion = parabola(0.01, false);
    for (limit, safe) in [(1.98995, true), (1.9898, false)] {
        let scene = scene(MotionLimits { velocity: Some(limit), ..MotionLimits::default() }, vec![]);
        let verdict = judged(&scene, &motion, &rows(Curve::Linear, 1e-6, 0.0));
        assert_eq!(verdict.is_safe(), safe, "{verdict:?}");
        if safe {
            assert_eq!(verdict.allowed[0].by, Allowance::Rounding);
        }
    }
}

#[test]
fn a_tolerance_counts_for_rates_and_is_told() {
    let motion = parabola(0.05, true);
    let scene = scene(MotionLimits { velocity: Some(1.99), ..MotionLimits::default() }, vec![]);
    for curve in [Some(Curve::Cubic), None] {
        let with = |tolerance| judged(&scene, &motion, &Rows { curve, tolerance, ..Rows::default() });
        let settings = |violation: &Violation| matches!(violation, Violation::MotionLimit { .. });
        assert!(with(0.001).violations.iter().any(settings));
        let verdict = with(0.01);
        assert!(!verdict.violations.iter().any(settings), "{verdict:?}");
        assert_eq!(verdict.allowed[0].by, Allowance::Tolerance);
    }
}

#[test]
fn contact_knows_no_tolerance_and_rows_that_tell_all_are_judged_as_ever() {
    let limits = MotionLimits { velocity: Some(1.5), acceleration: Some(2.1), jerk: None };
    let scene = scene(limits, vec![circle(1.2, 0.9, 0.1)]);
    let contacts = |verdict: &Verdict| -> Vec<Violation> {
        verdict.violations.iter().copied().filter(|one| matches!(one, Violation::Contact { .. })).collect()
    };
    for (period, velocities, curve) in
        [(0.01, false, Curve::Linear), (0.01, true, Curve::Cubic), (0.25, true, Curve::Cubic)]
    {
        let motion = parabola(period, velocities);
        let continuous = if velocities { Quantity::Velocity } else { Quantity::Position };
        let settings = VerifySettings { continuous, ..VerifySettings::default() };
        let strict = verify(&scene, &motion, &settings);
        assert!(!contacts(&strict).is_empty());
        for rows in [rows(curve, 0.0, 0.0), rows(curve, 1e-3, 0.0), rows(curve, 0.02, 1.0)] {
            let verdict = judged(&scene, &motion, &rows);
            assert_eq!(contacts(&verdict), contacts(&strict));
            assert_eq!(verdict.least_clearance, strict.least_clearance);
        }
        if period > 0.1 {
            let verdict = judged(&scene, &motion, &rows(curve, 0.0, 0.0));
            assert_eq!(verdict.violations, strict.violations);
        }
    }
}
