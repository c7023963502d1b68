//! The verifier against closed forms.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};

use build::{circle, polygon};
use elbowroom::arm::{Joint, MotionLimits};
use elbowroom::geometry::{Point, Shape, ShapeError};
use elbowroom::scene::{Obstacle, Scene};
use elbowroom::trajectory::{Motion, Piece, State};
use elbowroom::verify::{
    Against, FLOOR, Quantity, Rate, Trajectory, Verdict, VerifySettings, Violation, verify, verify_until,
};

const FREE: Joint = Joint::CONTINUOUS;

fn scene_with(half_width: f64, joints: [Joint; 2], obstacles: Vec<Obstacle>) -> Scene {
    build::scene(build::arm_of(&[1.0, 0.5], half_width, &joints), obstacles)
}

fn scene(half_width: f64, obstacles: Vec<Obstacle>) -> Scene {
    scene_with(half_width, [FREE; 2], obstacles)
}

fn rest_to_rest(from: [f64; 2], to: [f64; 2], duration: f64) -> Motion {
    Motion::new(vec![Piece::quintic(0.0, duration, &State::rest(&from), &State::rest(&to))]).unwrap()
}

fn standing(at: [f64; 2]) -> Motion {
    let coefficients = at.map(|q| [q, 0.0, 0.0, 0.0, 0.0, 0.0]).to_vec();
    Motion::new(vec![Piece { start: 0.0, duration: 0.0, coefficients }]).unwrap()
}

fn straight(start: f64, duration: f64, from: [f64; 2], to: [f64; 2]) -> Piece {
    let line = |j: usize| [from[j], (to[j] - from[j]) / duration, 0.0, 0.0, 0.0, 0.0];
    let coefficients = vec![line(0), line(1)];
    Piece { start, duration, coefficients }
}

fn judged(scene: &Scene, motion: &Motion) -> Verdict {
    verify(scene, motion, &VerifySettings::default())
}

#[test]
fn a_sweep_past_a_circle_has_the_known_least_clearance() {
    // Stretched out, the arm is a line of length 1.5 that turns from 0 to π/2; the circle lies beyond the tip at
    // π/4, which the motion passes at half time.
    let (way, radius) = (1.5 + 0.2 + 0.05, 0.2);
    let scene = scene(0.03, vec![circle(way * (PI / 4.0).cos(), way * (PI / 4.0).sin(), radius)]);
    let verdict = judged(&scene, &rest_to_rest([0.0, 0.0], [FRAC_PI_2, 0.0], 2.0));
    assert!(verdict.is_safe(), "{verdict:?}");
    let clearance = verdict.least_clearance.unwrap();
    let exact = 0.05 - 0.03;
    assert!(clearance.distance >= exact - 1e-12 && clearance.distance <= exact * 1.01);
    let at_least = clearance.at_least.unwrap();
    assert!(at_least <= exact && at_least >= exact * 0.98, "{at_least}");
    assert!((clearance.time - 1.0).abs() < 0.02, "{}", clearance.time);
    assert_eq!((clearance.link, clearance.against), (2, Against::Obstacle(0)));
}

#[test]
fn the_time_of_first_contact_is_known() {
    // q1 = t evenly; the line through the base is half_width + radius from the centre at the angle asin(.).
    let (rho, radius, half_width) = (0.8, 0.1, 0.02);
    let scene = scene(half_width, vec![circle(0.0, rho, radius)]);
    let motion = Motion::new(vec![straight(0.0, 3.0, [0.0, 0.0], [3.0, 0.0])]).unwrap();
    let verdict = judged(&scene, &motion);
    let exact = FRAC_PI_2 - ((half_width + radius) / rho).asin();
    let first = verdict.violations[0];
    let Violation::Contact { time, link: 1, against: Against::Obstacle(0), depth } = first else {
        panic!("{verdict:?}")
    };
    assert!((time - exact).abs() < 1e-8, "{time} {exact}");
    assert!((depth - (half_width + radius)).abs() < 1e-3, "{depth}");
    assert!(verdict.least_clearance.unwrap().at_least.is_none());
}

