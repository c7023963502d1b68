//! From a scene to a motion on the paper's stand-in scene: the paper's way, and posture-true with the verifier.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use elbowroom::planners::{Method, PaperSettings, PlanSettings, Planner, Unwatched, plan, plan_as_in_paper};
use elbowroom::scene::parse;
use elbowroom::swarm::GuidedSwarmSettings;

const SCENE: &str = include_str!("../../../python/elbowroom/scenes/paper-standin.yaml");

fn pipeline(c: &mut Criterion) {
    let scene = parse(SCENE, "paper-standin.yaml").expect("the scene is sound").scene;
    let swarm = Method::DstarPso(GuidedSwarmSettings::default());
    let mut group = c.benchmark_group("pipeline");
    group.sample_size(20);
    for (task, optimum) in scene.tasks.iter().zip([0.953_553, 0.812_132]) {
        for (name, method) in [("dstar", Method::Dstar), ("dstar-pso", swarm)] {
            let settings = PaperSettings { method, ..PaperSettings::default() };
            let found = plan_as_in_paper(&scene, task, &settings, &Unwatched).expect("there is a path");
            assert!((found.cost - optimum).abs() < 1e-6, "{}", found.cost);
            group.bench_function(BenchmarkId::new(format!("paper, {name}"), &task.name), |b| {
                b.iter(|| plan_as_in_paper(black_box(&scene), task, &settings, &Unwatched));
            });
            let planner = match method {
                Method::Dstar => Planner::Dstar,
                Method::DstarPso(swarm) => Planner::DstarPso(swarm),
            };
            let settings = PlanSettings { planner, ..PlanSettings::default() };
            let found = plan(&scene, task, &settings, &Unwatched).expect("there is a path");
            assert!((found.path_cost - optimum).abs() < 1e-6, "{}", found.path_cost);
            group.bench_function(BenchmarkId::new(format!("verified, {name}"), &task.name), |b| {
                b.iter(|| plan(black_box(&scene), task, &settings, &Unwatched));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, pipeline);
criterion_main!(benches);
