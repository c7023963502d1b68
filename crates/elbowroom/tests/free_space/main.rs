//! The free-space map against a judge that shares no code with it: the cosine rule, plain trigonometry, and
//! distances by another library.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "../worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "../judge/distance.rs"]
mod distance;
mod known;

use std::f64::consts::{PI, TAU};
use std::sync::atomic::{AtomicUsize, Ordering};

use build::{circle, joint, stops};
use elbowroom::arm::{Arm, Joint, JointLimits, Posture};
use elbowroom::free_space::{CONTACT_FLOOR, CellState, FreeSpace, Reason, configurations, state_of};
use elbowroom::geometry::{Point, Shape, Vector};
use elbowroom::grid::Grid;
use elbowroom::scene::{Obstacle, Place, Scene};
use known::upright;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn pick(rng: &mut ChaCha8Rng, count: u64) -> u64 {
    rng.next_u64() % count
}

fn of_parts(arm: Arm, grid: Grid, obstacles: Vec<Obstacle>) -> Scene {
    Scene::new(arm, grid, obstacles, Vec::new()).unwrap()
}

fn arm(base: Point, lengths: [f64; 2], half_width: f64, joints: [Joint; 2]) -> Arm {
    Arm::new(base, lengths.to_vec(), half_width, joints.to_vec(), false).unwrap()
}

fn map_of(scene: &Scene) -> FreeSpace {
    FreeSpace::of(scene.two_link().unwrap())
}

fn random_limits(rng: &mut ChaCha8Rng) -> JointLimits {
    match pick(rng, 5) {
        0 | 1 => JointLimits::Continuous,
        2 => stops(0.0, TAU),
        3 => {
            let half = uniform(rng, 0.1, 1.2 * PI);
            stops(-half, half)
        }
        _ => {
            let min = uniform(rng, -TAU, TAU);
            stops(min, min + uniform(rng, 0.0, 1.5 * TAU))
        }
    }
}

/// Round about `center`, convex or not, its corners rounded by so much (m).
fn star(rng: &mut ChaCha8Rng, center: Point, size: f64, rounding: f64) -> Obstacle {
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
    Obstacle::still(Shape::rounded_polygon(vertices, rounding).unwrap())
}

/// A wall from `center`, as thin as a line or less so.
fn wall(rng: &mut ChaCha8Rng, center: Point, size: f64) -> Obstacle {
    let to = center + Vector::polar(size * 10f64.powf(uniform(rng, -2.0, 0.5)), uniform(rng, -PI, PI));
    let radius = [0.0, 0.1, 1.0][pick(rng, 3) as usize] * size;
    Obstacle::still(Shape::segment(center, to, radius).unwrap())
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
    let joints = [(); 2].map(|()| joint(random_limits(rng)));
    let arm = arm(base, [l1, l2], half_width, joints);
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
            match pick(rng, 5) {
                0 | 1 => circle(center.x, center.y, size),
                2 => star(rng, center, size, 0.0),
                3 => star(rng, center, size, 0.4 * size),
                _ => wall(rng, center, size),
            }
        })
        .collect();
    of_parts(arm, grid, obstacles)
}

