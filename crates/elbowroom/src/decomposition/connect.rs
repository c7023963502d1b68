use std::f64::consts::TAU;

use super::slabs::Slab;
use crate::geometry::{Point, Vector};
use crate::mesh::{Across, MeshPoint, NavigationMesh, Side};

/// Stretches shorter than this are left out, and places no farther outside a cell are in it: rounding.
const SHORTEST: f64 = 1e-12;

/// Cells between two questions whether to keep going.
const CELLS_PER_LOOK: usize = 4096;

/// An open trapezoid of a slab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Opening {
    pub(super) left: [f64; 2],
    pub(super) right: [f64; 2],
}

/// Slabs side by side.
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    pub(super) slabs: Vec<Slab>,
    /// Whether the last slab's end is the first one's beginning.
    pub(super) round: bool,
}

/// The openings of slabs as the cells of a mesh.
pub(crate) struct ConnectedCells {
    pub(crate) mesh: NavigationMesh,
    slabs: Vec<Slab>,
    openings: Vec<Vec<Opening>>,
    /// The first cell of each slab.
    first_cells: Vec<usize>,
}

impl ConnectedCells {
    /// Where `point` is on the mesh, if it is in the open.
    pub(crate) fn place(&self, point: Point) -> Option<MeshPoint> {
        // Slabs lie in order; a place between two of them is in either.
        let after = self.slabs.partition_point(|slab| slab.x[0] <= point.x);
        [after.checked_sub(1), after.checked_sub(2)].into_iter().flatten().find_map(|slab| {
            let [x0, x1] = self.slabs[slab].x;
            let share = (point.x - x0) / (x1 - x0);
            let holds = |open: &Opening| {
                let at = |i: usize| open.left[i] + (open.right[i] - open.left[i]) * share;
                (at(0) - SHORTEST..=at(1) + SHORTEST).contains(&point.y)
            };
            let inside = (-SHORTEST..=1.0 + SHORTEST).contains(&share);
            let i = self.openings[slab].iter().position(|open| inside && holds(open))?;
            Some(MeshPoint { cell: self.first_cells[slab] + i, point })
        })
    }
}

/// Where one cell is open to another across a slab's end.
struct Gate {
    from: f64,
    to: f64,
    left: usize,
    right: usize,
}

