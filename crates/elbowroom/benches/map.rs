//! The free-space maps of both postures: 1001 x 1001 points and twelve circles, or eight circles and four polygons;
//! and the size of the paper.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use elbowroom::arm::{Arm, Joint, JointLimits, Posture};
use elbowroom::free_space::{FreeSpace, state_of};
use elbowroom::geometry::{Point, Shape};
use elbowroom::grid::Grid;
use elbowroom::scene::{Obstacle, Scene};

fn grid(points: usize) -> Grid {
    Grid::new([-0.5, 0.5], [-0.5, 0.5], 1.0 / (points - 1) as f64).expect("the grid is small")
}

/// The paper's arm among `count` circles on two rings.
fn circles(points: usize, count: usize) -> Scene {
    let limits = JointLimits::range(-2.6, 2.6).expect("the range is in order");
    let joints = vec![Joint::CONTINUOUS, Joint { limits, ..Joint::CONTINUOUS }];
    let arm = Arm::new(Point::new(0.0, 0.0), vec![0.25; 2], 0.0, joints, false);
    let obstacles = (0..count)
        .map(|i| {
            let angle = TAU * i as f64 / count as f64;
            let distance = if i % 2 == 0 { 0.42 } else { 0.3 };
            let center = Point::new(distance * angle.cos(), distance * angle.sin());
            Obstacle::still(Shape::circle(center, 0.03).expect("a circle"))
        })
        .collect();
    let arm = arm.expect("the measures are sound");
    Scene::new(arm, grid(points), obstacles, Vec::new()).expect("the parts are sound")
}

/// `scenes/narrow.yaml` on a finer grid.
fn narrow(points: usize) -> Scene {
    let text = include_str!("../../../python/elbowroom/scenes/narrow.yaml");
    let file = elbowroom::scene::parse(text, "narrow.yaml").expect("the scene is sound");
    file.scene.with_grid(grid(points))
}

fn maps(c: &mut Criterion) {
    let mut group = c.benchmark_group("map");
    group.sample_size(20);
    for (name, scene) in [
        ("101 x 101, 5 circles", circles(101, 5)),
        ("1001 x 1001, 12 circles", circles(1001, 12)),
        ("1001 x 1001, 8 circles and 4 polygons", narrow(1001)),
    ] {
        let scene = scene.two_link().expect("two links");
        let space = FreeSpace::of(scene);
        for posture in Posture::ALL {
            for (cell, state) in space.map(posture).states().enumerate().step_by(97) {
                assert_eq!(state, state_of(scene, scene.grid().point(cell), posture));
            }
        }
        group.throughput(Throughput::Elements(2 * scene.grid().len() as u64));
        group.bench_with_input(BenchmarkId::new("fill", name), &scene, |b, &scene| {
            b.iter(|| FreeSpace::of(black_box(scene)));
        });
    }
    group.finish();
}

criterion_group!(benches, maps);
criterion_main!(benches);
