//! Inverse kinematics by swarm: against the closed form of two links, and how it converges for many.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]
#![expect(clippy::print_stdout, reason = "how many evaluations it takes is a figure for the docs")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::f64::consts::PI;

use elbowroom::arm::{Arm, Joint, JointLimits, Posture};
use elbowroom::geometry::Point;
use elbowroom::planners::{
    InverseSwarmError, InverseSwarmSettings, Previous, SwarmInverse, inverse_by_swarm,
};
use elbowroom::swarm::SwarmError;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

struct Numbers(ChaCha8Rng);

impl Numbers {
    fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Joint 1 continuous, the others within `bend` (rad).
fn arm(lengths: Vec<f64>, bend: f64) -> Arm {
    let other = build::joint(JointLimits::range(-bend, bend).unwrap());
    let joints = (0..lengths.len()).map(|j| if j == 0 { Joint::CONTINUOUS } else { other }).collect();
    Arm::new(Point::new(0.1, -0.2), lengths, 0.0, joints, false).unwrap()
}

/// Where the tip is: sums of sines and cosines.
fn tip(arm: &Arm, q: &[f64]) -> Point {
    let (mut x, mut y, mut direction) = (arm.base().x, arm.base().y, 0.0);
    for (length, angle) in arm.lengths().iter().zip(q) {
        direction += angle;
        x += length * f64::cos(direction);
        y += length * f64::sin(direction);
    }
    Point::new(x, y)
}

fn solved(arm: &Arm, tip: Point, seed: u64) -> SwarmInverse {
    inverse_by_swarm(arm, tip, None, &InverseSwarmSettings::default(), seed, &mut |_: &[f64]| 0.0).unwrap()
}

/// All that holds of any answer.
fn assert_sound(arm: &Arm, asked: Point, found: &SwarmInverse) {
    let settings = InverseSwarmSettings::default();
    assert!((tip(arm, &found.q).distance(asked) - found.error).abs() < 1e-12);
    assert!(arm.within_limits(&found.q), "{:?}", found.q);
    assert_eq!(found.evaluations, found.convergence.len() * settings.particles);
    assert!(found.convergence.len() <= settings.iterations);
    assert_eq!(found.convergence.last(), Some(&found.error));
    assert!(found.convergence.windows(2).all(|pair| pair[1] <= pair[0]));
}

#[test]
fn ten_thousand_tips_of_two_links_are_those_of_the_closed_form() {
    let mut numbers = Numbers::seeded(1);
    let (mut converged, mut evaluations, mut worst) = (0, 0, 0.0_f64);
    let cases = 10_000;
    for case in 0..cases {
        let lengths = vec![numbers.within(0.2, 0.6), numbers.within(0.2, 0.6)];
        let bend = if case % 2 == 0 { PI } else { 150_f64.to_radians() };
        let arm = arm(lengths, bend);
        // Every tenth at full stretch, folded, or at a stop; the rest anywhere.
        let second = match case % 40 {
            0 => 0.0,
            10 => bend,
            20 => -bend,
            30 => numbers.within(-1e-6, 1e-6),
            _ => numbers.within(-bend, bend),
        };
        let asked = tip(&arm, &[numbers.within(-PI, PI), second]);
        let found = solved(&arm, asked, case);
        assert_sound(&arm, asked, &found);
        converged += usize::from(found.error < InverseSwarmSettings::default().tolerance);
        evaluations += found.evaluations;
        worst = worst.max(found.error);
        let closed = arm.two_link().unwrap();
        let known: Vec<_> = Posture::ALL
            .iter()
            .filter_map(|posture| closed.inverse(asked, *posture).ok())
            .flatten()
            .collect();
        // In line the joints move with the root of the error; with the tip at the base joint 1 may be anywhere.
        let at_base = asked.distance(arm.base()) < 1e-6;
        let off = |q: &[f64; 2]| (0..2).map(|j| ((q[j] - found.q[j]) / 2.0).sin().abs()).fold(0.0, f64::max);
        let nearest = known.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(
            at_base || known.is_empty() || nearest < 1e-3,
            "case {case}: {nearest}, {:?}, {known:?}",
            found.q
        );
    }
    println!(
        "{converged} of {cases} within 1e-9 m, worst {worst:e} m, {} evaluations on average",
        evaluations / cases as usize
    );
    assert_eq!(converged, cases as usize);
}

#[test]
fn many_links_converge() {
    for links in [3, 5, 10, 30] {
        let arm = arm(vec![1.0 / links as f64; links], 2.0);
        let mut numbers = Numbers::seeded(links as u64);
        let cases = 100;
        let mut errors = vec![Vec::new(); 4];
        let (mut converged, mut evaluations) = (0, 0);
        for seed in 0..cases {
            let known: Vec<f64> =
                (0..links).map(|j| numbers.within(-1.0, 1.0) * if j == 0 { PI } else { 2.0 }).collect();
            let asked = tip(&arm, &known);
            let found = solved(&arm, asked, seed);
            assert_sound(&arm, asked, &found);
            converged += usize::from(found.error < 1e-9);
            evaluations += found.evaluations;
            for (errors, iterations) in errors.iter_mut().zip([1, 10, 30, 100]) {
                let at = iterations.min(found.convergence.len()) - 1;
                errors.push(found.convergence[at]);
            }
        }
        let means: Vec<f64> =
            errors.iter().map(|errors| errors.iter().sum::<f64>() / errors.len() as f64).collect();
        println!(
            "{links} links: {converged} of {cases}, {} evaluations on average; mean error after 1, 10, 30, 100 iterations {means:?} m",
            evaluations / cases as usize
        );
        assert_eq!(converged, cases as usize, "{links} links");
        assert!(means.windows(2).all(|pair| pair[1] < 0.5 * pair[0]), "{links} links: {means:?}");
    }
}

#[test]
fn a_swarm_that_knows_the_previous_configuration_stays_near_it() {
    let arm = arm(vec![0.3, 0.25, 0.2], 2.5);
    let mut numbers = Numbers::seeded(3);
    for seed in 0..200 {
        let before: Vec<f64> = (0..3).map(|_| numbers.within(-1.2, 1.2)).collect();
        let beside: Vec<f64> = before.iter().map(|angle| angle + numbers.within(-0.05, 0.05)).collect();
        let asked = tip(&arm, &beside);
        let settings = InverseSwarmSettings { tolerance: 1e-4, ..InverseSwarmSettings::default() };
        let look = |weight: f64| {
            let previous = Previous { q: &before, radius: 0.5, weight };
            inverse_by_swarm(&arm, asked, Some(previous), &settings, seed, &mut |_: &[f64]| 0.0).unwrap()
        };
        let far = |q: &[f64]| q.iter().zip(&before).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let near = look(1e-5);
        assert!(near.error < 1e-4 && far(&near.q) <= 0.5 + 1e-12, "{:?} {}", near.q, near.error);
        // Drawn to it by weight, it ends nearer than where the box alone holds it, or as near.
        let heavy = look(1.0);
        assert!(far(&heavy.q) < 0.06, "{:?} {}", heavy.q, heavy.error);
    }
}

#[test]
fn continuous_joints_are_compared_the_short_way_round() {
    let arm = arm(vec![0.3, 0.25], 2.5);
    let q = [0.4, 0.8];
    let turned = [0.4 + 6.0 * PI, 0.8];
    let settings = InverseSwarmSettings { tolerance: 1e-6, ..InverseSwarmSettings::default() };
    let previous = Previous { q: &turned, radius: 0.4, weight: 1e-6 };
    let found =
        inverse_by_swarm(&arm, tip(&arm, &q), Some(previous), &settings, 0, &mut |_: &[f64]| 0.0).unwrap();
    assert!((found.q[0] - turned[0]).abs() < 1e-3 && (found.q[1] - q[1]).abs() < 1e-3, "{:?}", found.q);
}

#[test]
fn what_may_not_be_taken_goes_by_its_violation() {
    // Elbow-up alone may be taken.
    let arm = arm(vec![0.3, 0.25], 2.5);
    for seed in 0..100 {
        let asked = tip(&arm, &[0.3, 1.0]);
        let found = inverse_by_swarm(
            &arm,
            asked,
            None,
            &InverseSwarmSettings::default(),
            seed,
            &mut |q: &[f64]| q[1].max(0.0),
        )
        .unwrap();
        assert!(
            found.violation == 0.0 && found.error < 1e-9 && (found.q[1] + 1.0).abs() < 1e-6,
            "{:?} {}",
            found.q,
            found.error
        );
    }
    // Nothing may: the least violation is found, and said.
    let none = inverse_by_swarm(
        &arm,
        Point::new(0.3, 0.1),
        None,
        &InverseSwarmSettings::default(),
        0,
        &mut |q: &[f64]| 1.0 + (q[1] - 0.5).abs(),
    )
    .unwrap();
    assert!((none.violation - 1.0).abs() < 1e-3, "{}", none.violation);
    assert_eq!(none.convergence.len(), InverseSwarmSettings::default().iterations);
}

#[test]
fn a_tip_out_of_reach_is_come_as_near_to_as_can_be() {
    let arm = arm(vec![0.3, 0.2, 0.1], 2.5);
    let found = solved(&arm, Point::new(0.1, 0.8), 0);
    assert!((found.error - 0.4).abs() < 1e-6, "{}", found.error);
}

#[test]
fn settings_that_make_no_swarm_are_refused() {
    let arm = arm(vec![0.3, 0.25], 2.5);
    let ask = |settings: InverseSwarmSettings, previous: Option<Previous<'_>>| {
        inverse_by_swarm(&arm, Point::new(0.3, 0.0), previous, &settings, 0, &mut |_: &[f64]| 0.0)
    };
    let settings = InverseSwarmSettings::default();
    assert!(matches!(
        ask(InverseSwarmSettings { particles: 0, ..settings }, None),
        Err(InverseSwarmError::Swarm(SwarmError::Particles { .. }))
    ));
    for radius in [f64::NAN, -1.0, f64::INFINITY] {
        let refused = ask(settings, Some(Previous { q: &[0.0, 0.0], radius, weight: 0.0 }));
        assert!(matches!(refused, Err(InverseSwarmError::Previous { .. })), "{radius}: {refused:?}");
    }
    for q in [&[0.0][..], &[0.0, 0.0, 0.0], &[f64::NAN, 0.0]] {
        assert!(ask(settings, Some(Previous { q, radius: 0.1, weight: 1.0 })).is_err(), "{q:?}");
    }
    let nothing = ask(InverseSwarmSettings { iterations: 0, ..settings }, None).unwrap();
    assert_eq!((nothing.evaluations, nothing.convergence.len()), (0, 0));
}
