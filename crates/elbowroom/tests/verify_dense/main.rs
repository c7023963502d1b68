//! The verifier against a dense judge with formulas of its own, on random scenes.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "../worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
mod dense_judge;

use dense_judge::{DenseJudge, SAMPLES, sample_time};
use std::f64::consts::PI;

use build::{circle, polygon};
use elbowroom::arm::{Arm, Joint, JointLimits};
use elbowroom::geometry::Point;
use elbowroom::scene::Scene;
use elbowroom::trajectory::{Motion, durations_by_length, quintic_through, vias_at};
use elbowroom::verify::{Against, FLOOR, Verdict, VerifySettings, Violation, verify};

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

fn judged(scene: &Scene, motion: &Motion) -> Verdict {
    verify(scene, motion, &VerifySettings::default())
}

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
    /// A core of two vertices or more, and how far from it the shape ends.
    Polygon(Vec<P>, f64),
}

fn random_scene(numbers: &mut Numbers) -> Scene {
    let lengths = [numbers.between(0.3, 1.0), numbers.between(0.3, 1.0)];
    let half_width = if numbers.below(2) == 0 { 0.0 } else { numbers.between(0.0, 0.05) };
    let base = Point::new(numbers.between(-0.5, 0.5), numbers.between(-0.5, 0.5));
    let joints = [0, 1].map(|_| {
        if numbers.below(2) == 0 {
            Joint::CONTINUOUS
        } else {
            build::joint(build::stops(numbers.between(-4.0, -2.0), numbers.between(2.0, 4.0)))
        }
    });
    let arm = Arm::new(base, lengths.to_vec(), half_width, joints.to_vec(), false).unwrap();
    let reach = lengths[0] + lengths[1];
    let obstacles = (0..1 + numbers.below(4))
        .map(|_| {
            let (way, angle) = (numbers.between(0.15, 1.2) * reach, numbers.between(-PI, PI));
            let [x, y] = [base.x + way * angle.cos(), base.y + way * angle.sin()];
            match numbers.below(6) {
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
                3 => {
                    let (tilt, long) = (numbers.between(0.0, PI), numbers.between(0.05, 0.3));
                    let radius = [0.0, 5e-5, 0.03][numbers.below(3)];
                    build::segment([[x, y], [x + tilt.cos() * long, y + tilt.sin() * long]], radius)
                }
                kind => {
                    let corners = 3 + numbers.below(6);
                    let star: Vec<P> = (0..corners)
                        .map(|i| {
                            let turn = (i as f64 + numbers.between(0.1, 0.9)) / corners as f64 * 2.0 * PI;
                            let radius = numbers.between(0.03, 0.25);
                            [x + radius * turn.cos(), y + radius * turn.sin()]
                        })
                        .collect();
                    if kind == 4 { build::rounded(&star, 0.02) } else { polygon(&star) }
                }
            }
        })
        .collect();
    build::scene(arm, obstacles)
}

fn random_motion(numbers: &mut Numbers) -> Motion {
    let spread = if numbers.below(3) == 0 { 0.4 } else { 2.5 };
    let places: Vec<[f64; 2]> = (0..2 + numbers.below(5))
        .map(|_| [numbers.between(-spread, spread), numbers.between(-spread, spread)])
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
        for obstacle in 0..scene.obstacles().len() {
            for link in 0..2 {
                let (clearance, first) = judge.sweep(&motion, &axes, link, obstacle);
                least = least.min(clearance);
                let found = verdict.violations.iter().find(|violation| match violation {
                    Violation::Contact { link: l, against: a, .. }
                    | Violation::Undecided { link: l, against: a, .. } => {
                        (*l, *a) == (link + 1, Against::Obstacle(obstacle))
                    }
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
        let Against::Obstacle(obstacle) = nearest.against else { panic!("{nearest:?}") };
        let again = judge.clearance(&motion, nearest.time, nearest.link - 1, obstacle);
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

#[test]
fn a_micrometre_is_told_from_contact_on_random_motions() {
    let mut numbers = Numbers(3);
    let mut cases = 0;
    while cases < 300 {
        let (scene, motion) = (random_scene(&mut numbers), random_motion(&mut numbers));
        let (way, angle) = (numbers.between(0.2, 2.0), numbers.between(-PI, PI));
        let center = [way * angle.cos(), way * angle.sin()];
        let (arm, joints) = (scene.arm(), vec![Joint::CONTINUOUS; 2]);
        let arm = Arm::new(arm.base(), arm.lengths().to_vec(), arm.half_width(), joints, false).unwrap();
        let judge = DenseJudge::among(&arm, vec![JudgeShape::Disc(center, 0.0)]);
        let axes: Vec<_> = (0..=SAMPLES).map(|i| judge.axes(&motion, sample_time(&motion, i))).collect();
        let least = judge.least(&motion, &axes, 0);
        if least < 0.01 {
            continue;
        }
        cases += 1;
        // Blow the point up until so much is left.
        for (gap, safe) in [(1e-6, true), (0.9 * FLOOR, false), (0.0, false), (-1e-8, false)] {
            let scene = build::scene(arm.clone(), vec![circle(center[0], center[1], least - gap)]);
            let verdict = judged(&scene, &motion);
            assert_eq!(verdict.is_safe(), safe, "case {cases} {gap} {least} {verdict:?}");
            let nearest = verdict.least_clearance.unwrap();
            assert!(
                nearest.distance >= gap - 1e-11 && nearest.distance <= gap + 1.01e-6,
                "{gap} {nearest:?}"
            );
        }
    }
}

/// Sampled positions and rates lie within the verdict's extremes and come close to them.
fn agree_on_joint(scene: &Scene, motion: &Motion, verdict: &Verdict, joint: usize) {
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
    match scene.arm().joints()[joint].limits {
        JointLimits::Continuous => assert!(!beyond && verdict.joint_margins[joint].is_none()),
        JointLimits::Range { min, max } => {
            let sampled = (range[0] - min).min(max - range[1]);
            let margin = verdict.joint_margins[joint].unwrap().distance;
            assert!(margin <= sampled + 1e-12 && margin >= sampled - 0.02, "{margin} {sampled}");
            assert_eq!(beyond, margin < -1e-12);
        }
    }
}