/// The judge's answer, or `None` within `doubt` of a decision.
fn judged(scene: &Scene, tip: Point, posture: Posture, doubt: f64) -> Option<CellState> {
    let (base, [l1, l2]) = (scene.arm().base(), [0, 1].map(|j| scene.arm().lengths()[j]));
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
        if let JointLimits::Range { min, max } = scene.arm().joints()[j].limits {
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
        for (index, obstacle) in scene.obstacles().iter().enumerate() {
            let clearance = distance::distance(obstacle, [a.x, a.y], [b.x, b.y])
                - scene.arm().half_width()
                - CONTACT_FLOOR;
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
        let (two, space) = (scene.two_link().unwrap(), map_of(&scene));
        for posture in Posture::ALL {
            for (cell, state) in space.map(posture).states().enumerate() {
                let tip = scene.grid().point(cell);
                match judged(&scene, tip, posture, 1e-7) {
                    None => doubtful += 1,
                    Some(expected) => {
                        assert_eq!(state, expected, "{posture:?} at {tip:?} in {scene:#?}");
                        compared += 1;
                    }
                }
                assert_eq!(state, state_of(two, tip, posture), "{posture:?} at {tip:?} in {scene:#?}");
                seen.insert(std::mem::discriminant(&state));
            }
        }
    }
    assert!(compared > 1_000_000 && doubtful * 200 < compared, "{compared} compared, {doubtful} doubtful");
    assert_eq!(seen.len(), 4, "every kind of state came up");
}

/// Every state of both maps is that of [`state_of`]; how many of them are free, and how many collide.
fn assert_maps_are_those_of_state_of(scene: &Scene) -> [usize; 2] {
    let (two, space) = (scene.two_link().unwrap(), map_of(scene));
    let mut counts = [0; 2];
    for posture in Posture::ALL {
        let map = space.map(posture);
        assert_eq!(map.states().len(), scene.grid().len());
        for (cell, state) in map.states().enumerate() {
            let tip = scene.grid().point(cell);
            assert_eq!(state, state_of(two, tip, posture), "{posture:?} at {tip:?} in {scene:#?}");
            assert_eq!((map.state(cell), map.is_free(cell)), (Some(state), state == CellState::Free));
            counts[0] += usize::from(state == CellState::Free);
            counts[1] += usize::from(matches!(state, CellState::Collision { .. }));
        }
        assert_eq!((map.state(scene.grid().len()), map.is_free(scene.grid().len())), (None, false));
    }
    counts
}

/// The grid of `scene` with `columns` and `rows`, from one corner of it to the other.
fn with_points(scene: &Scene, [columns, rows]: [u64; 2]) -> Scene {
    let (old, base) = (scene.grid(), scene.arm().base());
    let step = 2.0 * (base.x - old.origin().x) / columns.max(rows) as f64;
    let range = |min: f64, points: u64| [min, min + step * (points - 1) as f64];
    let grid = Grid::new(range(old.origin().x, columns), range(old.origin().y, rows), step).unwrap();
    scene.with_grid(grid)
}

#[test]
fn fine_maps_equal_state_of() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    for _ in 0..40 {
        let scene = random_scene(&mut rng);
        assert_maps_are_those_of_state_of(&with_points(&scene, [129, 120]));
    }
    // Rows and columns that end with, before and after a block of points.
    for _ in 0..300 {
        let scene = random_scene(&mut rng);
        let points = [(); 2].map(|()| 1 + pick(&mut rng, 41));
        assert_maps_are_those_of_state_of(&with_points(&scene, points));
    }
}

