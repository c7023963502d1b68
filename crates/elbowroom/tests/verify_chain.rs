//! Arms of more than two links: the verifier and certified turns against a judge that samples, kinematics against
//! textbook formulas.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;

use std::f64::consts::PI;

use elbowroom::arm::{Arm, ArmError, Joint};
use elbowroom::geometry::Point;
use elbowroom::path::straight_move_is_free;
use elbowroom::scene::Scene;
use elbowroom::trajectory::{Motion, Piece, State, durations_by_length, quintic_through, vias_at};
use elbowroom::verify::{Against, FLOOR, Verdict, VerifySettings, Violation, verify};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

type P = [f64; 2];

const FREE: Joint = Joint::CONTINUOUS;

struct Numbers(ChaCha8Rng);

impl Numbers {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    fn angles(&mut self, count: usize, spread: f64) -> Vec<f64> {
        (0..count).map(|_| self.within(-spread, spread)).collect()
    }
}

/// Where base, joints and tip are at `q` (m): sums of sines and cosines, nothing shared with the crate.
fn skeleton(arm: &Arm, q: &[f64]) -> Vec<P> {
    let mut points = vec![[arm.base().x, arm.base().y]];
    for (k, length) in arm.lengths().iter().enumerate() {
        let direction: f64 = q[..=k].iter().sum();
        let [x, y] = points[k];
        points.push([x + length * direction.cos(), y + length * direction.sin()]);
    }
    points
}