/// Cells of what is open in `stretches`, joined along the slabs' ends and, where the second joint goes `round`,
/// along the ends of its `range`; `None` where `keep_going` said no, or they are more than can be numbered.
pub(super) fn connect(
    stretches: Vec<Stretch>,
    range: [f64; 2],
    round: bool,
    keep_going: &dyn Fn() -> bool,
) -> Option<ConnectedCells> {
    let stopped = |done: usize| done.is_multiple_of(CELLS_PER_LOOK) && !keep_going();
    let slabs: Vec<&Slab> = stretches.iter().flat_map(|stretch| &stretch.slabs).collect();
    let open = |(i, slab): (usize, &&Slab)| if stopped(i) { None } else { Some(openings(slab, range)) };
    let openings: Vec<Vec<Opening>> = slabs.iter().enumerate().map(open).collect::<Option<_>>()?;
    let mut first_cells = vec![0];
    for opening in &openings {
        first_cells.push(first_cells[first_cells.len() - 1] + opening.len());
    }
    let all: Vec<(&Slab, Opening)> =
        slabs.iter().zip(&openings).flat_map(|(slab, open)| open.iter().map(|o| (*slab, *o))).collect();

    // Gates at each slab's beginning, to the slab before it.
    let mut before: Vec<Option<(usize, f64)>> = Vec::with_capacity(slabs.len());
    for stretch in &stretches {
        let first = before.len();
        for i in 0..stretch.slabs.len() {
            before.push(match i {
                0 if stretch.round => Some((first + stretch.slabs.len() - 1, TAU)),
                0 => None,
                _ => Some((first + i - 1, 0.0)),
            });
        }
    }
    let mut at_left: Vec<Vec<Gate>> = (0..all.len()).map(|_| Vec::new()).collect();
    let mut at_right: Vec<Vec<(f64, f64, usize, f64)>> = vec![Vec::new(); all.len()];
    for (slab, before) in before.iter().enumerate() {
        let Some((before, shift)) = *before else { continue };
        if stopped(slab) {
            return None;
        }
        let (lefts, rights) = (&openings[before], &openings[slab]);
        let (mut i, mut j) = (0, 0);
        while i < lefts.len() && j < rights.len() {
            let (a, b) = (lefts[i].right, rights[j].left);
            let (from, to) = (a[0].max(b[0]), a[1].min(b[1]));
            let (left, right) = (first_cells[before] + i, first_cells[slab] + j);
            if to - from > SHORTEST {
                at_left[right].push(Gate { from, to, left, right });
                at_right[left].push((from, to, right, shift));
            }
            if a[1] < b[1] { i += 1 } else { j += 1 }
        }
    }

    // The sides of each cell: bottom, the right end upwards, top, the left end downwards.
    let mut cells: Vec<Vec<Side>> = Vec::with_capacity(all.len());
    // Where each cell's gates and its bottom and top ended up among its sides.
    let mut gate_sides: Vec<Vec<usize>> = Vec::with_capacity(all.len());
    let mut tops: Vec<Option<usize>> = Vec::with_capacity(all.len());
    let mut bottoms: Vec<Option<usize>> = Vec::with_capacity(all.len());
    for (cell, (slab, opening)) in all.iter().enumerate() {
        if stopped(cell) {
            return None;
        }
        let mut chain = Chain { sides: Vec::new() };
        let [x0, x1] = slab.x;
        let [low, high] = range;
        let on = |ends: [f64; 2], border: f64| round && ends == [border; 2];
        chain.push(Point::new(x0, opening.left[0]));
        bottoms.push(on([opening.left[0], opening.right[0]], low).then_some(0));
        chain.push(Point::new(x1, opening.right[0]));
        let mut gates = Vec::new();
        for &(from, to, ..) in &at_right[cell] {
            gates.push(chain.gate(Point::new(x1, from), Point::new(x1, to)));
        }
        let top = chain.push(Point::new(x1, opening.right[1]));
        tops.push(on([opening.left[1], opening.right[1]], high).then_some(top));
        chain.push(Point::new(x0, opening.left[1]));
        for gate in at_left[cell].iter().rev() {
            gates.push(chain.gate(Point::new(x0, gate.to), Point::new(x0, gate.from)));
        }
        chain.close();
        gate_sides.push(gates);
        cells.push(chain.sides);
    }

    for right in 0..all.len() {
        if stopped(right) {
            return None;
        }
        let (rights, count) = (at_right[right].len(), at_left[right].len());
        for (k, gate) in at_left[right].iter().enumerate() {
            let at = at_right[gate.left]
                .iter()
                .position(|(from, _, cell, _)| *cell == gate.right && *from == gate.from);
            let Some(at) = at else { continue };
            let shift = Vector::new(at_right[gate.left][at].3, 0.0);
            let (right_side, left_side) =
                (gate_sides[right][rights + count - 1 - k], gate_sides[gate.left][at]);
            let to = |cell, side, shift| Some(Across { cell, side, shift });
            cells[right][right_side].across = to(gate.left, left_side, shift);
            cells[gate.left][left_side].across = to(right, right_side, -shift);
        }
    }
    for slab in 0..slabs.len() {
        let (first, end) = (first_cells[slab], first_cells[slab + 1]);
        if first == end {
            continue;
        }
        if let (Some(bottom), Some(top)) = (bottoms[first], tops[end - 1]) {
            let to = |cell, side, shift| Some(Across { cell, side, shift: Vector::new(0.0, shift) });
            cells[first][bottom].across = to(end - 1, top, TAU);
            cells[end - 1][top].across = to(first, bottom, -TAU);
        }
    }
    let mesh = NavigationMesh::new_until(&cells, keep_going).ok()?;
    first_cells.pop();
    let slabs = stretches.into_iter().flat_map(|stretch| stretch.slabs).collect();
    Some(ConnectedCells { mesh, slabs, openings, first_cells })
}

