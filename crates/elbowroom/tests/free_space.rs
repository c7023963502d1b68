//! The free-space map against a judge that shares no code with it: the cosine rule, plain trigonometry, and
//! distances by another library.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "judge/distance.rs"]
mod distance;

use std::f64::consts::{PI, TAU};

use elbowroom::arm::{Configuration, Joint, JointLimits, MotionLimits, Posture, TwoLinkArm};
use elbowroom::free_space::{CONTACT_FLOOR, CellState, FreeSpace, Reason, configurations, state_of};
use elbowroom::geometry::{Circle, Point, Polygon};
use elbowroom::grid::Grid;
use elbowroom::scene::{Obstacle, Place, Scene, Shape};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn pick(rng: &mut ChaCha8Rng, count: u64) -> u64 {
    rng.next_u64() % count
}

fn circle(x: f64, y: f64, radius: f64) -> Obstacle {
    Obstacle { name: None, shape: Shape::Circle(Circle { center: Point::new(x, y), radius }) }
}

fn random_limits(rng: &mut ChaCha8Rng) -> JointLimits {
    match pick(rng, 5) {
        0 | 1 => JointLimits::Continuous,
        2 => JointLimits::range(0.0, TAU).unwrap(),
        3 => {
            let half = uniform(rng, 0.1, 1.2 * PI);
            JointLimits::range(-half, half).unwrap()
        }
        _ => {
            let min = uniform(rng, -TAU, TAU);
            JointLimits::range(min, min + uniform(rng, 0.0, 1.5 * TAU)).unwrap()
        }
    }
}

/// Round about `center`, convex or not.
fn star(rng: &mut ChaCha8Rng, center: Point, size: f64) -> Obstacle {
    let corners = 3 + pick(rng, 7);
    let turned = uniform(rng, 0.0, TAU);
    let mut vertices: Vec<Point> = (0..corners)
        .map(|i| {
            let angle = turned + TAU * (i as f64 + uniform(rng, 0.0, 0.5)) / corners as f64;
            let radius = size * uniform(rng, 0.2, 1.0);
            Point::new(center.x + radius * angle.cos(), center.y + radius * angle.sin())
        })
        .collect();
    if pick(rng, 2) == 0 {
        vertices.reverse();
    }
    Obstacle { name: None, shape: Shape::Polygon(Polygon::new(vertices).unwrap()) }
}

fn random_scene(rng: &mut ChaCha8Rng) -> Scene {
    let l1 = uniform(rng, 0.1, 0.6);
    let l2 = if pick(rng, 2) == 0 { l1 } else { uniform(rng, 0.1, 0.6) };
    let half_width = if pick(rng, 2) == 0 { 0.0 } else { uniform(rng, 0.0, 0.05) };
    let base = if pick(rng, 2) == 0 {
        Point::new(0.0, 0.0)
    } else {
        Point::new(uniform(rng, -2.0, 2.0), uniform(rng, -2.0, 2.0))
    };
    let joints = [(); 2].map(|()| Joint { limits: random_limits(rng), motion: MotionLimits::default() });
    let arm = TwoLinkArm::new(base, [l1, l2], half_width, joints).unwrap();
    let reach = 1.1 * (l1 + l2);
    let range = |middle: f64| [middle - reach, middle + reach];
    let grid = Grid::new(range(base.x), range(base.y), reach / uniform(rng, 8.0, 16.0)).unwrap();
    let obstacles = (0..pick(rng, 7))
        .map(|_| {
            let center = Point::new(
                base.x + uniform(rng, -1.2, 1.2) * reach,
                base.y + uniform(rng, -1.2, 1.2) * reach,
            );
            let size = reach * 10f64.powf(uniform(rng, -3.0, -0.5));
            if pick(rng, 2) == 0 { circle(center.x, center.y, size) } else { star(rng, center, size) }
        })
        .collect();
    Scene { arm, grid, obstacles, tasks: Vec::new() }
}