#[test]
fn touching_is_contact_and_a_hair_more_is_not() {
    // The tip of the outstretched arm sweeps the circle of radius 1.5.
    for (gap, safe) in [(0.0, false), (1e-10, false), (0.9 * FLOOR, false), (1e-6, true), (1e-4, true)] {
        let scene = scene(0.0, vec![circle(0.0, 1.75 + gap, 0.25)]);
        let verdict = judged(&scene, &rest_to_rest([0.0, 0.0], [PI, 0.0], 2.0));
        assert_eq!(verdict.is_safe(), safe, "{gap} {verdict:?}");
        if gap == 0.0 {
            let is_contact = |v: &Violation| {
                matches!(v, Violation::Contact { link: 2, .. } | Violation::Undecided { link: 2, .. })
            };
            assert!(verdict.violations.iter().any(is_contact), "{verdict:?}");
        }
    }
    // Standing still in touch, at the very first and at the very last instant.
    let touching = scene(0.0, vec![circle(0.0, 1.75, 0.25)]);
    for motion in [
        standing([FRAC_PI_2, 0.0]),
        rest_to_rest([FRAC_PI_2, 0.0], [0.0, 0.0], 1.0),
        rest_to_rest([0.0, 0.0], [FRAC_PI_2, 0.0], 1.0),
    ] {
        assert!(!judged(&touching, &motion).is_safe());
    }
    let Violation::Contact { time, .. } =
        judged(&touching, &rest_to_rest([FRAC_PI_2, 0.0], [0.0, 0.0], 1.0)).violations[0]
    else {
        panic!()
    };
    assert_eq!(time, 0.0);
}

#[test]
fn a_link_inside_a_polygon_is_in_contact() {
    let room = polygon(&[[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]]);
    let verdict = judged(&scene(0.0, vec![room]), &standing([0.3, 0.4]));
    assert_eq!(verdict.violations.len(), 2, "{verdict:?}");
    // In the bay of a polygon that is not convex, nothing touches.
    let bay = polygon(&[
        [-1.0, -1.0],
        [2.0, -1.0],
        [2.0, -0.5],
        [-0.5, -0.5],
        [-0.5, 0.5],
        [2.0, 0.5],
        [2.0, 1.0],
        [-1.0, 1.0],
    ]);
    let verdict = judged(&scene(0.01, vec![bay]), &rest_to_rest([-0.1, 0.0], [0.1, 0.0], 1.0));
    assert!(verdict.is_safe());
    let nearest = verdict.least_clearance.unwrap();
    // Tip 1.5 sin 0.1 above the middle.
    let exact = 0.5 - 1.5 * 0.1f64.sin() - 0.01;
    assert!((nearest.distance - exact).abs() <= 0.01 * exact, "{nearest:?} {exact}");
}

#[test]
fn the_margin_is_asked_for_on_top() {
    let scene = scene(0.0, vec![circle(0.0, 1.75 + 0.01, 0.25)]);
    let motion = rest_to_rest([0.0, 0.0], [PI, 0.0], 2.0);
    for (margin, safe) in [(0.009, true), (0.01, false), (0.011, false), (f64::NAN, false), (-1.0, true)] {
        let settings = VerifySettings { margin, ..VerifySettings::default() };
        let verdict = verify(&scene, &motion, &settings);
        assert_eq!(verdict.is_safe(), safe, "{margin}");
        assert_eq!(Trajectory::certify(&scene, motion.clone(), &settings).is_ok(), safe);
    }
}

