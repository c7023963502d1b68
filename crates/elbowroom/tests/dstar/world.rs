//! Random graphs whose costs change.

use super::*;

/// A graph whose costs can be changed.
pub(crate) enum World {
    /// Eight neighbours, corners may be cut; a step costs its length times the mean weight of its two cells.
    Cells { columns: usize, weights: Vec<f64>, blocked: Vec<bool>, usual_step: Option<f64> },
    /// Any graph: each node's neighbours with the number of the edge, and the cost of each edge.
    Network { neighbours: Vec<Vec<(usize, usize)>>, costs: Vec<f64>, usual_step: Option<f64> },
}

impl Graph for World {
    fn len(&self) -> usize {
        match self {
            Self::Cells { weights, .. } => weights.len(),
            Self::Network { neighbours, .. } => neighbours.len(),
        }
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        match self {
            Self::Cells { columns, weights, blocked, .. } => {
                let (x, y) = (node % columns, node / columns);
                let rows = weights.len() / columns;
                for row in y.saturating_sub(1)..=(y + 1).min(rows - 1) {
                    for column in x.saturating_sub(1)..=(x + 1).min(columns - 1) {
                        let other = row * columns + column;
                        if other == node {
                            continue;
                        }
                        let length = if row == y || column == x { 1.0 } else { std::f64::consts::SQRT_2 };
                        let free = !blocked[node] && !blocked[other];
                        let cost = length * (0.5 * (weights[node] + weights[other]));
                        visit(other, if free { cost } else { f64::INFINITY });
                    }
                }
            }
            Self::Network { neighbours, costs, .. } => {
                for &(other, edge) in &neighbours[node] {
                    visit(other, costs[edge]);
                }
            }
        }
    }

    fn usual_step(&self) -> Option<f64> {
        let (Self::Cells { usual_step, .. } | Self::Network { usual_step, .. }) = self;
        *usual_step
    }
}

pub(crate) struct Random(ChaCha8Rng);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }

    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    /// Small whole costs, where ties abound, or any from a thousandth to a thousand.
    pub(crate) fn cost(&mut self) -> f64 {
        if self.chance(0.5) { (1 + self.below(4)) as f64 } else { libm::exp(6.9 * (2.0 * self.unit() - 1.0)) }
    }

    /// None, a step that is usual, or any, however wrong: it must change nothing.
    fn usual_step(&mut self) -> Option<f64> {
        match self.below(6) {
            0..2 => None,
            2..4 => Some(1.0),
            4 => Some(libm::exp(60.0 * (2.0 * self.unit() - 1.0))),
            _ => Some([0.0, -1.0, 1e-300, 5e-324, 1e300, f64::INFINITY, f64::NAN][self.below(7)]),
        }
    }

    pub(crate) fn cells(&mut self, columns: usize, rows: usize) -> World {
        let (density, weighted) = (0.7 * self.unit(), self.chance(0.3));
        let len = columns * rows;
        World::Cells {
            columns,
            weights: (0..len).map(|_| if weighted { self.cost() } else { 1.0 }).collect(),
            blocked: (0..len).map(|_| self.chance(density)).collect(),
            usual_step: self.usual_step(),
        }
    }

    pub(crate) fn network(&mut self, len: usize) -> World {
        let mut world = World::Network {
            neighbours: vec![Vec::new(); len],
            costs: Vec::new(),
            usual_step: self.usual_step(),
        };
        let (edges, blocked) = (self.below(3 * len), 0.5 * self.unit());
        for _ in 0..edges {
            let (a, b) = (self.below(len), self.below(len));
            let cost = if self.chance(blocked) { f64::INFINITY } else { self.cost() };
            let World::Network { neighbours, costs, .. } = &mut world else { unreachable!() };
            if a != b && neighbours[a].iter().all(|&(other, _)| other != b) {
                neighbours[a].push((b, costs.len()));
                neighbours[b].push((a, costs.len()));
                costs.push(cost);
            }
        }
        world
    }

    pub(crate) fn world(&mut self) -> World {
        match self.below(100) {
            0..25 => {
                let len = 2 + self.below(60);
                self.network(len)
            }
            25 => {
                let (columns, rows) = (40 + self.below(30), 40 + self.below(30));
                self.cells(columns, rows)
            }
            _ => {
                let (columns, rows) = (1 + self.below(16), 2 + self.below(15));
                self.cells(columns, rows)
            }
        }
    }

    /// Changes the world here and there, and says where.
    pub(crate) fn change(&mut self, world: &mut World, start: usize, goals: &[(usize, f64)]) -> Vec<usize> {
        let len = world.len();
        let count = if self.chance(0.7) { 1 + self.below(4) } else { 1 + self.below(len) };
        let mut nodes: Vec<usize> = (0..count).map(|_| self.below(len)).collect();
        let (kind, coin) = (self.below(6), self.chance(0.5));
        match kind {
            0 => nodes = goals.iter().map(|goal| goal.0).collect(),
            1 => {
                nodes.clear();
                world.neighbours(start, |node, _| nodes.push(node));
            }
            2 => nodes = (0..len).collect(),
            _ => {}
        }
        match world {
            World::Cells { weights, blocked, .. } => {
                for &node in &nodes {
                    match kind {
                        // Goals, a ring around the start: all blocked or all freed.
                        0 | 1 => blocked[node] = coin,
                        2 => blocked[node] = self.chance(0.3),
                        3 => weights[node] = self.cost(),
                        _ => blocked[node] = !blocked[node],
                    }
                }
                nodes
            }
            World::Network { neighbours, costs, .. } => {
                let mut ends = Vec::new();
                for a in nodes {
                    for &(b, edge) in &neighbours[a] {
                        if kind < 2 || self.chance(0.5) {
                            let block = if kind < 2 { coin } else { self.chance(0.3) };
                            costs[edge] = if block { f64::INFINITY } else { self.cost() };
                            // One end of a changed edge has to do, whichever it is.
                            ends.push(if self.chance(0.5) { a } else { b });
                        }
                    }
                }
                ends
            }
        }
    }
}