/// The judge's answer, or `None` within `doubt` of a decision.
fn judged(scene: &Scene, tip: Point, posture: Posture, doubt: f64) -> Option<CellState> {
    let (base, [l1, l2]) = (scene.arm.base(), scene.arm.lengths());
    let (dx, dy) = (tip.x - base.x, tip.y - base.y);
    let distance = (dx * dx + dy * dy).sqrt();
    let (near, far) = ((l1 - l2).abs(), l1 + l2);
    if (distance - far).abs() < doubt || (distance - near).abs() < doubt {
        return None;
    }
    if distance > far || distance < near {
        return Some(CellState::OutOfReach);
    }
    let bend = ((distance * distance - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)).acos();
    let lean = ((distance * distance + l1 * l1 - l2 * l2) / (2.0 * l1 * distance)).acos();
    // Elbow-up leans left of the ray to the tip and bends back to the right.
    let (q1, q2) = match posture {
        Posture::ElbowUp => (dy.atan2(dx) + lean, -bend),
        Posture::ElbowDown => (dy.atan2(dx) - lean, bend),
    };
    for (j, q) in [q1, q2].into_iter().enumerate() {
        if let JointLimits::Range { min, max } = scene.arm.joints()[j].limits {
            let turns = || (-10..=10).map(|k| q + TAU * f64::from(k));
            if turns().any(|a| (a - min).abs() < doubt || (a - max).abs() < doubt) {
                return None;
            }
            if !turns().any(|a| a > min && a < max) {
                return Some(CellState::JointLimit { joint: j as u8 + 1 });
            }
        }
    }
    let elbow = Point::new(base.x + l1 * q1.cos(), base.y + l1 * q1.sin());
    for (link, (a, b)) in [(base, elbow), (elbow, tip)].into_iter().enumerate() {
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            let clearance =
                distance::distance(obstacle, [a.x, a.y], [b.x, b.y]) - scene.arm.half_width() - CONTACT_FLOOR;
            if clearance.abs() < doubt {
                return None;
            }
            if clearance < 0.0 {
                return Some(CellState::Collision { link: link as u8 + 1, obstacle: index as u16 });
            }
        }
    }
    Some(CellState::Free)
}

#[test]
fn maps_of_a_thousand_random_scenes_equal_the_judge() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut compared, mut doubtful) = (0u64, 0u64);
    let mut seen = std::collections::HashSet::new();
    for _ in 0..1_000 {
        let scene = random_scene(&mut rng);
        let space = FreeSpace::of(&scene);
        for posture in Posture::ALL {
            for (cell, state) in space.map(posture).states().iter().enumerate() {
                let tip = scene.grid.point(cell);
                match judged(&scene, tip, posture, 1e-7) {
                    None => doubtful += 1,
                    Some(expected) => {
                        assert_eq!(*state, expected, "{posture:?} at {tip:?} in {scene:#?}");
                        compared += 1;
                    }
                }
                assert_eq!(*state, state_of(&scene, tip, posture), "{posture:?} at {tip:?} in {scene:#?}");
                seen.insert(std::mem::discriminant(state));
            }
        }
    }
    assert!(compared > 1_000_000 && doubtful * 200 < compared, "{compared} compared, {doubtful} doubtful");
    assert_eq!(seen.len(), 4, "every kind of state came up");
}

/// The 3-4-5 arm of the tangency tests: at the tip (0.3, 0.4) its second link stands upright at x = 0.3.
fn upright(half_width: f64, limits: JointLimits, obstacles: Vec<Obstacle>) -> Scene {
    let joints =
        [JointLimits::Continuous, limits].map(|limits| Joint { limits, motion: MotionLimits::default() });
    let arm = TwoLinkArm::new(Point::new(0.0, 0.0), [0.3, 0.4], half_width, joints).unwrap();
    Scene { arm, grid: Grid::new([-0.8, 0.8], [-0.8, 0.8], 0.1).unwrap(), obstacles, tasks: Vec::new() }
}

#[test]
fn touching_is_collision_and_the_limit_itself_is_allowed() {
    let tip = Point::new(0.3, 0.4);
    let right_angle = JointLimits::range(-PI / 2.0, PI / 2.0).unwrap();
    let hit = CellState::Collision { link: 2, obstacle: 0 };
    for (half_width, radius, expected) in [
        (0.0, 0.1, hit),
        (0.0, 0.1 - 1e-8, CellState::Free),
        (0.02, 0.08, hit),
        (0.02, 0.08 - 1e-8, CellState::Free),
    ] {
        let scene = upright(half_width, right_angle, vec![circle(0.4, 0.2, radius)]);
        assert_eq!(state_of(&scene, tip, Posture::ElbowDown), expected);
        let cell = scene.grid.nearest(tip).unwrap();
        assert_eq!(FreeSpace::of(&scene).map(Posture::ElbowDown).states()[cell], expected);
    }
    let square = |left: f64| {
        let corners = [[left, 0.1], [left + 0.1, 0.1], [left + 0.1, 0.2], [left, 0.2]];
        let polygon = Polygon::new(corners.map(|[x, y]| Point::new(x, y)).to_vec()).unwrap();
        vec![Obstacle { name: None, shape: Shape::Polygon(polygon) }]
    };
    assert_eq!(state_of(&upright(0.0, right_angle, square(0.3)), tip, Posture::ElbowDown), hit);
    let beside = upright(0.0, right_angle, square(0.3 + 1e-8));
    assert_eq!(state_of(&beside, tip, Posture::ElbowDown), CellState::Free);
}