/// Distance between two segments: of the ends, unless they cross.
fn between(a: [P; 2], b: [P; 2]) -> f64 {
    let to = |p: P, [s, e]: [P; 2]| {
        let (dx, dy) = (e[0] - s[0], e[1] - s[1]);
        let t = (((p[0] - s[0]) * dx + (p[1] - s[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        (p[0] - s[0] - t * dx).hypot(p[1] - s[1] - t * dy)
    };
    let side = |[s, e]: [P; 2], p: P| (e[0] - s[0]) * (p[1] - s[1]) - (e[1] - s[1]) * (p[0] - s[0]);
    let crosses = side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0;
    if crosses { 0.0 } else { to(a[0], b).min(to(a[1], b)).min(to(b[0], a)).min(to(b[1], a)) }
}

/// Every clearance at `q` (m): of links from obstacles, and of links from links.
fn clearances(scene: &Scene, q: &[f64]) -> Vec<((usize, Against), f64)> {
    let points = skeleton(scene.arm(), q);
    let links: Vec<[P; 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let width = scene.arm().half_width();
    let mut found = Vec::new();
    for (i, link) in links.iter().enumerate() {
        for (o, obstacle) in scene.obstacles().iter().enumerate() {
            let key = (i + 1, Against::Obstacle(o));
            found.push((key, distance::distance(obstacle, link[0], link[1]) - width));
        }
        if scene.arm().self_collision() {
            for (other, before) in links.iter().enumerate().take(i.saturating_sub(1)) {
                found.push(((i + 1, Against::Link(other + 1)), between(*before, *link) - 2.0 * width));
            }
        }
    }
    found
}

fn random_scene(numbers: &mut Numbers) -> Scene {
    let links = 2 + numbers.below(7);
    let lengths: Vec<f64> = (0..links).map(|_| numbers.within(0.1, 0.4)).collect();
    let half_width = [0.0, 0.005, 0.03][numbers.below(3)];
    let base = Point::new(numbers.within(-0.2, 0.2), numbers.within(-0.2, 0.2));
    let reach: f64 = lengths.iter().sum();
    let arm = Arm::new(base, lengths, half_width, vec![FREE; links], numbers.below(3) > 0).unwrap();
    let obstacles = (0..numbers.below(4))
        .map(|_| {
            let (way, angle) = (numbers.within(0.1, 1.1) * reach, numbers.within(-PI, PI));
            let center = Point::new(base.x + way * angle.cos(), base.y + way * angle.sin());
            match numbers.below(3) {
                0 => build::circle(center.x, center.y, numbers.within(1e-4, 0.2)),
                1 => {
                    let corners = 3 + numbers.below(5);
                    let corner = |i: usize| {
                        let turn = (i as f64 + numbers.within(0.1, 0.9)) / corners as f64 * 2.0 * PI;
                        let radius = numbers.within(0.03, 0.2);
                        [center.x + radius * turn.cos(), center.y + radius * turn.sin()]
                    };
                    build::polygon(&(0..corners).map(corner).collect::<Vec<_>>())
                }
                _ => {
                    // A wall a tenth of a millimetre thick.
                    let end = [center.x + numbers.within(-0.3, 0.3), center.y + 0.1];
                    let thick = [center.x + 1e-4, center.y];
                    build::polygon(&[[center.x, center.y], thick, end])
                }
            }
        })
        .collect();
    build::scene(arm, obstacles)
}

fn random_motion(numbers: &mut Numbers, joints: usize) -> Motion {
    let spread = [0.1, 0.6, 2.5][numbers.below(3)];
    let middle = numbers.angles(joints, 1.5);
    let place = |numbers: &mut Numbers| -> Vec<f64> {
        numbers.angles(joints, spread).iter().zip(&middle).map(|(a, b)| a + b).collect()
    };
    let places: Vec<Vec<f64>> = (0..2 + numbers.below(4)).map(|_| place(numbers)).collect();
    let vias = vias_at(&places);
    Motion::new(quintic_through(&vias, &durations_by_length(&vias, numbers.within(0.5, 10.0)))).unwrap()
}

fn judged(scene: &Scene, motion: &Motion) -> Verdict {
    verify(scene, motion, &VerifySettings::default())
}

#[test]
fn a_judge_that_samples_agrees_on_random_arms() {
    let totals = std::thread::scope(|scope| {
        let runs = [3, 4].map(|seed| scope.spawn(move || the_sampler_agrees(seed, 500)));
        runs.map(|run| run.join().unwrap())
    });
    let [safe, obstacles, links] = [0, 1, 2].map(|kind| totals[0][kind] + totals[1][kind]);
    assert!(safe > 150 && obstacles > 150 && links > 150, "{safe} safe, {obstacles} and {links} contacts");
}

/// How many motions were safe, and how many contacts with obstacles and with links there were.
fn the_sampler_agrees(seed: u64, cases: usize) -> [usize; 3] {
    const SAMPLES: usize = 1500;
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(seed));
    let mut counts = [0; 3];
    for case in 0..cases {
        let scene = random_scene(&mut numbers);
        let motion = random_motion(&mut numbers, scene.arm().links());
        let verdict = judged(&scene, &motion);
        let mut least: Vec<((usize, Against), f64)> = Vec::new();
        for i in 0..=SAMPLES {
            let q = motion.at(motion.duration() * i as f64 / SAMPLES as f64).position;
            for (k, (key, clearance)) in clearances(&scene, &q).into_iter().enumerate() {
                match least.get_mut(k) {
                    Some((_, known)) => *known = known.min(clearance),
                    None => least.push((key, clearance)),
                }
            }
        }
        let find = |key: (usize, Against)| {
            verdict.violations.iter().find(|violation| match violation {
                Violation::Contact { link, against, .. } | Violation::Undecided { link, against, .. } => {
                    (*link, *against) == key
                }
                _ => false,
            })
        };
        for &(key, clearance) in &least {
            let found = find(key);
            let context = format!("seed {seed}, case {case}, {key:?}: {clearance}, {found:?}");
            assert!(clearance > 0.0 || found.is_some(), "called safe: {context}");
            if let Some(Violation::Contact { time, depth, .. }) = found {
                let at = clearances(&scene, &motion.at(*time).position);
                let (_, there) = at.into_iter().find(|(other, _)| *other == key).unwrap();
                assert!(there <= FLOOR + 1e-12, "no contact there, {there}: {context}");
                // Of this contact; a later one may be deeper, and the sampler may miss its bottom.
                assert!(*depth >= 0.0 && *depth <= FLOOR - clearance + 1e-2, "{depth}: {context}");
                counts[if matches!(key.1, Against::Link(_)) { 2 } else { 1 }] += 1;
            }
        }
        assert!(
            verdict.violations.iter().all(|violation| matches!(violation, Violation::Contact { .. })),
            "seed {seed}, case {case}: {:?}",
            verdict.violations
        );
        let sampled = least.iter().map(|(_, clearance)| *clearance).fold(f64::INFINITY, f64::min);
        match verdict.least_clearance {
            None => assert!(least.is_empty(), "seed {seed}, case {case}"),
            Some(nearest) => {
                let at = clearances(&scene, &motion.at(nearest.time).position);
                let key = (nearest.link, nearest.against);
                let (_, again) = at.into_iter().find(|(other, _)| *other == key).unwrap();
                // Inside a polygon the sampler gives depths that the verdict does not.
                let same = (again - nearest.distance).abs() < 1e-9 || again < 0.0;
                assert!(same, "seed {seed}, case {case}: {nearest:?} {again}");
                if let Some(at_least) = nearest.at_least {
                    counts[0] += 1;
                    assert!(at_least <= sampled + 1e-12, "seed {seed}, case {case}: {at_least} {sampled}");
                }
            }
        }
        assert_eq!(verdict.joint_margins.len(), scene.arm().links());
    }
    counts
}

#[test]
fn the_closed_forms_of_two_links_are_those_of_the_chain_bit_for_bit() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(5));
    for case in 0..3000 {
        let scene = random_scene(&mut numbers);
        assert_eq!(scene.two_link().is_ok(), scene.arm().links() == 2);
        let chain = scene.arm();
        let joints = [FREE, build::joint(build::stops(-2.0, 2.5))];
        let joints = [joints[case % 2], joints[case / 2 % 2]].to_vec();
        let lengths = chain.lengths()[..2].to_vec();
        let arm = Arm::new(chain.base(), lengths, chain.half_width(), joints, false).unwrap();
        let two = arm.two_link().unwrap();
        assert_eq!((two.base(), two.half_width()), (arm.base(), arm.half_width()));
        assert_eq!((&two.lengths()[..], &two.joints()[..]), (arm.lengths(), arm.joints()));
        let mut pair = || [numbers.within(-4.0, 4.0), numbers.within(-4.0, 4.0)];
        let (q, to) = (pair(), pair());
        assert_eq!(two.tip(&q), arm.tip(&q));
        assert!([two.elbow(&q), two.tip(&q)].into_iter().eq(arm.link_ends(&q)));
        assert!(two.link_segments(&q).into_iter().eq(arm.link_segments(&q)));
        assert_eq!(two.within_limits(&q), arm.within_limits(&q));
        assert_eq!(arm.difference(&q, &to), two.difference(&q, &to)[..]);
    }
}

#[test]
fn a_link_that_turns_back_on_the_arm_touches_it_when_it_should() {
    // Three links of 1 m: joints 2 and 3 turn so that the third crosses the first.
    let arm = |half_width, self_collision| {
        Arm::new(Point::new(0.0, 0.0), vec![1.0; 3], half_width, vec![FREE; 3], self_collision).unwrap()
    };
    let scene = |arm| build::scene(arm, Vec::new());
    // A triangle closes at 120 degrees: before, by symmetry of joints 2 and 3, the tip's distance from the first link is
    // that of a closed form; q2 = q3 = t from 0 to 2.2 rad.
    let from = State::rest(&[0.3, 0.0, 0.0]);
    let to = State::rest(&[0.3, 2.2, 2.2]);
    let motion = Motion::new(vec![Piece::quintic(0.0, 2.0, &from, &to)]).unwrap();
    assert!(judged(&scene(arm(0.01, false)), &motion).is_safe(), "not asked for");
    let verdict = judged(&scene(arm(0.01, true)), &motion);
    let [Violation::Contact { time, link: 3, against: Against::Link(1), .. }] = verdict.violations[..] else {
        panic!("{verdict:?}")
    };
    // With q2 = q3 = t the tip is at 1 + cos t + cos 2t along and sin t + sin 2t aside of the first link.
    let t = motion.at(time).position[1];
    let (along, aside) = (1.0 + t.cos() + (2.0 * t).cos(), t.sin() + (2.0 * t).sin());
    assert!((along.min(0.0).hypot(aside) - 0.02).abs() < 1e-8, "{along} {aside}");
    let text = verdict.violations[0].to_string();
    assert!(text.starts_with("link 3 touches link 1 from "), "{text}");
}

#[test]
fn a_motion_of_another_arm_is_refused() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(6));
    let scene = loop {
        let scene = random_scene(&mut numbers);
        if scene.arm().links() == 5 {
            break scene;
        }
    };
    let verdict = judged(&scene, &random_motion(&mut numbers, 3));
    let [Violation::OtherArm { found: 3, joints: 5, .. }] = verdict.violations[..] else {
        panic!("{verdict:?}")
    };
}

