//! Inverse kinematics against forward kinematics written anew here, up to and at both ends of the reach.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::f64::consts::{PI, TAU};

use elbowroom::arm::{Arm, InverseError, JointLimits, Posture, TwoLink};
use elbowroom::geometry::Point;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn arm(base: Point, lengths: [f64; 2], limits: [JointLimits; 2]) -> TwoLink {
    let joints = limits.map(build::joint).to_vec();
    Arm::new(base, lengths.to_vec(), 0.0, joints, false).unwrap().two_link().unwrap()
}

/// Elbow and tip by the textbook, for the judge's own use.
fn forward(base: Point, [l1, l2]: [f64; 2], [q1, q2]: [f64; 2]) -> (Point, Point) {
    let elbow = Point::new(base.x + l1 * q1.cos(), base.y + l1 * q1.sin());
    (elbow, Point::new(elbow.x + l2 * (q1 + q2).cos(), elbow.y + l2 * (q1 + q2).sin()))
}

#[test]
fn a_million_tips_come_back_to_a_trillionth_of_the_reach() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let free = [JointLimits::Continuous; 2];
    let mut worst: f64 = 0.0;
    for case in 0..500_000u32 {
        let l1 = 10f64.powf(uniform(&mut rng, -2.0, 2.0));
        let l2 =
            if case % 3 == 0 { l1 } else { l1 * 10f64.powf(uniform(&mut rng, -3.0, 3.0)).clamp(1e-3, 1e3) };
        let base = Point::new(uniform(&mut rng, -l1, l1), uniform(&mut rng, -l1, l1));
        let arm = arm(base, [l1, l2], free);
        let [nearest, farthest] = arm.reach();
        let distance = match case % 8 {
            0 => farthest,
            1 => nearest,
            2 => farthest * (1.0 - 10f64.powf(uniform(&mut rng, -16.0, -3.0))),
            3 => nearest + farthest * 10f64.powf(uniform(&mut rng, -16.0, -3.0)),
            _ => uniform(&mut rng, nearest, farthest),
        };
        let angle = uniform(&mut rng, -PI, PI);
        let tip = Point::new(base.x + distance * angle.cos(), base.y + distance * angle.sin());
        for posture in Posture::ALL {
            let q = match arm.inverse_unlimited(tip, posture) {
                Ok(q) => q,
                // A tip put on the very end may have been rounded beyond it, by no more than the base's digits.
                Err(InverseError::OutOfReach { distance, .. }) => {
                    let off = (nearest - distance).max(distance - farthest);
                    assert!(off <= 1e-11 * farthest.max(l1), "{distance} is within reach");
                    continue;
                }
                Err(other) => panic!("{other}"),
            };
            let (_, reached) = forward(base, [l1, l2], q);
            let error = (reached.x - tip.x).hypot(reached.y - tip.y) / farthest;
            worst = worst.max(error);
            assert!(error <= 1e-12, "{error:e} of the reach off: links {l1} {l2}, tip {tip:?}");
            assert!(q.iter().all(|angle| (-PI..=PI).contains(angle)));
            let right = match posture {
                Posture::ElbowUp => q[1] <= 0.0,
                Posture::ElbowDown => q[1] >= 0.0,
            };
            assert!(right, "{posture:?} gives {q:?}");
        }
    }
    assert!(worst > 0.0);
}

#[test]
fn full_stretch_and_fold_are_exact() {
    let quarter = arm(Point::new(0.0, 0.0), [0.25, 0.25], [JointLimits::Continuous; 2]);
    let stretched = quarter.inverse(Point::new(0.3, 0.4), Posture::ElbowDown).unwrap()[0];
    assert_eq!(stretched[1], 0.0);
    let folded = quarter.inverse(Point::new(0.0, 0.0), Posture::ElbowDown).unwrap()[0];
    assert_eq!(folded[1], PI);
    let beyond = quarter.inverse(Point::new(0.3, 0.41), Posture::ElbowDown).unwrap_err();
    assert!(matches!(beyond, InverseError::OutOfReach { farthest, .. } if farthest == 0.5));
    let hollow = arm(Point::new(1.0, 1.0), [0.5, 0.2], [JointLimits::Continuous; 2]);
    let inside = hollow.inverse(Point::new(1.1, 1.1), Posture::ElbowUp).unwrap_err();
    assert!(matches!(inside, InverseError::OutOfReach { nearest, .. } if (nearest - 0.3).abs() < 1e-15));
}

#[test]
fn limits_are_closed_and_every_turn_between_the_stops_is_found() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..20_000 {
        let limits = [(); 2].map(|()| {
            let min = uniform(&mut rng, -3.0 * TAU, TAU);
            JointLimits::range(min, min + uniform(&mut rng, 0.0, 3.0 * TAU)).unwrap()
        });
        let arm = arm(Point::new(0.1, -0.2), [0.4, 0.3], limits);
        let (distance, angle) = (uniform(&mut rng, 0.11, 0.69), uniform(&mut rng, -PI, PI));
        let tip = Point::new(0.1 + distance * angle.cos(), -0.2 + distance * angle.sin());
        let bend = ((distance * distance - 0.25) / 0.24).acos();
        for posture in Posture::ALL {
            let q2 = if posture == Posture::ElbowUp { -bend } else { bend };
            let q1 = angle - (0.3 * q2.sin()).atan2(0.4 + 0.3 * q2.cos());
            // By trying every turn there is.
            let turns = |q: f64, limits: &JointLimits| -> Vec<f64> {
                (-8..=8).map(|k| q + TAU * f64::from(k)).filter(|&a| limits.contains(a)).collect()
            };
            let expected: Vec<[f64; 2]> = turns(q1, &limits[0])
                .into_iter()
                .flat_map(|a| turns(q2, &limits[1]).into_iter().map(move |b| [a, b]))
                .collect();
            match arm.inverse(tip, posture) {
                Ok(found) => {
                    assert_eq!(found.len(), expected.len());
                    for (q, e) in found.iter().zip(&expected) {
                        assert!((q[0] - e[0]).abs() < 1e-6 && (q[1] - e[1]).abs() < 1e-6);
                    }
                }
                Err(_) => assert!(expected.is_empty(), "{expected:?}"),
            }
        }
    }
    let right = JointLimits::range(-PI / 2.0, PI / 2.0).unwrap();
    let arm = arm(Point::new(0.0, 0.0), [0.3, 0.4], [JointLimits::Continuous, right]);
    // 3-4-5: the second joint stands on its stop.
    let q = arm.inverse(Point::new(0.3, 0.4), Posture::ElbowDown).unwrap()[0];
    assert!((q[1] - PI / 2.0).abs() < 1e-15 && right.contains(q[1]));
    let inside = arm.inverse(Point::new(0.3, 0.39), Posture::ElbowDown).unwrap_err();
    assert!(matches!(inside, InverseError::OutsideJointLimits { joint: 2, .. }));
}
