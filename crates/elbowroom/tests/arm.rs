//! The arm: which measures make none, what it says of configurations of another number of joints, and its turns against
//! brute force over whole turns.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::f64::consts::{PI, TAU};
use std::panic::{AssertUnwindSafe, catch_unwind};

use elbowroom::arm::{
    Arm, ArmError, Configuration, Joint, JointLimits, JointLimitsError, MotionLimitError, MotionLimits,
};
use elbowroom::geometry::Point;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn of(lengths: &[f64], half_width: f64, joints: &[Joint], self_collision: bool) -> Result<Arm, ArmError> {
    Arm::new(Point::new(0.0, 0.0), lengths.to_vec(), half_width, joints.to_vec(), self_collision)
}

/// Three links; the joint of this number, from 1, is `joint`, the others are free.
fn with_joint(number: usize, joint: Joint) -> Result<Arm, ArmError> {
    let mut joints = [Joint::CONTINUOUS; 3];
    joints[number - 1] = joint;
    of(&[0.3; 3], 0.0, &joints, false)
}

#[test]
fn limits_that_are_none_are_refused_by_the_joint_s_number() {
    let turns = 1_000.0 * TAU;
    for number in 1..=3 {
        let refused = |min: f64, max: f64| {
            let error = with_joint(number, build::joint(JointLimits::Range { min, max })).unwrap_err();
            assert!(error.to_string().starts_with(&format!("joint {number}: ")), "{error}");
            let ArmError::JointLimits { joint, error } = error else { panic!("{error:?}") };
            assert_eq!(joint, number);
            error
        };
        for (min, max) in [(1.0, -1.0), (0.0, -5e-324), (turns, -turns)] {
            assert_eq!(refused(min, max), JointLimitsError::Reversed { min, max });
        }
        for (min, max) in [
            (0.0, turns.next_up()),
            (-turns.next_up(), 0.0),
            (0.0, f64::INFINITY),
            (f64::NEG_INFINITY, 0.0),
            (f64::NAN, 1.0),
            (-1.0, f64::NAN),
        ] {
            assert!(matches!(refused(min, max), JointLimitsError::OutsideRange { .. }), "{min} {max}");
        }
        for (min, max) in [(-turns, turns), (-130.0, 130.0), (0.0, 20.0 * TAU + 1e-6)] {
            assert_eq!(refused(min, max), JointLimitsError::TooWide { min, max });
        }
        for (min, max) in [(turns - 20.0 * TAU, turns), (-10.0 * TAU, 10.0 * TAU), (0.0, 0.0), (-0.0, 0.0)] {
            assert!(with_joint(number, build::joint(JointLimits::Range { min, max })).is_ok(), "{min} {max}");
        }
    }
}

#[test]
fn motion_limits_that_are_none_are_refused_by_the_joint_s_number() {
    type With = fn(Option<f64>) -> MotionLimits;
    let rates: [(&str, With); 3] = [
        ("velocity", |velocity| MotionLimits { velocity, ..MotionLimits::default() }),
        ("acceleration", |acceleration| MotionLimits { acceleration, ..MotionLimits::default() }),
        ("jerk", |jerk| MotionLimits { jerk, ..MotionLimits::default() }),
    ];
    for number in 1..=3 {
        for (rate, limits) in rates {
            let with =
                |limit: Option<f64>| with_joint(number, Joint { motion: limits(limit), ..Joint::CONTINUOUS });
            let none = [f64::NAN, -1.0, -f64::MIN_POSITIVE, 0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY];
            // Numbers, but of no motor: with them times overflow.
            for value in none.into_iter().chain([1e-300, 0.9e-6, 1.1e12, 1e300]) {
                let error = with(Some(value)).unwrap_err();
                assert!(
                    error.to_string().contains(&format!("joint {number}: limit on {rate} is")),
                    "{error}"
                );
                let ArmError::MotionLimit { joint, error: MotionLimitError { rate: named, value: found } } =
                    error
                else {
                    panic!("{error:?}")
                };
                assert_eq!((joint, named, found.to_bits()), (number, rate, value.to_bits()));
            }
            assert!(with(Some(1e-6)).is_ok() && with(Some(1e12)).is_ok() && with(None).is_ok());
        }
    }
}

