//! From a scene to a motion: the paper's way on its stand-in scene, and posture-true with the verifier, there and without
//! obstacles.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use elbowroom::planners::{DstarPlanner, DstarPsoPlanner, Method, PaperSettings, plan_as_in_paper};
use elbowroom::planning::{PlanSettings, Planner, Unwatched, plan};
use elbowroom::scene::parse;
use elbowroom::swarm::GuidedSwarmSettings;

const SCENE: &str = include_str!("../../../python/elbowroom/scenes/paper-standin.yaml");
const EMPTY: &str = include_str!("../../../python/elbowroom/scenes/paper-empty.yaml");

fn pipeline(c: &mut Criterion) {
    let scene = parse(SCENE, "paper-standin.yaml").expect("the scene is sound").scene;
    let swarm = Method::DstarPso(GuidedSwarmSettings::default());
    let mut group = c.benchmark_group("pipeline");
    group.sample_size(20);
    for (task, optimum) in scene.tasks().iter().zip([0.953_553, 0.812_132]) {
        for (name, method) in [("dstar", Method::Dstar), ("dstar-pso", swarm)] {
            let settings = PaperSettings { method, ..PaperSettings::default() };
            let found = plan_as_in_paper(&scene, task, &settings, &Unwatched).expect("there is a path");
            assert!((found.cost - optimum).abs() < 1e-6, "{}", found.cost);
            group.bench_function(BenchmarkId::new(format!("paper, {name}"), &task.name), |b| {
                b.iter(|| plan_as_in_paper(black_box(&scene), task, &settings, &Unwatched));
            });
            let planner: Box<dyn Planner> = match method {
                Method::Dstar => Box::new(DstarPlanner),
                Method::DstarPso(swarm) => Box::new(DstarPsoPlanner { swarm }),
            };
            let settings = PlanSettings::default();
            let found = plan(&scene, task, &*planner, &settings, &Unwatched).expect("there is a path");
            assert!((found.record().path_cost - optimum).abs() < 1e-6, "{}", found.record().path_cost);
            group.bench_function(BenchmarkId::new(format!("verified, {name}"), &task.name), |b| {
                b.iter(|| plan(black_box(&scene), task, &*planner, &settings, &Unwatched));
            });
        }
    }
    group.finish();
}

fn without_obstacles(c: &mut Criterion) {
    let scene = parse(EMPTY, "paper-empty.yaml").expect("the scene is sound").scene;
    let (planner, settings) = (DstarPsoPlanner::default(), PlanSettings::default());
    let mut group = c.benchmark_group("pipeline");
    group.sample_size(20);
    for (task, optimum) in scene.tasks().iter().zip([1.244_680, 0.861_838]) {
        let found = plan(&scene, task, &planner, &settings, &Unwatched).expect("there is a path");
        assert!((found.record().path_cost - optimum).abs() < 1e-6, "{}", found.record().path_cost);
        group.bench_function(BenchmarkId::new("verified without obstacles, dstar-pso", &task.name), |b| {
            b.iter(|| plan(black_box(&scene), task, &planner, &settings, &Unwatched));
        });
    }
    group.finish();
}

criterion_group!(benches, pipeline, without_obstacles);
criterion_main!(benches);