#[test]
fn peaks_of_the_smooth_step_are_the_known_ones() {
    let (h, t) = (1.7, 2.3);
    let peaks = [15.0 / 8.0 * h / t, 10.0 / 3f64.sqrt() * h / t.powi(2), 60.0 * h / t.powi(3)];
    let motion = rest_to_rest([0.2, 0.0], [0.2 + h, -h], t);
    let margins = judged(&scene(0.0, Vec::new()), &motion).motion_margins;
    for joint in margins {
        for (margin, peak) in [joint.velocity, joint.acceleration, joint.jerk].into_iter().zip(peaks) {
            assert!((margin.largest - peak).abs() < 1e-12 * peak, "{margin:?} {peak}");
        }
        assert!((joint.velocity.time - t / 2.0).abs() < 1e-6);
    }
    for rate in [Rate::Velocity, Rate::Acceleration, Rate::Jerk] {
        for (factor, safe) in [(1.0, true), (1.0 + 1e-10, true), (1.0 - 1e-10, false)] {
            let mut limits = MotionLimits::default();
            let (field, peak) = match rate {
                Rate::Velocity => (&mut limits.velocity, peaks[0]),
                Rate::Acceleration => (&mut limits.acceleration, peaks[1]),
                Rate::Jerk => (&mut limits.jerk, peaks[2]),
            };
            *field = Some(peak * factor);
            let joint = Joint { motion: limits, ..FREE };
            let verdict = judged(&scene_with(0.0, [FREE, joint], Vec::new()), &motion);
            assert_eq!(verdict.is_safe(), safe, "{rate:?} {factor} {verdict:?}");
            if !safe {
                let [Violation::MotionLimit { joint: 2, rate: found, .. }] = verdict.violations[..] else {
                    panic!("{verdict:?}")
                };
                assert_eq!(found, rate);
            }
        }
    }
}

#[test]
fn stops_are_allowed_and_what_is_beyond_is_not() {
    for (max, safe) in [(2.0, true), (2.0 - 1e-10, false), (2.1, true)] {
        let joint = build::joint(build::stops(-1.0, max));
        let scene = scene_with(0.0, [joint, FREE], Vec::new());
        for motion in [rest_to_rest([-1.0, 0.0], [2.0, 1.0], 1.0), rest_to_rest([2.0, 0.0], [-1.0, 1.0], 1.0)]
        {
            let verdict = judged(&scene, &motion);
            assert_eq!(verdict.is_safe(), safe, "{max} {verdict:?}");
            let margin = verdict.joint_margins[0].unwrap();
            assert!((margin.distance - (max - 2.0).min(0.0)).abs() < 1e-12);
            assert!(verdict.joint_margins[1].is_none());
            if !safe {
                let Violation::JointLimit { joint: 1, angle, limit, .. } = verdict.violations[0] else {
                    panic!()
                };
                assert!((angle - 2.0).abs() < 1e-11 && limit == max);
            }
        }
    }
}

#[test]
fn overshoot_between_ends_within_the_stops_is_found() {
    // q1 = 4 s (1 - s): 1 at half time, where the ends and every derivative sampled at the ends look harmless.
    let piece =
        Piece { start: 5.0, duration: 1.0, coefficients: vec![[0.0, 4.0, -4.0, 0.0, 0.0, 0.0], [0.0; 6]] };
    let joint = build::joint(build::stops(-1.0, 1.0 - 1e-9));
    let verdict = judged(&scene_with(0.0, [joint, FREE], Vec::new()), &Motion::new(vec![piece]).unwrap());
    let [Violation::JointLimit { joint: 1, time, angle, .. }] = verdict.violations[..] else {
        panic!("{verdict:?}")
    };
    assert!((time - 5.5).abs() < 1e-6 && (angle - 1.0).abs() < 1e-12);
}

#[test]
fn pieces_that_do_not_join_are_found() {
    let from = State::rest(&[0.0, 0.0]);
    let via = State {
        position: vec![0.5, 0.1],
        velocity: vec![0.3, 0.2],
        acceleration: vec![0.1, -0.1],
        jerk: vec![0.0; 2],
    };
    let to = State::rest(&[1.0, 0.0]);
    let with = |second: &State, from2: f64| {
        let pieces = vec![Piece::quintic(0.0, 1.0, &from, &via), Piece::quintic(from2, 1.0, second, &to)];
        judged(&scene(0.0, Vec::new()), &Motion::new(pieces).unwrap())
    };
    assert!(with(&via, 1.0).is_safe());
    for (what, joint) in [Quantity::Position, Quantity::Velocity, Quantity::Acceleration]
        .into_iter()
        .flat_map(|what| [(what, 0), (what, 1)])
    {
        let mut other = via.clone();
        match what {
            Quantity::Position => other.position[joint] += 1e-6,
            Quantity::Velocity => other.velocity[joint] += 1e-6,
            Quantity::Acceleration => other.acceleration[joint] += 1e-6,
        }
        let verdict = with(&other, 1.0);
        let [Violation::Discontinuity { joint: found, what: kind, time, jump }] = verdict.violations[..]
        else {
            panic!("{verdict:?}")
        };
        assert_eq!((found, kind), (joint + 1, what));
        assert!(time == 1.0 && (jump - 1e-6).abs() < 1e-9);
    }
}