#[test]
fn the_papers_three_cases_add_up() {
    let scene = upright(0.0, JointLimits::Continuous, Vec::new());
    let space = FreeSpace::of(&scene);
    let cases = space.cases(&scene);
    assert_eq!(cases.two + cases.one + cases.none, scene.grid.len());
    // On this grid the reach of 0.7 m is met at the four ends of the axes, the hole of 0.1 m at its four.
    assert_eq!(cases.one, 8);
    let annulus = (0..scene.grid.len())
        .filter(|&cell| {
            let (column, row) = scene.grid.column_row(cell);
            let squared = (column as i64 - 8).pow(2) + (row as i64 - 8).pow(2);
            squared > 1 && squared < 49
        })
        .count();
    assert_eq!(cases.two, annulus);
    let reasons = space.map(Posture::ElbowUp).reasons();
    assert_eq!(reasons.free + reasons.out_of_reach, scene.grid.len());
}

#[test]
fn a_place_that_is_not_free_says_why_and_where_the_arm_could_stand() {
    let named = Obstacle {
        name: Some("post".to_owned()),
        shape: Shape::Circle(Circle { center: Point::new(0.3, 0.3), radius: 0.05 }),
    };
    let scene = upright(0.01, JointLimits::range(0.0, PI).unwrap(), vec![circle(5.0, 5.0, 1.0), named]);
    let refused = configurations(&scene, &Place::Tip(Point::new(0.3, 0.4))).unwrap_err();
    let [(up, limit), (down, contact)] = &refused.reasons[..] else { panic!("{refused:?}") };
    assert_eq!((*up, *down), (Some(Posture::ElbowUp), Some(Posture::ElbowDown)));
    assert!(matches!(limit, Reason::JointLimit { joint: 2, .. }));
    let Reason::Collision { link: 2, obstacle: 1, name: Some(name), depth } = contact else {
        panic!("{contact:?}")
    };
    assert!(name == "post" && (depth - 0.06).abs() < 1e-12);
    let nearest = refused.nearest_free.unwrap();
    let free = |p: Point| configurations(&scene, &Place::Tip(p)).is_ok();
    assert!(free(nearest));
    for cell in 0..scene.grid.len() {
        let p = scene.grid.point(cell);
        assert!(!free(p) || p.distance(Point::new(0.3, 0.4)) >= nearest.distance(Point::new(0.3, 0.4)));
    }
    let text = refused.to_string();
    assert!(text.contains("obstacle 1 (post)") && text.contains("nearest free grid point"), "{text}");

    let far = configurations(&scene, &Place::Tip(Point::new(2.0, 0.0))).unwrap_err();
    assert!(matches!(far.reasons[0].1, Reason::OutOfReach { distance: 2.0, .. }));
    let bent = configurations(&scene, &Place::Configuration(Configuration([0.0, -0.1]))).unwrap_err();
    assert!(matches!(bent.reasons[..], [(None, Reason::JointLimit { joint: 2, .. })]));
    let not_a_number = configurations(&scene, &Place::Configuration(Configuration([f64::NAN, 0.1])));
    assert!(matches!(not_a_number.unwrap_err().reasons[..], [(None, Reason::JointLimit { joint: 1, .. })]));
}

#[test]
fn depth_in_a_polygon_is_that_of_the_innermost_point() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]];
    let polygon = Polygon::new(corners.map(|[x, y]| Point::new(x, y)).to_vec()).unwrap();
    let depth = |a: [f64; 2], b: [f64; 2]| {
        let segment = elbowroom::geometry::Segment::new(Point::new(a[0], a[1]), Point::new(b[0], b[1]));
        -polygon.signed_distance_to_segment(segment)
    };
    assert!((depth([-1.0, 1.0], [5.0, 1.0]) - 1.0).abs() < 1e-5);
    assert!((depth([-1.0, 0.5], [5.0, 0.5]) - 0.5).abs() < 1e-5);
    assert!((depth([-1.0, 1.0], [0.25, 1.0]) - 0.25).abs() < 1e-5);
    assert!((depth([-1.0, 0.0], [5.0, 0.0])).abs() < 1e-5);
    assert!((depth([0.0, 3.0], [4.0, 3.0]) + 1.0).abs() < 1e-12);
}

#[test]
fn a_map_that_is_stopped_is_no_map() {
    let scene = upright(0.0, JointLimits::Continuous, Vec::new());
    assert!(FreeSpace::of_until(&scene, &|| false).is_none());
    assert!(FreeSpace::of_until(&scene, &|| true).is_some());
}
