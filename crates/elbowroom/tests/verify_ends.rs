//! The verifier at the ends of what joints may do: stops many turns away, and motions that are to begin and end at rest.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::f64::consts::TAU;

use elbowroom::arm::{Joint, MotionLimits};
use elbowroom::scene::Scene;
use elbowroom::trajectory::{Motion, Piece, Samples, State, interpolate};
use elbowroom::verify::{End, Quantity, REST_ROUNDING, VerifySettings, Violation, verify};

const FREE: Joint = Joint::CONTINUOUS;
const AT_REST: End = End::AtRest(Quantity::Velocity);

fn scene(first: Joint) -> Scene {
    build::scene(build::arm_of(&[1.0, 0.5], 0.0, &[first, FREE]), Vec::new())
}

fn between(min: f64, max: f64) -> Scene {
    scene(build::joint(build::stops(min, max)))
}

fn violations(scene: &Scene, motion: &Motion, ends: [End; 2]) -> Vec<Violation> {
    verify(scene, motion, &VerifySettings { ends, ..VerifySettings::default() }).violations
}

fn rest_to_rest(from: f64, to: f64, duration: f64) -> Motion {
    let rest = |q: f64| State::rest(&[q, 0.0]);
    Motion::new(vec![Piece::quintic(0.0, duration, &rest(from), &rest(to))]).unwrap()
}

/// Turns, half of them each way, from stop to stop and back, in times that are no powers of two.
fn sweeps(turns: f64) -> Vec<Motion> {
    let stop = turns * TAU;
    let ways = [(-stop, stop), (stop, -stop), (0.0, stop), (-stop, 0.0), (-stop, 1.0 - stop), (stop, 0.1)];
    ways.into_iter().flat_map(|(from, to)| [0.37, 7.3, 91.7].map(|t| rest_to_rest(from, to, t))).collect()
}

#[test]
fn a_motion_from_stop_to_stop_is_within_them_however_far_they_are() {
    for turns in [0.3, 1.0, 2.0, 4.0, 10.0] {
        let scene = between(-turns * TAU, turns * TAU);
        for motion in sweeps(turns) {
            assert_eq!(violations(&scene, &motion, [End::Open; 2]), [], "{turns} turns");
        }
    }
}

#[test]
fn a_foreign_file_from_stop_to_stop_is_within_them_too() {
    for turns in [2.0, 4.0, 10.0] {
        let stop = turns * TAU;
        let scene = between(-stop, stop);
        let zeros = || vec![vec![0.0; 2]; 3];
        for (velocities, accelerations) in
            [(None, None), (Some(zeros()), None), (Some(zeros()), Some(zeros()))]
        {
            let rows = Samples {
                times: vec![0.0, 0.7, 13.1],
                positions: vec![vec![-stop, 0.0], vec![stop, 0.0], vec![-stop, 0.0]],
                velocities,
                accelerations,
            };
            let settings = VerifySettings { continuous: Quantity::Position, ..VerifySettings::default() };
            let motion = interpolate(&rows).unwrap().motion;
            assert_eq!(verify(&scene, &motion, &settings).violations, []);
        }
    }
}

#[test]
fn what_is_truly_beyond_a_stop_is_found_however_far_it_is() {
    for turns in [0.3, 2.0, 4.0, 9.0] {
        let stop = turns * TAU;
        // A hair beyond, by far more than rounding and far less than anybody could measure.
        let hair = 1e-10 * stop.max(1.0);
        for motion in sweeps(turns) {
            let q = [motion.at(0.0).position[0], motion.at(motion.end()).position[0]];
            let (low, high) = (q[0].min(q[1]), q[0].max(q[1]));
            for scene in [between(low + hair, high + 1.0), between(low - 1.0, high - hair)] {
                let found = violations(&scene, &motion, [End::Open; 2]);
                assert!(
                    matches!(found[..], [Violation::JointLimit { joint: 1, .. }]),
                    "{turns} {q:?} {found:?}"
                );
            }
        }
    }
    // Terms as large as they like: what they come to is beyond.
    let terms = [0.0, 1e12, -1e12, 0.0, 0.0, 0.0];
    let piece = Piece { start: 0.0, duration: 1.0, coefficients: vec![terms, [0.0; 6]] };
    assert!(!violations(&between(-1.0, 1.0), &Motion::new(vec![piece]).unwrap(), [End::Open; 2]).is_empty());
}

fn moving(velocity: [f64; 2], acceleration: [f64; 2]) -> Motion {
    let at = |i: usize| State {
        velocity: vec![velocity[i], 0.0],
        acceleration: vec![acceleration[i], 0.0],
        ..State::rest(&[i as f64, 0.0])
    };
    Motion::new(vec![Piece::quintic(3.0, 2.0, &at(0), &at(1))]).unwrap()
}

#[test]
fn ends_that_move_are_refused_where_they_are_to_rest() {
    let scene = scene(FREE);
    for (end, time) in [(0, 3.0), (1, 5.0)] {
        let mut velocity = [0.0; 2];
        velocity[end] = 0.5;
        let motion = moving(velocity, [0.0; 2]);
        let found = violations(&scene, &motion, [AT_REST; 2]);
        let [Violation::NotAtRest { joint: 1, at_end, what: Quantity::Velocity, value, time: when }] =
            found[..]
        else {
            panic!("{found:?}")
        };
        assert_eq!((at_end, when), (end == 1, time));
        assert!((value - 0.5).abs() < 1e-12);
        // Only where it is asked for.
        let mut ends = [AT_REST; 2];
        ends[end] = End::Open;
        assert_eq!(violations(&scene, &motion, ends), []);
        velocity[end] = 0.9 * REST_ROUNDING;
        assert_eq!(violations(&scene, &moving(velocity, [0.0; 2]), [AT_REST; 2]), []);
    }
}

#[test]
fn rates_at_the_ends_count_by_the_limits_above_them() {
    let limited =
        |acceleration, jerk| Joint { motion: MotionLimits { acceleration, jerk, ..FREE.motion }, ..FREE };
    let (fast, pushed) = (moving([0.5, 0.0], [0.0; 2]), moving([0.0; 2], [0.0, 2.0]));
    let line = End::AtRest(Quantity::Position);
    assert_eq!(violations(&scene(FREE), &fast, [line; 2]), []);
    assert_eq!(violations(&scene(limited(Some(1e3), None)), &fast, [line; 2]).len(), 1);
    assert_eq!(violations(&scene(FREE), &pushed, [AT_REST; 2]), []);
    let found = violations(&scene(limited(None, Some(1e3))), &pushed, [AT_REST; 2]);
    assert!(matches!(found[..], [Violation::NotAtRest { what: Quantity::Acceleration, at_end: true, .. }]));
}