/// Everything on whole numbers: edges in line with links, corners and tangents on grid points, limits at right angles.
#[test]
fn maps_on_whole_numbers_equal_state_of() {
    let mut rng = ChaCha8Rng::seed_from_u64(18);
    for round in 0..400 {
        let whole = |rng: &mut ChaCha8Rng| pick(rng, 21) as f64 - 10.0;
        let lengths = [[5.0, 5.0], [3.0, 4.0], [4.0, 3.0], [8.0, 1.0]][pick(&mut rng, 4) as usize];
        let joints = [(); 2].map(|()| {
            let right = |angle: u64| PI / 2.0 * (angle as f64 - 4.0);
            let from = pick(&mut rng, 6);
            let limits = match pick(&mut rng, 3) {
                0 => stops(right(from), right(from + pick(&mut rng, 5))),
                _ => JointLimits::Continuous,
            };
            joint(limits)
        });
        // As far out as what is round may be.
        let offset = [0.0, 0.0, 7.0, 1e6 - 20.0][pick(&mut rng, 4) as usize];
        let half_width = [0.0, 1.0][pick(&mut rng, 2) as usize];
        let arm = arm(Point::new(offset, -offset), lengths, half_width, joints);
        // Half of the obstacles are the floor of contact away from tangents and from lines of the grid.
        let floor = [0.0, CONTACT_FLOOR][pick(&mut rng, 2) as usize];
        let at = |x: f64, y: f64| Point::new(x + offset + floor, y - offset);
        let obstacles = (0..pick(&mut rng, 5))
            .map(|_| {
                let (x, y) = (whole(&mut rng), whole(&mut rng));
                if pick(&mut rng, 2) == 0 {
                    let radius = [1.0, 2.0, 0.5, 30.0][pick(&mut rng, 4) as usize];
                    return circle(x + offset, y - offset, radius - floor);
                }
                let (w, h) = (1.0 + pick(&mut rng, 6) as f64, 1.0 + pick(&mut rng, 6) as f64);
                if pick(&mut rng, 3) == 0 {
                    // Level, upright or slanting, as thin as a line or as thick as a link.
                    let (w, h) = [(w, 0.0), (0.0, h), (w, h), (w, -h)][pick(&mut rng, 4) as usize];
                    let radius = [0.0, 1.0 - floor][pick(&mut rng, 2) as usize];
                    return Obstacle::still(Shape::segment(at(x, y), at(x + w, y + h), radius).unwrap());
                }
                let corners = match pick(&mut rng, 4) {
                    // A box with a vertex in the middle of each of two edges; a wedge; a room around the arm, open
                    // to one side; a box around all of it.
                    0 => {
                        vec![at(x, y), at(x + w, y), at(x + 2.0 * w, y), at(x + 2.0 * w, y + h), at(x, y + h)]
                    }
                    1 => vec![at(x, y), at(x + w, y + h), at(x, y + h)],
                    2 => [[-7, 6], [-7, -6], [7, -6], [7, -5], [-6, -5], [-6, 6]]
                        .map(|[x, y]| at(f64::from(x), f64::from(y)))
                        .to_vec(),
                    _ => vec![at(-30.0, -30.0), at(30.0, -30.0), at(30.0, 30.0), at(-30.0, 30.0)],
                };
                Obstacle::still(Shape::polygon(corners).unwrap())
            })
            .collect();
        let range = |middle: f64| [middle - 10.0, middle + 10.0];
        let step = if round % 4 == 0 { 0.25 } else { 1.0 };
        let grid = Grid::new(range(offset), range(-offset), step).unwrap();
        assert_maps_are_those_of_state_of(&of_parts(arm, grid, obstacles));
    }
}

/// Steps down to a billionth of the reach about its ends, where the elbow moves with the root of the tip's way, and
/// obstacles that the links just touch there.
#[test]
fn maps_at_the_ends_of_the_reach_equal_state_of() {
    let mut rng = ChaCha8Rng::seed_from_u64(20);
    for _ in 0..1_000 {
        let scene = random_scene(&mut rng);
        let (base, [nearest, farthest]) = (scene.arm().base(), scene.arm().reach());
        let step = farthest * 10f64.powf(uniform(&mut rng, -9.0, -2.0));
        let end = if pick(&mut rng, 2) == 0 { nearest } else { farthest };
        let along = Vector::polar(1.0, uniform(&mut rng, -PI, PI));
        let radius = uniform(&mut rng, 0.01, 0.2);
        // A line of stretched or folded links runs past this circle, as near as the floor of contact.
        let beside = radius + scene.arm().half_width() + CONTACT_FLOOR + step * uniform(&mut rng, -2.0, 2.0);
        let center = base + along * uniform(&mut rng, 0.0, end) + Vector::new(-along.y, along.x) * beside;
        let corner = base + along * end + Vector::new(-8.0 * step, -8.0 * step);
        let range = |min: f64| [min, min + 16.0 * step];
        let grid = Grid::new(range(corner.x), range(corner.y), step).unwrap();
        let obstacles = vec![circle(center.x, center.y, radius)];
        assert_maps_are_those_of_state_of(&of_parts(scene.arm().clone(), grid, obstacles));
    }
}