/// What the barriers of a slab leave open.
fn openings(slab: &Slab, [low, high]: [f64; 2]) -> Vec<Opening> {
    let mut openings = Vec::with_capacity(slab.barriers.len() + 1);
    let mut from = [low; 2];
    let ends = slab.barriers.iter().map(|barrier| (barrier.left, barrier.right));
    for (left, right) in ends.chain([([high; 2], [high; 2])]) {
        let open = |from: f64, to: f64| [from, if to - from > SHORTEST { to } else { from }];
        let opening = Opening { left: open(from[0], left[0]), right: open(from[1], right[0]) };
        if opening.left[1] > opening.left[0] || opening.right[1] > opening.right[0] {
            openings.push(opening);
        }
        from = [left[1], right[1]];
    }
    openings
}

/// Sides one after the other; points too near to the last one are it.
struct Chain {
    sides: Vec<Side>,
}

impl Chain {
    /// Begins a side at `point`; which one.
    fn push(&mut self, point: Point) -> usize {
        let is_new = self.sides.last().is_none_or(|last| !near(last.from, point));
        if is_new {
            self.sides.push(Side { from: point, across: None });
        }
        self.sides.len() - 1
    }

    /// A side from `from` to `to`, both exactly so; which one.
    fn gate(&mut self, from: Point, to: Point) -> usize {
        let side = self.push(from);
        self.sides[side].from = from;
        self.sides.push(Side { from: to, across: None });
        side
    }

    fn close(&mut self) {
        while self.sides.len() > 1 && near(self.sides[0].from, self.sides[self.sides.len() - 1].from) {
            self.sides.pop();
        }
    }
}