#[test]
fn certified_turns_are_free_and_refused_ones_come_near() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(7));
    let (mut free, mut refused) = (0, 0);
    for case in 0..3000 {
        let scene = random_scene(&mut numbers);
        let links = scene.arm().links();
        let spread = [0.05, 0.5, 2.0][case % 3];
        let from = numbers.angles(links, 1.5);
        let to: Vec<f64> =
            from.iter().zip(numbers.angles(links, spread)).map(|(angle, turn)| angle + turn).collect();
        let least = (0..=400)
            .flat_map(|i| {
                let at = |(a, b): (&f64, &f64)| a + (b - a) * f64::from(i) / 400.0;
                clearances(&scene, &from.iter().zip(&to).map(at).collect::<Vec<f64>>())
            })
            .map(|(_, clearance)| clearance)
            .fold(f64::INFINITY, f64::min);
        if straight_move_is_free(&scene, &from, &to) {
            free += 1;
            assert!(least > 0.0, "case {case}: {least}");
        } else {
            refused += 1;
            // Between two samples a point of the arm moves by no more than its reach times the joints' turns.
            let turn: f64 = from.iter().zip(&to).map(|(a, b)| (b - a).abs()).sum();
            let reach: f64 = scene.arm().lengths().iter().sum();
            assert!(least < reach * turn / 400.0 + 1e-6, "case {case}: {least}");
        }
        assert_eq!(
            straight_move_is_free(&scene, &from, &to),
            straight_move_is_free(&scene, &to, &from),
            "case {case}: both ways are one"
        );
    }
    assert!(free > 500 && refused > 500, "{free} {refused}");
}

