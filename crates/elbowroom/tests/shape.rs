//! Shapes: their distances by another library, and what must be the same of different ways to say one thing.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;

use std::f64::consts::{PI, TAU};

use build::{circle, segment};
use elbowroom::arm::{Joint, Posture};
use elbowroom::free_space::{FreeSpace, Slices};
use elbowroom::geometry::{Point, Segment, Shape, Vector};
use elbowroom::path::straight_move_is_free;
use elbowroom::scene::{Obstacle, Scene};
use elbowroom::trajectory::{Motion, quintic_through, vias_at};
use elbowroom::verify::{VerifySettings, verify};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn within(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn pick(rng: &mut ChaCha8Rng, count: u64) -> u64 {
    rng.next_u64() % count
}

/// Anywhere, or on whole numbers, where much is in line and ends touch.
fn place(rng: &mut ChaCha8Rng, whole: bool) -> Point {
    let [x, y] = [(); 2].map(|()| within(rng, -4.0, 4.0));
    if whole { Point::new(x.round(), y.round()) } else { Point::new(x, y) }
}

fn random_shape(rng: &mut ChaCha8Rng, whole: bool) -> Option<Shape> {
    let radius = [0.0, 1e-9, 0.1, 1.0][pick(rng, 4) as usize];
    let at = place(rng, whole);
    match pick(rng, 4) {
        0 => Shape::circle(at, radius).ok(),
        1 => Shape::segment(at, place(rng, whole), radius).ok(),
        // So short that the square of its length is no number any more, or nearly.
        2 => {
            let length = 10f64.powf(within(rng, -320.0, -8.0));
            Shape::segment(Point::new(0.0, 0.0), Point::new(length, -length), radius).ok()
        }
        _ => {
            let corners = (0..3 + pick(rng, 4)).map(|_| place(rng, whole)).collect();
            Shape::rounded_polygon(corners, radius).ok()
        }
    }
}

fn pair(p: Point) -> [f64; 2] {
    [p.x, p.y]
}

#[test]
fn distances_are_those_of_another_library() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let (mut apart, mut in_contact, mut lines) = (0, 0, 0);
    for round in 0..40_000 {
        let whole = round % 2 == 0;
        let Some(shape) = random_shape(&mut rng, whole) else { continue };
        let link = Segment::new(place(&mut rng, whole), place(&mut rng, whole));
        if link.a == link.b {
            continue;
        }
        let judged = distance::distance(&Obstacle::still(shape.clone()), pair(link.a), pair(link.b));
        let [found, signed] = [shape.distance_to_segment(link), shape.signed_distance_to_segment(link)];
        if judged > 1e-12 {
            assert!((found - judged).abs() < 1e-12, "{shape:?} {link:?}: {found} and {judged}");
            assert_eq!(found, signed, "{shape:?} {link:?}");
            apart += 1;
            lines += usize::from(shape.vertices().len() == 2);
        } else if judged < -1e-12 {
            assert!(found <= 0.0 && signed <= found, "{shape:?} {link:?}: {found}, {signed}");
            in_contact += 1;
        }
        let (center, radius) = shape.bounding_circle();
        assert!(shape.vertices().iter().all(|v| v.distance(center) + shape.radius() <= radius + 1e-12));
        let by = Vector::new(within(&mut rng, -3.0, 3.0), 2.0);
        let moved = shape.shifted(by).distance_to_segment(Segment::new(link.a + by, link.b + by));
        assert!((moved - found).abs() < 1e-12 || found.min(moved) <= 0.0, "{shape:?}: {moved} and {found}");
    }
    assert!(apart > 10_000 && in_contact > 5_000 && lines > 4_000, "{apart} {in_contact} {lines}");
}

/// How deep the innermost of many places of the link lies in a shape, if its core is convex.
fn depth_by_looks(shape: &Shape, link: Segment) -> f64 {
    let core = shape.vertices();
    let depth = |p: Point| {
        let to_line = |a: Point, b: Point| Segment::new(a, b).distance_to_point(p);
        let edges = || (0..core.len()).map(|i| (core[i], core[(i + 1) % core.len()]));
        let sides: Vec<f64> = edges().map(|(a, b)| (b - a).cross(p - a)).collect();
        let is_inside = core.len() > 2
            && (sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0));
        let to_core = edges().map(|(a, b)| to_line(a, b)).fold(f64::INFINITY, f64::min);
        shape.radius() + if is_inside { to_core } else { -to_core }
    };
    (0..=2_000).map(|i| depth(link.a.lerp(link.b, f64::from(i) / 2_000.0))).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn depth_is_that_of_the_innermost_place() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let (mut lines, mut triangles) = (0, 0);
    while lines < 300 || triangles < 300 {
        let [a, b, c] = [(); 3].map(|()| place(&mut rng, false));
        let radius = within(&mut rng, 0.0, 1.0);
        let made = if lines < 300 {
            Shape::segment(a, b, radius)
        } else {
            Shape::rounded_polygon(vec![a, b, c], radius)
        };
        let Ok(shape) = made else { continue };
        let link = Segment::new(place(&mut rng, false), place(&mut rng, false));
        let found = shape.signed_distance_to_segment(link);
        if found > 0.0 {
            continue;
        }
        let looked = depth_by_looks(&shape, link);
        // Two looks are at most 6 mm apart.
        assert!(-found >= looked - 1e-5 && -found <= looked + 3e-3, "{shape:?} {link:?}: {found}, {looked}");
        *(if shape.has_inside() { &mut triangles } else { &mut lines }) += 1;
    }
}

