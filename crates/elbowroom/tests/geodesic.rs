//! Shortest paths on meshes against a visibility graph, on maps of squares: plain and wrapped round.

#![expect(clippy::unwrap_used, reason = "a map of squares that makes no mesh may panic")]

use elbowroom::geometry::{Point, Vector};
use elbowroom::mesh::{Across, Measure, MeshError, MeshPoint, NavigationMesh, Side, geodesic};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// A map of unit squares, some of them blocked.
#[derive(Clone)]
struct Squares {
    columns: usize,
    rows: usize,
    blocked: Vec<bool>,
}

impl Squares {
    fn random(columns: usize, rows: usize, share: f64, wraps: bool, rng: &mut ChaCha8Rng) -> Self {
        let blocked = (0..columns * rows).map(|_| unit(rng) < share).collect();
        let mut squares = Self { columns, rows, blocked };
        squares.part_diagonals(wraps);
        squares
    }

    /// Blocks a third square wherever two touch at a corner only: a path cannot pass there, and a visibility graph
    /// over corners cannot tell.
    fn part_diagonals(&mut self, wraps: bool) {
        let (columns, rows) = (self.columns, self.rows);
        loop {
            let before = self.blocked.clone();
            let last = usize::from(!wraps);
            for row in 0..rows - last {
                for column in 0..columns - last {
                    let at = |c: usize, r: usize| r % rows * columns + c % columns;
                    let square =
                        [at(column, row), at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)];
                    let [a, b, c, d] = square.map(|i| self.blocked[i]);
                    if a == d && b == c && a != b {
                        self.blocked[square[if a { 1 } else { 0 }]] = true;
                    }
                }
            }
            if self.blocked == before {
                return;
            }
        }
    }

    fn free(&self, column: i64, row: i64) -> bool {
        let inside = (0..self.columns as i64).contains(&column) && (0..self.rows as i64).contains(&row);
        inside && !self.blocked[row as usize * self.columns + column as usize]
    }

    /// `times` x `times` copies side by side.
    fn tiled(&self, times: usize) -> Self {
        let (columns, rows) = (self.columns * times, self.rows * times);
        let at = |i: usize| self.blocked[i / columns % self.rows * self.columns + i % columns % self.columns];
        Self { columns, rows, blocked: (0..columns * rows).map(at).collect() }
    }

    fn cells(&self) -> Vec<usize> {
        (0..self.blocked.len()).filter(|&i| !self.blocked[i]).collect()
    }

    fn place(&self, rng: &mut ChaCha8Rng, snap: bool) -> Option<(usize, Point)> {
        let cells = self.cells();
        let cell = *cells.get((unit(rng) * cells.len() as f64) as usize)?;
        let share = |v: f64| if snap { (v * 3.0).floor() / 2.0 } else { v };
        let point = Point::new(
            (cell % self.columns) as f64 + share(unit(rng)),
            (cell / self.columns) as f64 + share(unit(rng)),
        );
        Some((cell, point))
    }

    /// The mesh of the free squares and the cell number of each.
    fn mesh(&self, wraps: bool) -> (NavigationMesh, Vec<usize>) {
        let cells = self.cells();
        let mut number = vec![usize::MAX; self.blocked.len()];
        for (i, &cell) in cells.iter().enumerate() {
            number[cell] = i;
        }
        let (columns, rows) = (self.columns as i64, self.rows as i64);
        let sides = cells.iter().map(|&cell| {
            let (column, row) = ((cell % self.columns) as i64, (cell / self.columns) as i64);
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
            let beyond = [(0, -1), (1, 0), (0, 1), (-1, 0)];
            let side = |i: usize| {
                let from = Point::new((column + corners[i].0) as f64, (row + corners[i].1) as f64);
                let (mut c, mut r) = (column + beyond[i].0, row + beyond[i].1);
                let mut shift = Vector::default();
                if wraps {
                    shift = Vector::new((c.rem_euclid(columns) - c) as f64, (r.rem_euclid(rows) - r) as f64);
                    (c, r) = (c.rem_euclid(columns), r.rem_euclid(rows));
                }
                let across = self.free(c, r).then(|| Across {
                    cell: number[(r * columns + c) as usize],
                    side: (i + 2) % 4,
                    shift,
                });
                Side { from, across }
            };
            (0..4).map(side).collect()
        });
        (NavigationMesh::new(&sides.collect::<Vec<Vec<Side>>>()).unwrap(), number)
    }
}

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// The cheapest way by Dijkstra over all corners that see each other.
fn by_visibility(squares: &Squares, start: Point, goals: &[Point], measure: Measure) -> Option<f64> {
    let mut points = vec![start];
    points.extend_from_slice(goals);
    for row in 0..=squares.rows as i64 {
        for column in 0..=squares.columns as i64 {
            let around = [(-1, -1), (0, -1), (-1, 0), (0, 0)];
            let free = around.iter().filter(|(dc, dr)| squares.free(column + dc, row + dr)).count();
            if free == 3 {
                points.push(Point::new(column as f64, row as f64));
            }
        }
    }
    let mut costs = vec![f64::INFINITY; points.len()];
    let mut done = vec![false; points.len()];
    costs[0] = 0.0;
    loop {
        let next = (0..points.len()).filter(|&i| !done[i]).min_by(|&a, &b| costs[a].total_cmp(&costs[b]))?;
        if costs[next].is_infinite() {
            return None;
        }
        if (1..=goals.len()).contains(&next) {
            return Some(costs[next]);
        }
        done[next] = true;
        for i in 0..points.len() {
            let cost = costs[next] + measure.of(points[i] - points[next]);
            if !done[i] && cost < costs[i] && sees(squares, points[next], points[i]) {
                costs[i] = cost;
            }
        }
    }
}

