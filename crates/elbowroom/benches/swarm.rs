//! The plain swarm on the sphere: particles moved and evaluated per second.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use elbowroom::swarm::{Bounds, Neighbourhood, Swarm, SwarmSettings, minimise};

const PARTICLES: usize = 50;
const STEPS: usize = 100;

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn run(swarm: &mut Swarm, steps: usize) {
    for _ in 0..steps {
        swarm.step(&mut |x| sphere(black_box(x)));
    }
}

/// Some steps of a swarm half way through its iterations.
fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sphere");
    group.throughput(Throughput::Elements((PARTICLES * STEPS) as u64));
    for dimensions in [2, 7, 30] {
        let bounds = Bounds::new(&vec![[-5.12, 5.12]; dimensions]).expect("a box");
        for (name, neighbourhood) in
            [("global", Neighbourhood::Global), ("ring of 2", Neighbourhood::Ring { k: 2 })]
        {
            let settings = SwarmSettings { particles: PARTICLES, neighbourhood, ..SwarmSettings::default() };
            let found = minimise(sphere, &bounds, &settings, 1).expect("a swarm");
            assert!(found.value < 0.1 * dimensions as f64, "{dimensions}-D {name}: {}", found.value);
            assert!(found.evaluations == PARTICLES * settings.iterations);

            let mut swarm = Swarm::new(&bounds, &settings, 1).expect("a swarm");
            run(&mut swarm, settings.iterations / 2);
            group.bench_function(BenchmarkId::new(name, dimensions), |bencher| {
                bencher.iter_batched_ref(|| swarm.clone(), |swarm| run(swarm, STEPS), BatchSize::SmallInput);
            });
            run(&mut swarm, settings.iterations - settings.iterations / 2);
            assert!(swarm.best() == (found.position.as_slice(), found.value));
        }
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