#[test]
fn measures_that_are_none_are_refused() {
    let free = [Joint::CONTINUOUS; 3];
    assert!(matches!(of(&[0.3], 0.0, &free[..1], false), Err(ArmError::Links { found: 1 })));
    assert!(matches!(of(&[], 0.0, &[], false), Err(ArmError::Links { found: 0 })));
    let few = of(&[0.3; 3], 0.0, &free[..2], false);
    assert!(matches!(few, Err(ArmError::Joints { found: 2, links: 3 })));
    for length in [0.0, -0.3, f64::NAN, f64::INFINITY] {
        let refused = of(&[0.3, length, 0.3], 0.0, &free, false);
        assert!(matches!(refused, Err(ArmError::Length { link: 2, .. })), "{length}");
    }
    for half_width in [-1e-9, f64::NAN, f64::INFINITY] {
        assert!(matches!(of(&[0.3; 3], half_width, &free, false), Err(ArmError::HalfWidth { .. })));
    }
    for x in [f64::NAN, f64::INFINITY, 2e6] {
        let refused = Arm::new(Point::new(x, 0.0), vec![0.3; 3], 0.0, free.to_vec(), false);
        assert!(matches!(refused, Err(ArmError::Base { .. })), "{x}");
    }
    assert!(matches!(of(&[0.3; 3], 0.15, &free, true), Err(ArmError::AlwaysTouching { link: 2, .. })));
    assert!(of(&[0.3; 3], 0.15, &free, false).is_ok());
}

#[test]
fn a_configuration_of_another_number_of_joints_is_never_within_limits() {
    for links in 2..6 {
        let arm = build::arm(&vec![0.3; links]);
        for found in 0..8 {
            assert_eq!(arm.within_limits(&vec![0.1; found]), found == links, "{found} for {links}");
        }
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut q = vec![0.1; links];
            q[links - 1] = wrong;
            assert!(!arm.within_limits(&q), "{wrong}");
        }
    }
    let stops = build::stops(-1.0, 2.0);
    let arm = build::arm_of(&[0.3; 2], 0.0, &[Joint::CONTINUOUS, build::joint(stops)]);
    for (angle, within) in
        [(-1.0, true), (2.0, true), (2.0f64.next_up(), false), ((-1.0f64).next_down(), false)]
    {
        assert_eq!(arm.within_limits(&[100.0, angle]), within, "{angle}");
    }
}

#[test]
#[should_panic(expected = "a configuration has one position per joint")]
fn no_tip_without_positions() {
    build::arm(&[0.3; 3]).tip(&[]);
}

#[test]
#[should_panic(expected = "a configuration has one position per joint")]
fn no_tip_of_too_many_positions() {
    build::arm(&[0.3; 3]).tip(&[0.0; 4]);
}

#[test]
#[should_panic(expected = "a configuration has one position per joint")]
fn no_jacobian_of_too_few_positions() {
    build::arm(&[0.3; 3]).jacobian(&[0.0; 2]);
}

#[test]
fn whatever_needs_one_position_per_joint_panics_without() {
    type Ask = fn(&Arm, &[f64]);
    let whole = [0.1; 3];
    let asks: [(&str, Ask); 11] = [
        ("tip", |arm, q| _ = arm.tip(q)),
        ("jacobian", |arm, q| _ = arm.jacobian(q)),
        ("link_ends", |arm, q| _ = arm.link_ends(q).last()),
        ("link_segments", |arm, q| _ = arm.link_segments(q).last()),
        ("clamped", |arm, q| _ = arm.clamped(q.into())),
        ("difference from", |arm, q| _ = arm.difference(q, &[0.1; 3])),
        ("difference to", |arm, q| _ = arm.difference(&[0.1; 3], q)),
        ("nearest_turn from", |arm, q| _ = arm.nearest_turn(q, &[0.1; 3])),
        ("nearest_turn to", |arm, q| _ = arm.nearest_turn(&[0.1; 3], q)),
        ("distance from", |arm, q| _ = arm.distance(q, &[0.1; 3])),
        ("distance to", |arm, q| _ = arm.distance(&[0.1; 3], q)),
    ];
    let arm = build::arm(&[0.3; 3]);
    for (name, ask) in asks {
        ask(&arm, &whole);
        for found in [0, 1, 2, 4] {
            let panic = catch_unwind(AssertUnwindSafe(|| ask(&arm, &vec![0.1; found]))).unwrap_err();
            let message = panic.downcast::<String>().unwrap();
            assert!(message.contains("a configuration has one position per joint"), "{name}: {message}");
        }
    }
}

struct Numbers(ChaCha8Rng);

impl Numbers {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    fn limits(&mut self) -> JointLimits {
        if self.below(2) == 0 {
            return JointLimits::Continuous;
        }
        let min = self.within(-3.0 * TAU, TAU);
        build::stops(min, min + self.within(0.0, 3.0 * TAU))
    }

