//! Cost-to-go on free square grids: from scratch, and repaired after a disc moved by a cell.

#![expect(clippy::expect_used, reason = "a benchmark that cannot be set up may panic")]

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use elbowroom::search::{Dstar, Graph, Progress, Until, dijkstra};

/// A square of cells with eight neighbours; costs are worked out on the fly.
#[derive(Clone)]
struct Cells {
    side: usize,
    blocked: Vec<bool>,
}

impl Cells {
    fn free(side: usize) -> Self {
        Self { side, blocked: vec![false; side * side] }
    }

    /// Blocks or frees the disc around the cell in `column` and `row`.
    fn set_disc(&mut self, [column, row]: [usize; 2], radius: usize, blocked: bool) {
        for y in row - radius..=row + radius {
            for x in column - radius..=column + radius {
                if x.abs_diff(column).pow(2) + y.abs_diff(row).pow(2) <= radius * radius {
                    self.blocked[y * self.side + x] = blocked;
                }
            }
        }
    }
}

impl Graph for Cells {
    fn len(&self) -> usize {
        self.blocked.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        const OFFSETS: [(isize, isize); 8] =
            [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
        let (side, free) = (self.side as isize, !self.blocked[node]);
        let (x, y) = ((node % self.side) as isize, (node / self.side) as isize);
        for (dx, dy) in OFFSETS {
            if (0..side).contains(&(x + dx)) && (0..side).contains(&(y + dy)) {
                let other = (node as isize + dy * side + dx) as usize;
                let length = if dx == 0 || dy == 0 { 1.0 } else { std::f64::consts::SQRT_2 };
                visit(other, if free && !self.blocked[other] { length } else { f64::INFINITY });
            }
        }
    }
}

fn field(cells: &Cells, goal: usize) -> Dstar {
    let mut dstar = Dstar::new(cells.len());
    dstar.insert_goal(goal, 0.0).expect("the goal is a cell");
    assert_eq!(dstar.expand(cells, Until::WholeField, usize::MAX), Progress::Done);
    dstar
}

fn assert_equal(dstar: &Dstar, cells: &Cells, goal: usize) {
    let judge = dijkstra(cells, &[(goal, 0.0)]).expect("the goal is a cell");
    assert!(dstar.field() == judge, "D* differs from Dijkstra");
}

fn from_scratch(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("field");
    group.sample_size(10);
    for side in [101, 1001] {
        let cells = Cells::free(side);
        assert_equal(&field(&cells, 0), &cells, 0);
        group.bench_with_input(BenchmarkId::new("dstar", side), &cells, |bencher, cells| {
            bencher.iter(|| field(black_box(cells), 0));
        });
        group.bench_with_input(BenchmarkId::new("dijkstra", side), &cells, |bencher, cells| {
            bencher.iter(|| dijkstra(black_box(cells), &[(0, 0.0)]));
        });
    }
    group.finish();
}

/// A disc of 25 cells radius moves by one cell, to and fro; the goal is in one corner, the start in the other.
fn repair(criterion: &mut Criterion) {
    const SIDE: usize = 1001;
    const RADIUS: usize = 25;
    let mut group = criterion.benchmark_group("repair");
    group.sample_size(10);
    let (goal, start) = (0, SIDE * SIDE - 1);
    for (place, [column, row]) in
        [("near goal", [60, 70]), ("middle", [500, 500]), ("near start", [930, 940])]
    {
        let mut before = Cells::free(SIDE);
        let mut after = before.clone();
        before.set_disc([column, row], RADIUS, true);
        after.set_disc([column + 1, row], RADIUS, true);
        let moved: Vec<usize> =
            (0..SIDE * SIDE).filter(|&cell| before.blocked[cell] != after.blocked[cell]).collect();

        for (name, until) in [("whole field", Until::WholeField), ("settled", Until::Settled(start))] {
            let mut dstar = field(&before, goal);
            let mut there = false;
            let mut go = || {
                there = !there;
                let cells = if there { &after } else { &before };
                dstar.changed(cells, moved.iter().copied());
                assert_eq!(dstar.expand(cells, until, usize::MAX), Progress::Done);
                dstar.cost_to_go(start)
            };
            // One call moves it there, the next back: each half of the samples has one of the two.
            group.bench_function(BenchmarkId::new(name, place), |bencher| {
                bencher.iter_batched(|| (), |()| go(), BatchSize::PerIteration);
            });
            dstar.expand(if there { &after } else { &before }, Until::WholeField, usize::MAX);
            assert_equal(&dstar, if there { &after } else { &before }, goal);
        }
    }
    group.finish();
}

criterion_group!(benches, from_scratch, repair);
criterion_main!(benches);