fn of_two(half_width: f64, obstacles: Vec<Obstacle>) -> Scene {
    let arm = build::arm_of(&[0.9, 0.7], half_width, &[Joint::CONTINUOUS; 2]);
    Scene::new(arm, build::grid(1.6, 0.02), obstacles, Vec::new()).unwrap()
}

/// What is free of both maps.
fn free(scene: &Scene) -> Vec<bool> {
    let space = FreeSpace::of(scene.two_link().unwrap());
    Posture::ALL.iter().flat_map(|&posture| space.map(posture).states().map(|s| s.is_free())).collect()
}

fn swing(rng: &mut ChaCha8Rng) -> [[f64; 2]; 2] {
    [(); 2].map(|()| [(); 2].map(|()| within(rng, -PI, PI)))
}

fn is_safe(scene: &Scene, [from, to]: [[f64; 2]; 2]) -> bool {
    let motion = Motion::new(quintic_through(&vias_at(&[from, to]), &[4.0])).unwrap();
    verify(scene, &motion, &VerifySettings::default()).is_safe()
}

#[test]
fn a_capsule_of_hardly_any_length_is_a_circle() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for length in [1e-15, 1e-160, 1e-200, 5e-324] {
        for round in 0..12 {
            let half_width = [0.0, 0.02][round % 2];
            let [x, y] = [(); 2].map(|()| within(&mut rng, -1.2, 1.2));
            let radius = within(&mut rng, 0.05, 0.3);
            // Lengths that small are none but at the origin: the arm stands elsewhere.
            let short = |scene: &Scene| {
                let wall = Shape::segment(Point::new(0.0, 0.0), Point::new(0.0, length), radius).unwrap();
                let base = Point::new(-x, -y);
                let arm = scene.arm();
                let joints = arm.joints().to_vec();
                let moved = elbowroom::Arm::new(base, arm.lengths().to_vec(), half_width, joints, false);
                let grid = elbowroom::grid::Grid::new([-x - 1.6, -x + 1.6], [-y - 1.6, -y + 1.6], 0.02);
                Scene::new(moved.unwrap(), grid.unwrap(), vec![Obstacle::still(wall)], Vec::new()).unwrap()
            };
            let disc = of_two(half_width, vec![circle(x, y, radius)]);
            let wall = short(&disc);
            let differ = free(&disc).iter().zip(free(&wall)).filter(|(disc, wall)| **disc != *wall).count();
            assert!(differ < 4, "{length} {round}: {differ} places");
            let slices = [&disc, &wall].map(|scene| Slices::new(scene.two_link().unwrap(), 0.0));
            for _ in 0..50 {
                let q1 = within(&mut rng, -PI, PI);
                let found = [0, 1].map(|i| slices[i].second_joint(q1, [-PI, PI]));
                assert_eq!(found[0].len(), found[1].len(), "{found:?}");
                for (a, b) in found[0].iter().zip(&found[1]) {
                    assert!((0..2).all(|end| (a[end] - b[end]).abs() < 1e-6), "{found:?}");
                }
                let ends = swing(&mut rng);
                let moves = [&disc, &wall].map(|scene| straight_move_is_free(scene, &ends[0], &ends[1]));
                assert_eq!(moves[0], moves[1], "{length} {ends:?}");
                assert_eq!(is_safe(&disc, ends), is_safe(&wall, ends), "{length} {ends:?}");
            }
        }
    }
}

#[test]
fn from_outside_a_polygon_is_the_walls_around_it() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let (mut is_free, mut in_contact, mut moves) = (0, 0, [0; 2]);
    for round in 0..60 {
        let corners = 3 + pick(&mut rng, 5);
        let (way, angle) = (within(&mut rng, 0.3, 1.3), within(&mut rng, -PI, PI));
        let corner = |i: u64, size: f64| {
            let turn = TAU * i as f64 / corners as f64;
            [way * angle.cos() + size * turn.cos(), way * angle.sin() + size * turn.sin()]
        };
        let star: Vec<[f64; 2]> = (0..corners).map(|i| corner(i, within(&mut rng, 0.05, 0.29))).collect();
        let rounding = [0.0, 0.0, 0.05][round % 3];
        let walls: Vec<Obstacle> =
            (0..star.len()).map(|i| segment([star[i], star[(i + 1) % star.len()]], rounding)).collect();
        let half_width = [0.0, 0.01][round % 2];
        let whole = of_two(half_width, vec![build::rounded(&star, rounding)]);
        let walls = of_two(half_width, walls);
        let [by_polygon, by_walls] = [free(&whole), free(&walls)];
        assert_eq!(by_polygon, by_walls, "{star:?}");
        is_free += by_polygon.iter().filter(|free| **free).count();
        in_contact += by_polygon.iter().filter(|free| !**free).count();
        for _ in 0..20 {
            let ends = swing(&mut rng);
            let free = straight_move_is_free(&whole, &ends[0], &ends[1]);
            assert_eq!(free, straight_move_is_free(&walls, &ends[0], &ends[1]), "{star:?} {ends:?}");
            assert_eq!(is_safe(&whole, ends), is_safe(&walls, ends), "{star:?} {ends:?}");
            moves[usize::from(free)] += 1;
        }
    }
    assert!(is_free > 100_000 && in_contact > 100_000, "{is_free} {in_contact}");
    assert!(moves.iter().all(|count| *count > 100), "{moves:?}");
}