fn sees(squares: &Squares, a: Point, b: Point) -> bool {
    let way = b - a;
    for (i, _) in squares.blocked.iter().enumerate().filter(|(_, blocked)| **blocked) {
        let (x, y) = ((i % squares.columns) as f64, (i / squares.columns) as f64);
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (start, way, low) in [(a.x, way.x, x), (a.y, way.y, y)] {
            let (low, high) = (low + 1e-9, low + 1.0 - 1e-9);
            if way.abs() < 1e-12 {
                if start <= low || start >= high {
                    to = -1.0;
                }
            } else {
                let (s, t) = ((low - start) / way, (high - start) / way);
                from = from.max(s.min(t));
                to = to.min(s.max(t));
            }
        }
        if to > from {
            return false;
        }
    }
    // Between two squares, along their common side: both or the map's edge may be blocked.
    let along = |fixed: f64, from: f64, to: f64, pair: &dyn Fn(i64) -> [bool; 2]| {
        if (fixed - fixed.round()).abs() > 1e-12 {
            return true;
        }
        let (low, high) = (from.min(to), from.max(to));
        (low.floor() as i64..high.ceil() as i64)
            .filter(|&i| (i as f64) < high - 1e-12 && (i + 1) as f64 > low + 1e-12)
            .all(|i| pair(i).contains(&true))
    };
    if way.x == 0.0 {
        let x = a.x.round() as i64;
        return along(a.x, a.y, b.y, &|row| [squares.free(x - 1, row), squares.free(x, row)]);
    }
    if way.y == 0.0 {
        let y = a.y.round() as i64;
        return along(a.y, a.x, b.x, &|column| [squares.free(column, y - 1), squares.free(column, y)]);
    }
    true
}

fn measures() -> [Measure; 2] {
    [Measure::Euclidean, Measure::Greatest([1.0, 0.7])]
}

fn agree(found: Option<f64>, judged: Option<f64>, what: &str) {
    match (found, judged) {
        (None, None) => {}
        (Some(found), Some(judged)) if (found - judged).abs() <= 1e-9 * (1.0 + judged) => {}
        _ => panic!("{what}: {found:?}, by visibility {judged:?}"),
    }
}

#[test]
fn plain_maps_agree_with_the_visibility_graph() {
    let mut found = 0;
    for seed in 0..5000 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let share = 0.1 + 0.5 * unit(&mut rng);
        let squares = Squares::random(9, 8, share, false, &mut rng);
        let snap = seed % 3 == 0;
        let (Some(start), Some(goal)) = (squares.place(&mut rng, snap), squares.place(&mut rng, snap)) else {
            continue;
        };
        let (mesh, number) = squares.mesh(false);
        let place = |(cell, point): (usize, Point)| MeshPoint { cell: number[cell], point };
        for measure in measures() {
            let images = if seed % 2 == 0 { vec![goal.1] } else { Vec::new() };
            let path = geodesic(&mesh, &[place(start)], &[place(goal)], measure, &images, &|| true);
            // At a corner where only two cells touch a place belongs to the cell it was drawn in.
            let judged = by_visibility(&squares, start.1, &[goal.1], measure);
            if snap && path.is_none() {
                continue;
            }
            agree(path.as_ref().map(|path| path.cost), judged, &format!("seed {seed}, {measure:?}"));
            if let Some(path) = path {
                found += 1;
                let points: Vec<Point> = path.places.iter().map(|place| place.point).collect();
                let length: f64 = points.windows(2).map(|pair| measure.of(pair[1] - pair[0])).sum();
                assert!((length - path.cost).abs() < 1e-9, "seed {seed}: its places are {length} long");
                assert_eq!((points[0], points[points.len() - 1]), (start.1, goal.1));
                for pair in path.places.windows(2) {
                    assert!(
                        mesh.holds(pair[0].cell, pair[0].point) && mesh.holds(pair[0].cell, pair[1].point)
                    );
                }
            }
        }
    }
    assert!(found > 3000, "{found} paths");
}