#[test]
fn kinematics_are_those_of_the_textbook() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(8));
    for _ in 0..3000 {
        let arm = random_scene(&mut numbers).arm().clone();
        let q = numbers.angles(arm.links(), 3.0);
        let points = skeleton(&arm, &q);
        for (end, [x, y]) in arm.link_ends(&q).zip(&points[1..]) {
            assert!(end.distance(Point::new(*x, *y)) < 1e-14 * 10.0);
        }
        for (j, column) in arm.jacobian(&q).into_iter().enumerate() {
            let moved = |by: f64| {
                let mut q = q.clone();
                q[j] += by;
                arm.tip(&q)
            };
            let slope = (moved(1e-6) - moved(-1e-6)) * 5e5;
            assert!((slope.x - column.x).hypot(slope.y - column.y) < 1e-8);
        }
        let [nearest, farthest] = arm.reach();
        let distance = arm.tip(&q).distance(arm.base());
        assert!(distance >= nearest - 1e-12 && distance <= farthest + 1e-12);
    }
}

#[test]
fn the_nearest_inverse_puts_the_tip_where_it_shall_be_within_the_stops() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(9));
    let mut found = 0;
    for _ in 0..2000 {
        let free = random_scene(&mut numbers).arm().clone();
        let links = free.links();
        let joints = vec![build::joint(build::stops(-2.5, 2.5)); links];
        let arm = Arm::new(free.base(), free.lengths().to_vec(), 0.0, joints, false).unwrap();
        let tip = arm.tip(&numbers.angles(links, 2.4));
        if let Some(q) = arm.inverse_near(tip, &numbers.angles(links, 2.4)) {
            found += 1;
            assert!(arm.tip(&q).distance(tip) <= 1.1e-12 * arm.reach()[1]);
            assert!(arm.within_limits(&q));
        }
    }
    assert!(found > 1500, "{found} of 2000");
    let arm = random_scene(&mut numbers).arm().clone();
    let far = Point::new(arm.base().x + 2.0 * arm.reach()[1], arm.base().y);
    assert_eq!(arm.inverse_near(far, &numbers.angles(arm.links(), 1.0)), None);
}

#[test]
fn measures_that_make_no_arm_are_named() {
    let arm = |lengths: Vec<f64>, joints: usize, half_width: f64| {
        Arm::new(Point::new(0.0, 0.0), lengths, half_width, vec![FREE; joints], true)
    };
    assert_eq!(arm(vec![1.0], 1, 0.0), Err(ArmError::Links { found: 1 }));
    assert_eq!(arm(vec![1.0; 65], 65, 0.0), Err(ArmError::Links { found: 65 }));
    assert_eq!(arm(vec![1.0; 3], 2, 0.0), Err(ArmError::Joints { found: 2, links: 3 }));
    assert_eq!(
        arm(vec![1.0, 0.1, 1.0], 3, 0.05),
        Err(ArmError::AlwaysTouching { link: 2, length: 0.1, half_width: 0.05 })
    );
    assert!(arm(vec![0.1, 1.0, 0.1], 3, 0.05).is_ok(), "the first and the last have one neighbour");
    assert!(matches!(arm(vec![1.0, -1.0, 1.0], 3, 0.0), Err(ArmError::Length { link: 2, .. })));
}