#[test]
fn posture_changes_are_where_the_elbow_passes_a_multiple_of_pi() {
    let changes = |pieces| judged(&scene(0.0, Vec::new()), &Motion::new(pieces).unwrap()).posture_changes;
    let near = |found: Vec<f64>, expected: &[f64]| {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    };
    near(changes(vec![straight(0.0, 2.0, [0.0, -1.0], [0.0, 1.0])]), &[1.0]);
    near(
        changes(vec![straight(0.0, 2.0, [0.0, -1.0], [0.0, 7.0])]),
        &[0.25, 0.25 + PI / 4.0, 0.25 + PI / 2.0],
    );
    near(changes(vec![straight(0.0, 2.0, [0.0, 0.0], [0.0, 1.0])]), &[]);
    // Touches 0 at half time and goes back; the same and on to the other side.
    let touch =
        Piece { start: 0.0, duration: 2.0, coefficients: vec![[0.0; 6], [1.0, -2.0, 1.0, 0.0, 0.0, 0.0]] };
    near(changes(vec![touch]), &[]);
    let cubic =
        Piece { start: 0.0, duration: 2.0, coefficients: vec![[0.0; 6], [-1.0, 3.0, -3.0, 1.0, 0.0, 0.0]] };
    let found = changes(vec![cubic]);
    assert!(found.len() == 1 && (found[0] - 1.0).abs() < 1e-3, "ill-conditioned, but one: {found:?}");
    // At 0 for a whole piece between two sides.
    let pieces = vec![
        straight(0.0, 1.0, [0.0, -1.0], [0.0, 0.0]),
        straight(1.0, 1.0, [0.0, 0.0], [0.0, 0.0]),
        straight(2.0, 1.0, [0.0, 0.0], [0.0, 1.0]),
    ];
    near(changes(pieces), &[1.0]);
}

