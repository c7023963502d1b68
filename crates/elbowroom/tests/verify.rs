//! The verifier against closed forms, and against a dense judge with formulas of its own.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};

use elbowroom::arm::{Configuration, Joint, JointLimits, MotionLimits, TwoLinkArm};
use elbowroom::geometry::{Circle, Point, Polygon};
use elbowroom::grid::Grid;
use elbowroom::scene::{Obstacle, Scene, Shape};
use elbowroom::trajectory::{Motion, Piece, State, durations_by_length, quintic_through, vias_at};
use elbowroom::verify::{
    FLOOR, Quantity, Rate, Trajectory, Verdict, VerifySettings, Violation, verify, verify_until,
};

const FREE: Joint = Joint {
    limits: JointLimits::Continuous,
    motion: MotionLimits { velocity: None, acceleration: None, jerk: None },
};

/// Seeded uniform numbers.
struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }
}

fn circle(x: f64, y: f64, radius: f64) -> Obstacle {
    Obstacle { name: None, shape: Shape::Circle(Circle { center: Point::new(x, y), radius }) }
}

fn polygon(vertices: &[[f64; 2]]) -> Obstacle {
    let vertices = vertices.iter().map(|&[x, y]| Point::new(x, y)).collect();
    Obstacle { name: None, shape: Shape::Polygon(Polygon::new(vertices).unwrap()) }
}

fn scene_with(lengths: [f64; 2], half_width: f64, joints: [Joint; 2], obstacles: Vec<Obstacle>) -> Scene {
    let arm = TwoLinkArm::new(Point::new(0.0, 0.0), lengths, half_width, joints).unwrap();
    let grid = Grid::new([-2.0, 2.0], [-2.0, 2.0], 0.5).unwrap();
    Scene { arm, grid, obstacles, tasks: Vec::new() }
}

fn scene(half_width: f64, obstacles: Vec<Obstacle>) -> Scene {
    scene_with([1.0, 0.5], half_width, [FREE; 2], obstacles)
}

fn rest_to_rest(from: [f64; 2], to: [f64; 2], duration: f64) -> Motion<2> {
    Motion::new(vec![Piece::quintic(0.0, duration, &State::rest(from), &State::rest(to))]).unwrap()
}

fn standing(at: [f64; 2]) -> Motion<2> {
    let coefficients = at.map(|q| [q, 0.0, 0.0, 0.0, 0.0, 0.0]);
    Motion::new(vec![Piece { start: 0.0, duration: 0.0, coefficients }]).unwrap()
}

fn straight(start: f64, duration: f64, from: [f64; 2], to: [f64; 2]) -> Piece<2> {
    let coefficients = [0, 1].map(|j| [from[j], (to[j] - from[j]) / duration, 0.0, 0.0, 0.0, 0.0]);
    Piece { start, duration, coefficients }
}

fn judged(scene: &Scene, motion: &Motion<2>) -> Verdict {
    verify(scene, motion, &VerifySettings::default())
}

// ---- closed forms ----

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
    assert_eq!((clearance.link, clearance.obstacle), (2, 0));
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
    let Violation::Contact { time, link: 1, obstacle: 0, depth } = first else { panic!("{verdict:?}") };
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
            let joint = Joint { limits: JointLimits::Continuous, motion: limits };
            let verdict = judged(&scene_with([1.0, 0.5], 0.0, [FREE, joint], Vec::new()), &motion);
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
        let joint = Joint { limits: JointLimits::range(-1.0, max).unwrap(), ..FREE };
        let scene = scene_with([1.0, 0.5], 0.0, [joint, FREE], Vec::new());
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
        Piece { start: 5.0, duration: 1.0, coefficients: [[0.0, 4.0, -4.0, 0.0, 0.0, 0.0], [0.0; 6]] };
    let joint = Joint { limits: JointLimits::range(-1.0, 1.0 - 1e-9).unwrap(), ..FREE };
    let verdict =
        judged(&scene_with([1.0, 0.5], 0.0, [joint, FREE], Vec::new()), &Motion::new(vec![piece]).unwrap());
    let [Violation::JointLimit { joint: 1, time, angle, .. }] = verdict.violations[..] else {
        panic!("{verdict:?}")
    };
    assert!((time - 5.5).abs() < 1e-6 && (angle - 1.0).abs() < 1e-12);
}

