//! The plain swarm on the sphere: particles moved and evaluated per second.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use elbowroom::swarm::{Bounds, Neighbourhood, Swarm, SwarmSettings, minimise};

const PARTICLES: usize = 50;

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

/// One step of a swarm that is well under way.
fn step(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sphere");
    group.throughput(Throughput::Elements(PARTICLES as u64));
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
            group.bench_function(BenchmarkId::new(name, dimensions), |bencher| {
                bencher.iter(|| swarm.step(&mut |x| sphere(black_box(x))));
            });
            assert!(bounds.contains(swarm.best().0) && swarm.best().1 == sphere(swarm.best().0));
        }
    }
    group.finish();
}

criterion_group!(benches, step);
criterion_main!(benches);
