//! Seeded random worlds: thin posts, walls, slots, polygons, every third time with all of them round; links of all kinds; tasks between free places.

use std::f64::consts::{PI, TAU};

use elbowroom::arm::{Joint, JointLimits, MotionLimits};
use elbowroom::geometry::{Point, Shape};
use elbowroom::scene::{Obstacle, Place, Scene, Task, TaskPosture};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use crate::{build, judge};

/// Numbers of one world.
pub(crate) struct Numbers(ChaCha8Rng);

impl Numbers {
    pub(crate) fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }

    fn flip(&mut self) -> bool {
        self.below(2) == 0
    }
}

/// A bar from `a` to `b`, `thick` wide.
pub(crate) fn bar(a: [f64; 2], b: [f64; 2], thick: f64) -> Option<Obstacle> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    let (nx, ny) = (-dy / length * thick / 2.0, dx / length * thick / 2.0);
    let corners = vec![
        Point::new(a[0] + nx, a[1] + ny),
        Point::new(b[0] + nx, b[1] + ny),
        Point::new(b[0] - nx, b[1] - ny),
        Point::new(a[0] - nx, a[1] - ny),
    ];
    Some(Obstacle::still(Shape::polygon(corners).ok()?))
}

/// What [`bar`] is with round ends; every other one has no thickness at all.
fn round_bar(a: [f64; 2], b: [f64; 2], thick: f64, before: usize) -> Option<Obstacle> {
    let [from, to] = [a, b].map(|[x, y]| Point::new(x, y));
    Some(Obstacle::still(
        Shape::segment(from, to, if before.is_multiple_of(2) { 0.0 } else { thick / 2.0 }).ok()?,
    ))
}

/// Its corners rounded by so much (m).
fn star(numbers: &mut Numbers, center: [f64; 2], size: f64, rounding: f64) -> Option<Obstacle> {
    let corners = 3 + numbers.below(6);
    let turned = numbers.within(0.0, TAU);
    let vertices = (0..corners)
        .map(|i| {
            let angle = turned + TAU * (i as f64 + numbers.within(0.0, 0.5)) / corners as f64;
            let radius = size * numbers.within(0.2, 1.0);
            Point::new(center[0] + radius * angle.cos(), center[1] + radius * angle.sin())
        })
        .collect();
    Some(Obstacle::still(Shape::rounded_polygon(vertices, rounding).ok()?))
}

/// Round or with sharp corners: the same numbers are drawn.
fn obstacles(numbers: &mut Numbers, reach: f64, round: bool) -> Vec<Obstacle> {
    let bar = |a, b, thick, before| if round { round_bar(a, b, thick, before) } else { bar(a, b, thick) };
    let at = |numbers: &mut Numbers, nearest: f64| {
        let (distance, angle) = (reach * numbers.within(nearest, 1.1), numbers.within(-PI, PI));
        [distance * angle.cos(), distance * angle.sin()]
    };
    let mut found = Vec::new();
    for _ in 0..numbers.below(7) {
        let center = at(numbers, 0.15);
        match numbers.below(5) {
            // A post as thin as 0.1 mm across.
            0 => found.push(build::circle(center[0], center[1], 10f64.powf(numbers.within(-4.3, -2.0)))),
            1 => found.push(build::circle(center[0], center[1], reach * numbers.within(0.02, 0.15))),
            2 => {
                let to = at(numbers, 0.15);
                let thick = 10f64.powf(numbers.within(-4.0, -1.5));
                found.extend(bar(center, to, thick, found.len()));
            }
            3 => {
                // A slot: two bars in line with a gap between them.
                let angle = numbers.within(-PI, PI);
                let (gap, arm) = (numbers.within(0.002, 0.06), numbers.within(0.05, 0.3));
                let (c, s) = (angle.cos(), angle.sin());
                for side in [-1.0, 1.0] {
                    let from = [center[0] + side * gap * c, center[1] + side * gap * s];
                    let to = [center[0] + side * (gap + arm) * c, center[1] + side * (gap + arm) * s];
                    found.extend(bar(from, to, 0.004, found.len()));
                }
            }
            _ => {
                let size = reach * numbers.within(0.02, 0.2);
                found.extend(star(numbers, center, size, if round { 0.3 * size } else { 0.0 }));
            }
        }
    }
    found
}

fn limits(numbers: &mut Numbers, first: bool) -> JointLimits {
    let range = |min: f64, max: f64| JointLimits::Range { min, max };
    match numbers.below(4) {
        0 | 1 if first => JointLimits::Continuous,
        0 => JointLimits::Continuous,
        1 => {
            let half = numbers.within(0.5, PI);
            range(-half, half)
        }
        2 if first => range(0.0, TAU),
        2 => range(-2.6, 2.6),
        _ => {
            let min = numbers.within(-1.5 * PI, 0.0);
            range(min, min + numbers.within(1.0, 1.3 * TAU))
        }
    }
}

/// World number `seed`, with one task called `task` if two free places were found.
pub(crate) fn world(seed: u64) -> Option<Scene> {
    let mut numbers = Numbers::seeded(seed);
    let l1 = numbers.within(0.1, 0.5);
    let l2 = if numbers.flip() { l1 } else { numbers.within(0.1, 0.5) };
    let half_width = if numbers.flip() { 0.0 } else { numbers.within(0.0, 0.02) };
    let motion = if numbers.flip() {
        MotionLimits::default()
    } else {
        MotionLimits {
            velocity: Some(numbers.within(0.5, 5.0)),
            acceleration: Some(numbers.within(1.0, 20.0)),
            jerk: Some(numbers.within(5.0, 200.0)),
        }
    };
    let joints =
        [limits(&mut numbers, true), limits(&mut numbers, false)].map(|limits| Joint { limits, motion });
    let arm = build::arm_of(&[l1, l2], half_width, &joints);
    let reach = l1 + l2;
    let side = numbers.within(16.0, 50.0);
    let grid = build::grid(reach, 2.0 * reach / side);
    let obstacles = obstacles(&mut numbers, reach, seed % 3 == 2);
    let scene = Scene::new(arm, grid, obstacles, Vec::new()).ok()?;
    let mut ends = Vec::new();
    for _ in 0..200 {
        let q: [f64; 2] = std::array::from_fn(|j| match scene.arm().joints()[j].limits {
            JointLimits::Continuous => numbers.within(-PI, PI),
            JointLimits::Range { min, max } => numbers.within(min, max),
        });
        if judge::clearance(&scene, q) > 1e-6 {
            ends.push(if numbers.flip() {
                Place::Configuration(q.into())
            } else {
                let [_, _, tip] = judge::skeleton(&scene, q);
                Place::Tip(Point::new(tip[0], tip[1]))
            });
        }
        if ends.len() == 2 {
            break;
        }
    }
    let posture = match numbers.below(8) {
        0 => TaskPosture::Up,
        1 => TaskPosture::Down,
        2 => TaskPosture::Keep,
        _ => TaskPosture::Any,
    };
    let [start, goal] = <[Place; 2]>::try_from(ends).ok()?;
    scene.with_tasks(vec![Task { name: "task".to_owned(), start, goal, posture, clearance: 0.0 }]).ok()
}