#[test]
fn pieces_that_do_not_join_are_found() {
    let from = State::rest([0.0, 0.0]);
    let via = State { position: [0.5, 0.1], velocity: [0.3, 0.2], acceleration: [0.1, -0.1], jerk: [0.0; 2] };
    let to = State::rest([1.0, 0.0]);
    let with = |second: &State<2>, from2: f64| {
        let pieces = vec![Piece::quintic(0.0, 1.0, &from, &via), Piece::quintic(from2, 1.0, second, &to)];
        judged(&scene(0.0, Vec::new()), &Motion::new(pieces).unwrap())
    };
    assert!(with(&via, 1.0).is_safe());
    for (what, joint) in [Quantity::Position, Quantity::Velocity, Quantity::Acceleration]
        .into_iter()
        .flat_map(|what| [(what, 0), (what, 1)])
    {
        let mut other = via;
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
        Piece { start: 0.0, duration: 2.0, coefficients: [[0.0; 6], [1.0, -2.0, 1.0, 0.0, 0.0, 0.0]] };
    near(changes(vec![touch]), &[]);
    let cubic =
        Piece { start: 0.0, duration: 2.0, coefficients: [[0.0; 6], [-1.0, 3.0, -3.0, 1.0, 0.0, 0.0]] };
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
    // A disc as large as a country beside the arm, and one that overflows.
    for (radius, gap, safe) in [
        (1e6, 0.1, true),
        (1e6, -1e-3, false),
        (1e9, 1.0, true),
        (1e200, 1e3, false),
        (f64::INFINITY, 1.0, false),
    ] {
        let disc = scene(0.0, vec![circle(0.0, 1.5 + gap + radius, radius)]);
        let motion = rest_to_rest([0.0, 0.0], [PI, 0.0], 1.0);
        assert_eq!(judged(&disc, &motion).is_safe(), safe, "{radius} {gap}");
    }
    for number in [f64::NAN, f64::NEG_INFINITY] {
        let odd = scene(0.0, vec![circle(number, 0.0, 1.0), circle(9.0, 9.0, number.abs())]);
        assert!(!judged(&odd, &rest_to_rest([0.0, 0.0], [1.0, 0.0], 1.0)).is_safe());
    }
    for (c, duration) in
        [(1e308, 1.0), (1e300, 1e10), (1e20, 1.0), (1.0, 1e100), (5e-324, 1e-300), (1e308, 1e-308)]
    {
        for k in 0..6 {
            let mut coefficients = [[0.0; 6]; 2];
            coefficients[1][k] = c;
            let motion = Motion::new(vec![Piece { start: 0.0, duration, coefficients }]).unwrap();
            let verdict = judged(&post(1e-3), &motion);
            assert!(!verdict.violations.iter().any(|v| v.time().is_nan()), "{verdict:?}");
        }
    }
    let overflow =
        Piece { start: 0.0, duration: 1e100, coefficients: [[0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [0.0; 6]] };
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

// ---- the dense judge ----

type P = [f64; 2];

fn sub(a: P, b: P) -> P {
    [a[0] - b[0], a[1] - b[1]]
}

fn norm(v: P) -> f64 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

/// Closest points of two segments by alternating clamps: Ericson, *Real-Time Collision Detection*, 5.1.9.
fn segment_distance([p1, q1]: [P; 2], [p2, q2]: [P; 2]) -> f64 {
    let dot = |a: P, b: P| a[0] * b[0] + a[1] * b[1];
    let (d1, d2, r) = (sub(q1, p1), sub(q2, p2), sub(p1, p2));
    let (a, e, b, c, f) = (dot(d1, d1), dot(d2, d2), dot(d1, d2), dot(d1, r), dot(d2, r));
    let denominator = a * e - b * b;
    let mut s =
        if denominator > 1e-14 * a * e { ((b * f - c * e) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let mut t = (b * s + f) / e;
    if !(0.0..=1.0).contains(&t) {
        t = t.clamp(0.0, 1.0);
        s = ((b * t - c) / a).clamp(0.0, 1.0);
    }
    norm([p1[0] + s * d1[0] - p2[0] - t * d2[0], p1[1] + s * d1[1] - p2[1] - t * d2[1]])
}

/// Whether the polygon goes round the point, by the sum of the angles under which its edges are seen.
fn goes_round(point: P, vertices: &[P]) -> bool {
    let turn: f64 = (0..vertices.len())
        .map(|i| {
            let (a, b) = (sub(vertices[i], point), sub(vertices[(i + 1) % vertices.len()], point));
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
        })
        .sum();
    turn.abs() > PI
}

enum JudgeShape {
    Disc(P, f64),
    Polygon(Vec<P>),
}

struct DenseJudge {
    base: P,
    lengths: [f64; 2],
    half_width: f64,
    shapes: Vec<JudgeShape>,
}

const SAMPLES: usize = 20_000;

fn sample_time(motion: &Motion<2>, i: usize) -> f64 {
    motion.start() + motion.duration() * i as f64 / SAMPLES as f64
}

impl DenseJudge {
    fn new(scene: &Scene) -> Self {
        let shapes = scene.obstacles.iter().map(|obstacle| match &obstacle.shape {
            Shape::Circle(c) => JudgeShape::Disc([c.center.x, c.center.y], c.radius),
            Shape::Polygon(p) => JudgeShape::Polygon(p.vertices().iter().map(|v| [v.x, v.y]).collect()),
        });
        Self {
            base: [scene.arm.base().x, scene.arm.base().y],
            lengths: scene.arm.lengths(),
            half_width: scene.arm.half_width(),
            shapes: shapes.collect(),
        }
    }

    fn axes(&self, motion: &Motion<2>, t: f64) -> [[P; 2]; 2] {
        let pieces = motion.pieces();
        let piece = pieces.iter().rfind(|piece| piece.start <= t).unwrap_or(&pieces[0]);
        let s = (t - piece.start).clamp(0.0, piece.duration);
        let [q1, q2] =
            piece.coefficients.map(|terms| terms.iter().rev().fold(0.0, |sum, term| sum * s + term));
        let elbow = [self.base[0] + self.lengths[0] * q1.cos(), self.base[1] + self.lengths[0] * q1.sin()];
        let (sin, cos) = (q1 + q2).sin_cos();
        let tip = [elbow[0] + self.lengths[1] * cos, elbow[1] + self.lengths[1] * sin];
        [[self.base, elbow], [elbow, tip]]
    }

    fn clearance(&self, motion: &Motion<2>, t: f64, link: usize, obstacle: usize) -> f64 {
        self.clearance_of(self.axes(motion, t)[link], obstacle)
    }

    fn clearance_of(&self, axis: [P; 2], obstacle: usize) -> f64 {
        let distance = match &self.shapes[obstacle] {
            JudgeShape::Disc(center, radius) => {
                let d = sub(axis[1], axis[0]);
                let r = sub(*center, axis[0]);
                let s = ((r[0] * d[0] + r[1] * d[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
                norm([r[0] - s * d[0], r[1] - s * d[1]]) - radius
            }
            JudgeShape::Polygon(vertices) => {
                let edges = (0..vertices.len()).map(|i| [vertices[i], vertices[(i + 1) % vertices.len()]]);
                let outside = edges.map(|edge| segment_distance(axis, edge)).fold(f64::INFINITY, f64::min);
                // No polygon here reaches 0.3 m from its middle, so nothing farther than that from its edges is inside.
                if outside > 0.0 && outside < 0.3 && goes_round(axis[0], vertices) { 0.0 } else { outside }
            }
        };
        distance - self.half_width
    }

    /// Least clearance of a pair found by samples, with every dip among them followed down; and the first of
    /// the times looked at with a clearance not above 0.
    fn sweep(
        &self,
        motion: &Motion<2>,
        axes: &[[[P; 2]; 2]],
        link: usize,
        obstacle: usize,
    ) -> (f64, Option<f64>) {
        let time = |i: usize| sample_time(motion, i);
        let at = |t: f64| self.clearance(motion, t, link, obstacle);
        let samples: Vec<f64> = axes.iter().map(|axes| self.clearance_of(axes[link], obstacle)).collect();
        let mut least = f64::INFINITY;
        let mut first = None;
        for i in 0..=SAMPLES {
            let mut low = (samples[i], time(i));
            let dips = i > 0 && i < SAMPLES && {
                let (before, after) = (samples[i - 1], samples[i + 1]);
                // A level stretch has no bottom to look for.
                samples[i] <= before && samples[i] <= after && before.max(after) > samples[i] + 1e-12
            };
            if dips && samples[i] < 0.05 {
                let (mut a, mut b) = (time(i - 1), time(i + 1));
                for _ in 0..60 {
                    let (c, d) = (a + (b - a) * 0.382, a + (b - a) * 0.618);
                    if at(c) < at(d) { b = d } else { a = c }
                }
                let t = 0.5 * (a + b);
                low = if at(t) < low.0 { (at(t), t) } else { low };
            }
            if low.0 <= 1e-12 && first.is_none() {
                first = Some(low.1);
            }
            least = least.min(low.0);
        }
        (least, first)
    }
}

fn random_scene(numbers: &mut Numbers) -> Scene {
    let lengths = [numbers.between(0.3, 1.0), numbers.between(0.3, 1.0)];
    let half_width = if numbers.below(2) == 0 { 0.0 } else { numbers.between(0.0, 0.05) };
    let base = Point::new(numbers.between(-0.5, 0.5), numbers.between(-0.5, 0.5));
    let joints = [0, 1].map(|_| {
        if numbers.below(2) == 0 {
            FREE
        } else {
            Joint {
                limits: JointLimits::range(numbers.between(-4.0, -2.0), numbers.between(2.0, 4.0)).unwrap(),
                ..FREE
            }
        }
    });
    let arm = TwoLinkArm::new(base, lengths, half_width, joints).unwrap();
    let reach = lengths[0] + lengths[1];
    let obstacles = (0..1 + numbers.below(4))
        .map(|_| {
            let (way, angle) = (numbers.between(0.15, 1.2) * reach, numbers.between(-PI, PI));
            let [x, y] = [base.x + way * angle.cos(), base.y + way * angle.sin()];
            match numbers.below(4) {
                0 => circle(x, y, 5e-5),
                1 => circle(x, y, numbers.between(0.01, 0.2)),
                2 => {
                    // A wall 0.1 mm thick.
                    let (tilt, long) = (numbers.between(0.0, PI), numbers.between(0.05, 0.3));
                    let (u, v) =
                        ([tilt.cos() * long, tilt.sin() * long], [-tilt.sin() * 1e-4, tilt.cos() * 1e-4]);
                    polygon(&[
                        [x, y],
                        [x + u[0], y + u[1]],
                        [x + u[0] + v[0], y + u[1] + v[1]],
                        [x + v[0], y + v[1]],
                    ])
                }
                _ => {
                    let corners = 3 + numbers.below(6);
                    let star: Vec<P> = (0..corners)
                        .map(|i| {
                            let turn = (i as f64 + numbers.between(0.1, 0.9)) / corners as f64 * 2.0 * PI;
                            let radius = numbers.between(0.03, 0.25);
                            [x + radius * turn.cos(), y + radius * turn.sin()]
                        })
                        .collect();
                    polygon(&star)
                }
            }
        })
        .collect();
    let grid = Grid::new([-2.0, 2.0], [-2.0, 2.0], 0.5).unwrap();
    Scene { arm, grid, obstacles, tasks: Vec::new() }
}

fn random_motion(numbers: &mut Numbers) -> Motion<2> {
    let spread = if numbers.below(3) == 0 { 0.4 } else { 2.5 };
    let places: Vec<Configuration<2>> = (0..2 + numbers.below(5))
        .map(|_| Configuration([numbers.between(-spread, spread), numbers.between(-spread, spread)]))
        .collect();
    let vias = vias_at(&places);
    Motion::new(quintic_through(&vias, &durations_by_length(&vias, numbers.between(0.5, 20.0)))).unwrap()
}

#[test]
fn the_dense_judge_agrees_on_random_scenes() {
    std::thread::scope(|scope| {
        for seed in [7, 8] {
            scope.spawn(move || the_dense_judge_agrees(seed, 1000));
        }
    });
}

fn the_dense_judge_agrees(seed: u64, cases: usize) {
    let mut numbers = Numbers(seed);
    let (mut safe, mut in_contact) = (0, 0);
    for case in 0..cases {
        let scene = random_scene(&mut numbers);
        let motion = random_motion(&mut numbers);
        let verdict = judged(&scene, &motion);
        let judge = DenseJudge::new(&scene);
        let axes: Vec<_> = (0..=SAMPLES).map(|i| judge.axes(&motion, sample_time(&motion, i))).collect();
        let mut least = f64::INFINITY;
        for obstacle in 0..scene.obstacles.len() {
            for link in 0..2 {
                let (clearance, first) = judge.sweep(&motion, &axes, link, obstacle);
                least = least.min(clearance);
                let found = verdict.violations.iter().find(|violation| match violation {
                    Violation::Contact { link: l, obstacle: o, .. }
                    | Violation::Undecided { link: l, obstacle: o, .. } => (*l, *o) == (link + 1, obstacle),
                    _ => false,
                });
                let context =
                    format!("case {case} link {link} obstacle {obstacle}: {clearance} {first:?} {found:?}");
                if clearance <= 0.0 {
                    assert!(found.is_some(), "called safe: {context}");
                }
                if clearance > 1e-6 {
                    assert!(found.is_none(), "false alarm: {context}");
                }
                if let (Some(Violation::Contact { time, depth, .. }), Some(first)) = (found, first) {
                    // As first as the judge's, and in contact by the judge's formulas.
                    assert!(*time <= first + 1e-9, "{context}");
                    assert!(judge.clearance(&motion, *time, link, obstacle) <= FLOOR + 1e-12, "{context}");
                    assert!(first - *time <= motion.duration() / SAMPLES as f64 * 2.01, "{context}");
                    assert!(*depth >= 0.0 && *depth <= FLOOR - clearance + 1e-9, "{context}");
                }
            }
        }
        let nearest = verdict.least_clearance.unwrap();
        let again = judge.clearance(&motion, nearest.time, nearest.link - 1, nearest.obstacle);
        assert!((again - nearest.distance).abs() < 1e-9, "case {case}: {nearest:?} {again}");
        match nearest.at_least {
            Some(at_least) => {
                safe += 1;
                assert!(at_least <= least + 1e-12, "case {case}: {at_least} {least}");
                assert!(
                    nearest.distance - at_least <= (0.0101 * nearest.distance).max(1.01e-6),
                    "case {case}: {nearest:?}"
                );
                assert!(
                    nearest.distance <= least + (0.0101 * least).max(1.01e-6),
                    "case {case}: {nearest:?} {least}"
                );
            }
            None => in_contact += 1,
        }
        for joint in 0..2 {
            agree_on_joint(&scene, &motion, &verdict, joint);
        }
    }
    assert!(safe > 150 && in_contact > 150, "{safe} safe, {in_contact} in contact");
}

/// Sampled positions and rates lie within the verdict's extremes and come close to them.
fn agree_on_joint(scene: &Scene, motion: &Motion<2>, verdict: &Verdict, joint: usize) {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    let mut rates = [0.0f64; 3];
    for piece in motion.pieces() {
        for i in 0..=100 {
            let state = piece.at(piece.duration * f64::from(i) / 100.0);
            range = [range[0].min(state.position[joint]), range[1].max(state.position[joint])];
            for (rate, value) in rates.iter_mut().zip([state.velocity, state.acceleration, state.jerk]) {
                *rate = rate.max(value[joint].abs());
            }
        }
    }
    let margins = verdict.motion_margins[joint];
    for (sampled, margin) in rates.into_iter().zip([margins.velocity, margins.acceleration, margins.jerk]) {
        assert!(
            sampled <= margin.largest * (1.0 + 1e-12) && sampled >= margin.largest * 0.98,
            "{sampled} {margin:?}"
        );
    }
    let beyond = verdict
        .violations
        .iter()
        .any(|v| matches!(v, Violation::JointLimit { joint: j, .. } if *j == joint + 1));
    match scene.arm.joints()[joint].limits {
        JointLimits::Continuous => assert!(!beyond && verdict.joint_margins[joint].is_none()),
        JointLimits::Range { min, max } => {
            let sampled = (range[0] - min).min(max - range[1]);
            let margin = verdict.joint_margins[joint].unwrap().distance;
            assert!(margin <= sampled + 1e-12 && margin >= sampled - 0.02, "{margin} {sampled}");
            assert_eq!(beyond, margin < -1e-12);
        }
    }
}