fn near(a: Point, b: Point) -> bool {
    (a.x - b.x).abs() <= SHORTEST && (a.y - b.y).abs() <= SHORTEST
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::super::slabs::Barrier;
    use super::*;
    use crate::mesh::{Measure, geodesic};
    use crate::random::unit;

    /// Slabs over [0, n] x [0, 4], their barriers straight on or square, begun and ended at random.
    fn random_slabs(rng: &mut ChaCha8Rng) -> Vec<Slab> {
        let count = 2 + (unit(rng) * 7.0) as usize;
        let mut x = 0.0;
        let ends = |rng: &mut ChaCha8Rng, parts: usize| -> Vec<[f64; 2]> {
            let mut at: Vec<f64> = (0..2 * parts).map(|_| 0.1 + 3.8 * unit(rng)).collect();
            at.sort_by(f64::total_cmp);
            at.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
        };
        let mut left = ends(rng, 1);
        (0..count)
            .map(|_| {
                let from = x;
                x += 0.1 + unit(rng);
                let kind = (unit(rng) * 4.0) as usize;
                let parts = 1 + (unit(rng) * 2.9) as usize;
                let right = match kind {
                    0 => ends(rng, left.len()),
                    1 => left.clone(),
                    _ => ends(rng, parts),
                };
                let barriers = match kind {
                    0 | 1 => left.iter().zip(&right).map(|(&left, &right)| Barrier { left, right }).collect(),
                    2 => Vec::new(),
                    _ => right.iter().map(|&ends| Barrier { left: ends, right: ends }).collect(),
                };
                left = right;
                Slab { x: [from, x], barriers }
            })
            .collect()
    }

    fn holds(connected: &ConnectedCells, point: Point) -> bool {
        (0..connected.mesh.len()).any(|cell| {
            let sides = connected.mesh.sides(cell);
            (0..sides.len()).all(|i| {
                let (a, b) = (sides[i].from, sides[(i + 1) % sides.len()].from);
                (b - a).cross(point - a) >= -1e-9
            })
        })
    }

    fn judged(connected: &ConnectedCells, start: Point, goal: Point) -> Option<f64> {
        let mut walls = Vec::new();
        for cell in 0..connected.mesh.len() {
            let sides = connected.mesh.sides(cell);
            for (i, side) in sides.iter().enumerate().filter(|(_, side)| side.across.is_none()) {
                walls.push((side.from, sides[(i + 1) % sides.len()].from));
            }
        }
        let mut points = vec![start, goal];
        points.extend(walls.iter().flat_map(|wall| [wall.0, wall.1]));
        let sees = |a: Point, b: Point| {
            let along = b - a;
            let crosses = |&(p, q): &(Point, Point)| {
                let side = |v: f64| if v.abs() < 1e-9 { 0.0 } else { v.signum() };
                let (sp, sq) = (side(along.cross(p - a)), side(along.cross(q - a)));
                let (sa, sb) = (side((q - p).cross(a - p)), side((q - p).cross(b - p)));
                sp * sq < 0.0 && sa * sb < 0.0
            };
            // Along a slab's end only from one vertex to the next: openings may be narrow.
            let between = |p: &Point| {
                along.x.abs() < 1e-9 && (p.x - a.x).abs() < 1e-9 && (p.y - a.y) * (p.y - b.y) < 0.0
            };
            !points.iter().any(between)
                && !walls.iter().any(crosses)
                && (0..=600).all(|k| holds(connected, a.lerp(b, f64::from(k) / 600.0)))
        };
        let mut costs = vec![f64::INFINITY; points.len()];
        let mut done = vec![false; points.len()];
        costs[0] = 0.0;
        loop {
            let next =
                (0..points.len()).filter(|&i| !done[i]).min_by(|&a, &b| costs[a].total_cmp(&costs[b]))?;
            if costs[next].is_infinite() {
                return None;
            }
            if next == 1 {
                return Some(costs[1]);
            }
            done[next] = true;
            for i in 0..points.len() {
                let cost = costs[next] + points[i].distance(points[next]);
                if !done[i] && cost < costs[i] && sees(points[next], points[i]) {
                    costs[i] = cost;
                }
            }
        }
    }

    #[test]
    fn cells_are_given_up_wherever_they_are_told_to_stop() {
        // Slabs enough for several questions at every step.
        let slab = |i: usize| Slab { x: [i as f64, i as f64 + 1.0], barriers: Vec::new() };
        let stretch = || vec![Stretch { slabs: (0..10_000).map(slab).collect(), round: false }];
        let asked = std::cell::Cell::new(0);
        let most = std::cell::Cell::new(usize::MAX);
        let keep_going = || asked.replace(asked.get() + 1) < most.get();
        assert!(connect(stretch(), [0.0, 1.0], false, &keep_going).is_some());
        let all = asked.replace(0);
        // Three times in each of the seven passes over the cells; the first slab has none before it to be joined to.
        assert_eq!(all, 20);
        for stop in 0..all {
            most.set(stop);
            asked.set(0);
            assert!(connect(stretch(), [0.0, 1.0], false, &keep_going).is_none(), "{stop}");
            assert_eq!(asked.get(), stop + 1, "asked again after no");
        }
    }

    #[test]
    fn shortest_paths_among_trapezoids_agree_with_a_visibility_graph() {
        let mut found = 0;
        for seed in 0..1000 {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let slabs = random_slabs(&mut rng);
            let width = slabs[slabs.len() - 1].x[1];
            let connected =
                connect(vec![Stretch { slabs, round: false }], [0.0, 4.0], false, &|| true).unwrap();
            let mut place = || loop {
                let point = Point::new(width * unit(&mut rng), 4.0 * unit(&mut rng));
                if let Some(cell) = (0..connected.mesh.len()).find(|&cell| connected.mesh.holds(cell, point))
                {
                    return MeshPoint { cell, point };
                }
            };
            let (start, goal) = (place(), place());
            let looks = std::cell::Cell::new(0);
            let keep_going = || {
                looks.set(looks.get() + 1);
                looks.get() < 100
            };
            let path = geodesic(&connected.mesh, &[start], &[goal], Measure::Euclidean, &[], &keep_going);
            let judged = judged(&connected, start.point, goal.point);
            match (path.map(|path| path.cost), judged) {
                (None, None) => {}
                (Some(a), Some(b)) if (a - b).abs() < 1e-7 => found += 1,
                other => panic!("seed {seed}: {other:?}"),
            }
        }
        assert!(found > 400, "{found}");
    }
}