#[test]
fn huge_numbers_are_refused_rather_than_passed() {
    let post = |gap: f64| scene(0.0, vec![circle(0.0, 1.75 + gap, 0.25)]);
    // A hundred thousand turns away: angles have 1e-10 rad left, but 1e-3 m are plain to see.
    let turns = 1e5 * 2.0 * PI;
    let far = |gap| judged(&post(gap), &rest_to_rest([turns, 0.0], [turns + PI, 0.0], 1.0));
    assert!(far(1e-3).is_safe());
    assert!(!far(-1e-3).is_safe());
    assert!(!far(2e-9).is_safe(), "clearance cannot be told there");
    // A disc as large as a country beside the arm.
    for (radius, gap, safe) in [(9e5, 0.1, true), (9e5, -1e-3, false)] {
        let disc = scene(0.0, vec![circle(0.0, 1.5 + gap + radius, radius)]);
        let motion = rest_to_rest([0.0, 0.0], [PI, 0.0], 1.0);
        assert_eq!(judged(&disc, &motion).is_safe(), safe, "{radius} {gap}");
    }
    // No scene has one that is larger, or no number at all.
    for radius in [1e9, 1e200, f64::INFINITY, f64::NAN, f64::NEG_INFINITY] {
        let odd = [([0.0, 2.5 + radius], radius), ([radius, 0.0], 1.0), ([9.0, 9.0], radius)];
        for odd in odd.map(|([x, y], radius)| Shape::circle(Point::new(x, y), radius)) {
            assert!(matches!(odd, Err(ShapeError::Circle { .. })), "{radius} {odd:?}");
        }
    }
    for (c, duration) in
        [(1e308, 1.0), (1e300, 1e10), (1e20, 1.0), (1.0, 1e100), (5e-324, 1e-300), (1e308, 1e-308)]
    {
        for k in 0..6 {
            let mut coefficients = vec![[0.0; 6]; 2];
            coefficients[1][k] = c;
            let motion = Motion::new(vec![Piece { start: 0.0, duration, coefficients }]).unwrap();
            let verdict = judged(&post(1e-3), &motion);
            assert!(!verdict.violations.iter().any(|v| v.time().is_nan()), "{verdict:?}");
        }
    }
    let overflow =
        Piece { start: 0.0, duration: 1e100, coefficients: vec![[0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [0.0; 6]] };
    let verdict = judged(&scene(0.0, Vec::new()), &Motion::new(vec![overflow]).unwrap());
    assert!(matches!(verdict.violations[..], [Violation::TooLarge { joint: 1, .. }]), "{verdict:?}");
}

#[test]
fn a_motion_close_along_a_wall_is_decided() {
    // The inner side of a ring around the base, 0.1 mm beyond the tip, which moves by 1 m along it.
    let arc = |radius: f64, turn: f64| [radius * turn.cos(), radius * turn.sin()];
    let turns: Vec<f64> = (0..=400).map(|i| -0.1 + f64::from(i) / 400.0).collect();
    let inner = turns.iter().map(|&turn| arc(1.5001, turn));
    let outer = turns.iter().rev().map(|&turn| arc(1.6, turn));
    let ring = polygon(&inner.chain(outer).collect::<Vec<_>>());
    let verdict = judged(&scene(0.0, vec![ring]), &rest_to_rest([0.0, 0.0], [1.0 / 1.5, 0.0], 1.0));
    assert!(verdict.is_safe(), "{verdict:?}");
    let clearance = verdict.least_clearance.unwrap();
    // An edge bulges inwards by 1.5 (1 - cos 0.00125) = 1.2e-6 m.
    assert!(clearance.distance < 1e-4 && clearance.distance > 0.98e-4, "{clearance:?}");
    assert!(clearance.at_least.unwrap() > 0.0);
}

#[test]
fn an_obstacle_beside_the_base_is_decided_at_once() {
    // The clearance of the first link stays the same all along, 1 mm, while its end moves by 1.5 m.
    let scene = scene(0.0, vec![circle(-0.051, 0.0, 0.05)]);
    let motion = rest_to_rest([-0.75, 0.0], [0.75, 0.0], 1.0);
    let verdict = verify(&scene, &motion, &VerifySettings { evaluations: 100, ..VerifySettings::default() });
    assert!(verdict.is_safe(), "{verdict:?}");
    let clearance = verdict.least_clearance.unwrap();
    assert!(
        (clearance.distance - 1e-3).abs() < 1e-12 && clearance.at_least.unwrap() > 0.98e-3,
        "{clearance:?}"
    );
}

#[test]
fn too_small_a_budget_and_an_early_stop_are_not_safe() {
    let scene = scene(0.0, vec![circle(0.0, 1.751, 0.25)]);
    let motion = rest_to_rest([0.0, 0.0], [PI, 0.0], 1.0);
    let verdict = verify(&scene, &motion, &VerifySettings { evaluations: 10, ..VerifySettings::default() });
    assert!(matches!(verdict.violations[..], [_, ..]));
    assert!(verdict.violations.iter().all(|v| matches!(v, Violation::Undecided { .. })), "{verdict:?}");
    let asked = Cell::new(0);
    let verdict = verify_until(&scene, &motion, &VerifySettings::default(), &|| {
        asked.set(asked.get() + 1);
        asked.get() < 3
    });
    assert!(verdict.violations.iter().any(|v| matches!(v, Violation::Stopped { .. })), "{verdict:?}");
    assert!(verdict.least_clearance.unwrap().at_least.is_none());
}

#[test]
fn a_certified_trajectory_keeps_its_motion() {
    let motion = rest_to_rest([0.0, 0.0], [1.0, 0.5], 1.0);
    let certified =
        Trajectory::certify(&scene(0.0, Vec::new()), motion.clone(), &VerifySettings::default()).unwrap();
    assert_eq!(certified.motion(), &motion);
    assert!(certified.verdict().is_safe() && certified.verdict().least_clearance.is_none());
    assert_eq!(certified.into_motion(), motion);
}