#[test]
fn maps_that_wrap_round_agree_with_their_copies_side_by_side() {
    for seed in 0..150 {
        let mut rng = ChaCha8Rng::seed_from_u64(1_000_000 + seed);
        let squares = Squares::random(4, 4, 0.15 + 0.3 * unit(&mut rng), true, &mut rng);
        let (Some(start), Some(goal)) = (squares.place(&mut rng, false), squares.place(&mut rng, false))
        else {
            continue;
        };
        let (mesh, number) = squares.mesh(true);
        let place = |(cell, point): (usize, Point)| MeshPoint { cell: number[cell], point };
        let images: Vec<Point> = (-1..=1)
            .flat_map(|i| (-1..=1).map(move |j| Vector::new(f64::from(4 * i), f64::from(4 * j))))
            .map(|shift| goal.1 + shift)
            .collect();
        let copies = squares.tiled(5);
        let middle = Vector::new(8.0, 8.0);
        let goals: Vec<Point> =
            (0..25).map(|i| goal.1 + Vector::new((i % 5 * 4) as f64, (i / 5 * 4) as f64)).collect();
        for measure in measures() {
            let path = geodesic(&mesh, &[place(start)], &[place(goal)], measure, &images, &|| true);
            let judged = by_visibility(&copies, start.1 + middle, &goals, measure);
            let Some(path) = path else {
                assert_eq!(judged, None, "seed {seed}");
                continue;
            };
            // The copies end somewhere: a way round them may be missing there, a shorter one may not.
            if let Some(judged) = judged {
                assert!(path.cost <= judged + 1e-9, "seed {seed}: {} above {judged}", path.cost);
            }
            let unwrapped: Vec<Point> =
                path.places.iter().zip(&path.shifts).map(|(place, shift)| place.point + -*shift).collect();
            let length: f64 = unwrapped.windows(2).map(|pair| measure.of(pair[1] - pair[0])).sum();
            assert!((length - path.cost).abs() < 1e-9, "seed {seed}: {length} and {}", path.cost);
            // Each straight stretch sees its end: the cost is that of a way that exists.
            let inside = |p: Point| (-8.0..12.0).contains(&p.x) && (-8.0..12.0).contains(&p.y);
            for pair in unwrapped.windows(2).filter(|pair| inside(pair[0]) && inside(pair[1])) {
                let (a, b) = (pair[0] + middle, pair[1] + middle);
                assert!(
                    a.distance(b) < 1e-9 || sees(&copies, a.lerp(b, 1e-9), b.lerp(a, 1e-9)),
                    "seed {seed}"
                );
            }
        }
    }
}

#[test]
fn pillars_that_can_be_passed_on_either_side_do_not_double_the_search() {
    // 2^40 paths cost the same.
    let (columns, rows) = (81, 3);
    let blocked = (0..columns * rows).map(|i| i / columns == 1 && i % columns % 2 == 1).collect();
    let (mesh, number) = Squares { columns, rows, blocked }.mesh(false);
    let place = |column: usize| {
        let point = Point::new(column as f64 + 0.5, 1.5);
        MeshPoint { cell: number[columns + column], point }
    };
    for measure in measures() {
        let asked = std::cell::Cell::new(0);
        let keep_going = || asked.replace(asked.get() + 1) < 100;
        let path = geodesic(&mesh, &[place(0)], &[place(columns - 1)], measure, &[], &keep_going).unwrap();
        let expected = match measure {
            // To the first pillar's corner, along the row of pillars, and back.
            Measure::Euclidean => 79.0 + 2.0 * 0.5_f64.sqrt(),
            Measure::Greatest(_) => 80.0,
        };
        assert!((path.cost - expected).abs() < 1e-9, "{}", path.cost);
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    let square = |across: Option<Across>| -> Vec<Side> {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let mut sides: Vec<Side> =
            corners.iter().map(|&(x, y)| Side { from: Point::new(x, y), across: None }).collect();
        sides[1].across = across;
        sides
    };
    let to = |cell, side| Some(Across { cell, side, shift: Vector::default() });
    assert_eq!(NavigationMesh::new(&[square(to(7, 3))]), Err(MeshError::Seam { cell: 0, side: 1 }));
    assert_eq!(NavigationMesh::new(&[square(to(0, 1))]), Err(MeshError::Seam { cell: 0, side: 1 }));
    let clockwise: Vec<Side> = square(None).into_iter().rev().collect();
    assert_eq!(NavigationMesh::new(&[clockwise]), Err(MeshError::Shape { cell: 0 }));
    let mut dart = square(None);
    dart[2].from = Point::new(0.2, 0.2);
    assert_eq!(NavigationMesh::new(&[dart]), Err(MeshError::Shape { cell: 0 }));
    let nan = vec![Side { from: Point::new(f64::NAN, 0.0), across: None }; 3];
    assert_eq!(NavigationMesh::new(&[nan]), Err(MeshError::Shape { cell: 0 }));
    assert!(NavigationMesh::new(&[]).unwrap().is_empty());
}
