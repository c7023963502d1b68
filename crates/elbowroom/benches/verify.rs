//! The verdict on a motion like the paper's: six quintic pieces, an arm of 0.25 m + 0.25 m, five circles.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use elbowroom::arm::{Arm, Joint};
use elbowroom::geometry::{Point, Shape};
use elbowroom::grid::Grid;
use elbowroom::scene::{Obstacle, Scene};
use elbowroom::trajectory::{Motion, durations_by_length, quintic_through, vias_at};
use elbowroom::verify::{VerifySettings, verify};

fn scene() -> Scene {
    let arm = Arm::new(Point::new(0.0, 0.0), vec![0.25; 2], 0.0, vec![Joint::CONTINUOUS; 2], false);
    let centers = [[0.45, 0.05], [-0.45, 0.1], [0.05, -0.2], [0.2, 0.45], [-0.2, -0.3]];
    let obstacles = centers
        .map(|[x, y]| Obstacle::still(Shape::circle(Point::new(x, y), 0.05).expect("a circle")))
        .to_vec();
    let grid = Grid::new([-0.5, 0.5], [-0.5, 0.5], 0.01).expect("a grid");
    Scene::new(arm.expect("an arm"), grid, obstacles, Vec::new()).expect("a scene")
}

fn motion() -> Motion {
    let places: Vec<[f64; 2]> =
        (0..=6).map(|i| [0.3 + 0.4 * f64::from(i), 1.6 + 0.3 * f64::from(i % 3)]).collect();
    let vias = vias_at(&places);
    Motion::new(quintic_through(&vias, &durations_by_length(&vias, 6.0))).expect("a motion")
}

fn verify_paper_like(criterion: &mut Criterion) {
    let (scene, motion, settings) = (scene(), motion(), VerifySettings::default());
    let verdict = verify(&scene, &motion, &settings);
    assert!(verdict.is_safe(), "{verdict:?}");
    criterion.bench_function("verify/six pieces, five circles", |bencher| {
        bencher.iter(|| verify(black_box(&scene), black_box(&motion), &settings));
    });
    let empty = scene.with_obstacles(Vec::new()).expect("a scene");
    criterion.bench_function("verify/six pieces, no obstacle", |bencher| {
        bencher.iter(|| verify(black_box(&empty), black_box(&motion), &settings));
    });
}

criterion_group!(benches, verify_paper_like);
criterion_main!(benches);