    /// Where the joint may stand; often on a stop, or on half a turn.
    fn position(&mut self, limits: JointLimits) -> f64 {
        match (limits, self.below(5)) {
            (JointLimits::Range { min, .. }, 0) => min,
            (JointLimits::Range { max, .. }, 1) => max,
            (JointLimits::Range { min, max }, _) => self.within(min, max),
            (JointLimits::Continuous, 0) => PI * (self.below(17) as f64 - 8.0),
            (JointLimits::Continuous, _) => self.within(-6.0 * TAU, 6.0 * TAU),
        }
    }
}

/// The least turn from `from` to `to`, whichever of the whole turns is added.
fn least_turn(limits: JointLimits, from: f64, to: f64) -> f64 {
    match limits {
        JointLimits::Continuous => {
            let turns = (-20..=20).map(|k| to - from + TAU * f64::from(k));
            turns.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap()
        }
        JointLimits::Range { .. } => to - from,
    }
}

#[test]
fn turns_are_the_shortest_of_all_whole_turns() {
    /// What positions of a dozen turns may be rounded by (rad).
    const ROUNDING: f64 = 1e-13;
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(1));
    let (mut halves, mut round) = (0, 0);
    for case in 0..20_000 {
        let links = 2 + case % 4;
        let limits: Vec<JointLimits> = (0..links).map(|_| numbers.limits()).collect();
        let joints: Vec<Joint> = limits.iter().map(|&limits| build::joint(limits)).collect();
        let arm = build::arm_of(&vec![0.3; links], 0.0, &joints);
        let [from, to] =
            [(); 2].map(|()| limits.iter().map(|&l| numbers.position(l)).collect::<Configuration>());
        let (difference, there) = (arm.difference(&from, &to), arm.nearest_turn(&from, &to));
        let mut squares = 0.0;
        for (j, &limits) in limits.iter().enumerate() {
            let least = least_turn(limits, from[j], to[j]);
            squares += least * least;
            let moved = there[j] - from[j];
            match limits {
                JointLimits::Continuous => {
                    let half = (least.abs() - PI).abs() < ROUNDING;
                    halves += usize::from(half);
                    round += usize::from((to[j] - from[j]).abs() > PI + ROUNDING);
                    // Half a turn either way is as far.
                    let off = |found: f64| (found - least).abs();
                    assert!(off(difference[j]) < ROUNDING || half, "{case}: {} {least}", difference[j]);
                    assert!((difference[j].abs() - least.abs()).abs() < ROUNDING);
                    assert!(difference[j] > -PI && difference[j] <= PI, "{case}: {}", difference[j]);
                    assert!(off(moved) < ROUNDING || half, "{case}: {moved} {least}");
                    let turns = (there[j] - to[j]) / TAU;
                    assert!((turns - turns.round()).abs() < ROUNDING, "{case}: {turns} turns");
                }
                JointLimits::Range { .. } => {
                    assert_eq!((difference[j], there[j]), (to[j] - from[j], to[j]));
                }
            }
            assert_eq!(limits.difference(from[j], to[j]), difference[j]);
            assert_eq!(limits.nearest_turn(from[j], to[j]), there[j]);
        }
        assert!((arm.distance(&from, &to) - squares.sqrt()).abs() < 1e-12, "{case}");
        assert!((arm.distance(&to, &from) - squares.sqrt()).abs() < 1e-12, "{case}");
        if let Some(two) = arm.two_link() {
            let [from, to] = [&from, &to].map(|q| [q[0], q[1]]);
            assert_eq!(*difference, two.difference(&from, &to));
        }
    }
    assert!(halves > 500 && round > 5_000, "{halves} half turns, {round} more than half");
}

#[test]
fn half_a_turn_goes_forward_and_whole_turns_are_none() {
    let arm = build::arm(&[0.3; 2]);
    let from_0 = |to: f64| arm.difference(&[0.0, 0.0], &[to, 0.0])[0];
    assert_eq!((from_0(PI), from_0(-PI)), (PI, PI));
    assert_eq!((from_0(TAU), from_0(-TAU), from_0(0.0)), (0.0, 0.0, 0.0));
    assert_eq!(arm.distance(&[-PI, 0.5], &[PI, 0.5]), 0.0);
    assert_eq!(*arm.nearest_turn(&[7.0, -7.0], &[7.0, -7.0]), [7.0, -7.0]);
    // With stops 0 and a whole turn are different places.
    let joint = build::joint(build::stops(0.0, TAU));
    let arm = build::arm_of(&[0.3; 2], 0.0, &[joint; 2]);
    assert_eq!(*arm.difference(&[0.0, TAU], &[TAU, 0.0]), [TAU, -TAU]);
    assert_eq!(*arm.nearest_turn(&[0.0, TAU], &[TAU, 0.0]), [TAU, 0.0]);
    assert_eq!(arm.distance(&[0.0, 0.0], &[TAU, 0.0]), TAU);
}
