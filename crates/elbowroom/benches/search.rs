//! Cost-to-go on free square grids: from scratch, and repaired after a disc moved by a cell.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::collections::HashSet;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use elbowroom::search::{Dstar, Graph, Progress, Until, dijkstra};
use lattice::Lattice;

#[path = "../tests/lattice/mod.rs"]
#[expect(dead_code, reason = "shared with tests")]
mod lattice;

const SIDE: usize = 1001;
const STEP: f64 = 0.001;
const RADIUS: usize = 25;

/// The disc around the cell in `column` and `row` of a map of [`SIDE`] columns.
fn disc([column, row]: [usize; 2]) -> HashSet<usize> {
    let square =
        (row - RADIUS..=row + RADIUS).flat_map(|y| (column - RADIUS..=column + RADIUS).map(move |x| (x, y)));
    let inside =
        |&(x, y): &(usize, usize)| x.abs_diff(column).pow(2) + y.abs_diff(row).pow(2) <= RADIUS * RADIUS;
    square.filter(inside).map(|(x, y)| y * SIDE + x).collect()
}

fn free(side: usize) -> Lattice {
    Lattice::new(side, STEP, vec![true; side * side])
}

fn free_but(blocked: &HashSet<usize>) -> Lattice {
    Lattice::new(SIDE, STEP, (0..SIDE * SIDE).map(|node| !blocked.contains(&node)).collect())
}

fn field(map: &Lattice, goal: usize) -> Dstar {
    let mut dstar = Dstar::new(map.len());
    dstar.insert_goal(goal, 0.0).expect("the goal is a cell");
    assert_eq!(dstar.expand(map, Until::WholeField, usize::MAX), Progress::Done);
    dstar
}

fn assert_equal(field: &[f64], map: &Lattice, goal: usize) {
    let judge = dijkstra(map, &[(goal, 0.0)]).expect("the goal is a cell");
    assert!(field == judge, "the field differs from Dijkstra's");
}

fn from_scratch(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("field");
    group.sample_size(20);
    for side in [101, SIDE] {
        let map = free(side);
        assert_equal(&field(&map, 0).field(), &map, 0);
        group.bench_with_input(BenchmarkId::new("dstar", side), &map, |bencher, map| {
            bencher.iter(|| field(black_box(map), 0));
        });
        group.bench_with_input(BenchmarkId::new("dijkstra", side), &map, |bencher, map| {
            bencher.iter(|| dijkstra(black_box(map), &[(0, 0.0)]));
        });
    }
    group.finish();
}

/// A disc moves by one cell, to and fro; the goal is in one corner, the start in the other.
fn repair(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("repair");
    group.sample_size(10);
    let (goal, start) = (0, SIDE * SIDE - 1);
    for (place, [column, row]) in
        [("near goal", [60, 70]), ("middle", [500, 500]), ("near start", [930, 940])]
    {
        let (here, beside) = (disc([column, row]), disc([column + 1, row]));
        let (before, after) = (free_but(&here), free_but(&beside));
        let moved: Vec<usize> = here.symmetric_difference(&beside).copied().collect();

        for (name, until) in [("whole field", Until::WholeField), ("settled", Until::Settled(start))] {
            let mut dstar = field(&before, goal);
            let mut there = false;
            let mut go = || {
                there = !there;
                let map = if there { &after } else { &before };
                dstar.changed(map, moved.iter().copied());
                assert_eq!(dstar.expand(map, until, usize::MAX), Progress::Done);
                dstar.cost_to_go(start)
            };
            // One call moves it there, the next back: each half of the samples has one of the two.
            group.bench_function(BenchmarkId::new(name, place), |bencher| {
                bencher.iter_batched(|| (), |()| go(), BatchSize::PerIteration);
            });
            let map = if there { &after } else { &before };
            dstar.expand(map, Until::WholeField, usize::MAX);
            assert_equal(&dstar.field(), map, goal);
        }
    }
    group.bench_function("whole field/median of 64 places", |bencher| {
        bencher
            .iter_custom(|iterations| median_over_places() * u32::try_from(iterations).unwrap_or(u32::MAX));
    });
    group.finish();
}

/// One move each of a disc at places spread over the map, with the goal in a corner.
fn median_over_places() -> Duration {
    let mut times: Vec<Duration> = (0..64)
        .map(|i| {
            let [column, row] = [60 + 110 * (i % 8), 60 + 110 * (i / 8)];
            let (here, beside) = (disc([column, row]), disc([column + 1, row]));
            let mut dstar = field(&free_but(&here), 0);
            let moved: Vec<usize> = here.symmetric_difference(&beside).copied().collect();
            let after = free_but(&beside);
            let begin = Instant::now();
            dstar.changed(&after, moved);
            assert_eq!(dstar.expand(&after, Until::WholeField, usize::MAX), Progress::Done);
            begin.elapsed()
        })
        .collect();
    times.sort_unstable();
    times[times.len() / 2]
}

criterion_group!(benches, from_scratch, repair);
criterion_main!(benches);