#[test]
fn maps_among_thousands_of_obstacles_equal_state_of() {
    let mut rng = ChaCha8Rng::seed_from_u64(19);
    // A byte a point is enough for 126 obstacles; 3,000 need more.
    for (count, size) in [(126, 0.01), (127, 0.01), (3_000, 0.001)] {
        let obstacles = (0..count).map(|_| {
            let (x, y) = (uniform(&mut rng, -0.7, 0.7), uniform(&mut rng, -0.7, 0.7));
            if pick(&mut rng, 3) == 0 {
                star(&mut rng, Point::new(x, y), size, 0.0)
            } else {
                circle(x, y, size)
            }
        });
        // The last one is in the way as well.
        let obstacles = obstacles.chain([circle(0.0, -0.3, 0.05)]).skip(1).collect();
        let scene = upright(0.0, JointLimits::Continuous, obstacles);
        let scene = scene.with_grid(build::grid(0.8, 0.02));
        let [free, colliding] = assert_maps_are_those_of_state_of(&scene);
        assert!(free > 0 && colliding > 0, "{count} obstacles: {free} free, {colliding} collide");
        let last = CellState::Collision { link: 1, obstacle: count as u16 - 1 };
        assert!(map_of(&scene).map(Posture::ElbowUp).states().any(|state| state == last));
    }
}

/// The longest and the shortest arms, far and huge obstacles, vertices and grids at the end of the numbers.
#[test]
fn maps_at_the_ends_of_the_numbers_equal_state_of() {
    let (mut shapes, mut refused) = (0, 0);
    for (lengths, base) in [
        ([1e6, 1e6], 0.0),
        ([1e6, 1e-6], 0.0),
        ([1e-6, 1e-6], 0.0),
        ([1e-6, 1e-6], 1e6),
        ([0.5, 0.4], 1e6),
        // A circle's centre may be as far out, and no farther.
        ([1e-6, 1e-6], 1e6 - 1.0),
        ([0.5, 0.4], 1e6 - 1.0),
    ] {
        let size = lengths[0] + lengths[1];
        let at = |x: f64, y: f64| Point::new(base + size * x, base + size * y);
        let polygon = |corners: [[f64; 2]; 4]| Shape::polygon(corners.map(|[x, y]| at(x, y)).to_vec());
        let tip = at(0.3, 0.45);
        let (huge, tiny) = (1e300 / size, 1e-200);
        for shape in [
            Shape::circle(tip, 0.1 * size),
            Shape::circle(tip, 1e6),
            Shape::circle(Point::new(1e6, 1e6), 1e6),
            Shape::segment(tip, at(0.8, 0.1), 0.0),
            Shape::segment(tip, Point::new(tip.x, tip.y.next_up()), 0.0),
            Shape::segment(tip, Point::new(-1e6, 1e6), 0.1 * size),
            polygon([[0.1, 0.3], [0.8, 0.3], [0.8, 0.4], [0.1, 0.4]]),
            polygon([[0.1, 0.3], [huge, 0.3], [huge, huge], [0.1, huge]]),
            Shape::polygon([[0.0, 0.0], [tiny, 0.0], [0.0, -size]].map(|[x, y]| Point::new(x, y)).to_vec()),
        ] {
            let Ok(shape) = shape else {
                refused += 1;
                continue;
            };
            shapes += 1;
            let arm = arm(Point::new(base, base), lengths, 0.0, [Joint::CONTINUOUS; 2]);
            let range = [base - 1.1 * size, base + 1.1 * size];
            for grid in [Grid::new(range, range, size / 20.0), Grid::new([-1e300, 1e300], [-1.0, 1.0], 1e299)]
            {
                let obstacles = vec![Obstacle::still(shape.clone())];
                let scene = Scene::new(arm.clone(), grid.unwrap(), obstacles, Vec::new());
                assert_maps_are_those_of_state_of(&scene.unwrap());
            }
        }
    }
    // Two tips are too far out for what is round, and once the end of a segment is.
    assert_eq!((shapes, refused), (7 * 9 - 11, 2 * 5 + 1));
}
