//! A grid as a graph, for tests, benchmarks and the example `measure`.

use std::f64::consts::SQRT_2;

use elbowroom::search::Graph;

/// Nodes in rows and columns, free or not; each free one has its free neighbours along rows, columns and diagonals, corners
/// may be cut.
///
/// What can be changed is which nodes are free.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lattice {
    columns: usize,
    rows: usize,
    step: f64,
    free: Vec<bool>,
    /// A bit for each free neighbour of a free node, in the order of [`Around`].
    open: Vec<u8>,
    /// From a node to its neighbours, in the same order.
    offsets: [isize; 8],
}

/// Columns and rows from a node to its neighbours, once round.
const AROUND: [(isize, isize); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];

impl Lattice {
    /// Rows of `columns` nodes, `step` apart (m), row after row in `free`; a last row that is not full is left out.
    pub(crate) fn new(columns: usize, step: f64, mut free: Vec<bool>) -> Self {
        let rows = free.len().checked_div(columns).unwrap_or(0);
        free.truncate(rows * columns);
        let offsets = AROUND.map(|(dx, dy)| dy * columns as isize + dx);
        let mut lattice = Self { columns, rows, step, open: vec![0; free.len()], free, offsets };
        for row in 0..rows {
            for column in 0..columns {
                let inside = column > 0 && row > 0 && column + 1 < columns && row + 1 < rows;
                let node = row * columns + column;
                lattice.open[node] = if inside { lattice.inner_look(node) } else { lattice.look(node) };
            }
        }
        lattice
    }

    /// Whether `node` is free; false beyond the last one.
    pub(crate) fn is_free(&self, node: usize) -> bool {
        self.free.get(node).copied().unwrap_or(false)
    }

    /// Frees or blocks `node`; numbers that are no node are passed over.
    pub(crate) fn set_free(&mut self, node: usize, free: bool) {
        if node < self.free.len() {
            self.free[node] = free;
            self.open[node] = self.look(node);
            for direction in 0..8 {
                if let Some(neighbour) = self.neighbour(node, direction) {
                    self.open[neighbour] = self.look(neighbour);
                }
            }
        }
    }

    fn neighbour(&self, node: usize, direction: usize) -> Option<usize> {
        let (dx, dy) = AROUND[direction];
        let column = (node % self.columns).checked_add_signed(dx).filter(|&column| column < self.columns)?;
        let row = (node / self.columns).checked_add_signed(dy).filter(|&row| row < self.rows)?;
        Some(row * self.columns + column)
    }

    /// The bits of `node`.
    fn look(&self, node: usize) -> u8 {
        let open = |&direction: &usize| {
            self.free[node] && self.neighbour(node, direction).is_some_and(|neighbour| self.free[neighbour])
        };
        (0..8).filter(open).fold(0, |bits, direction| bits | 1 << direction)
    }

    /// The same for a node that is not in the first or last row or column.
    fn inner_look(&self, node: usize) -> u8 {
        if !self.free[node] {
            return 0;
        }
        let bit = |(direction, &offset): (usize, &isize)| {
            u8::from(self.free[node.wrapping_add_signed(offset)]) << direction
        };
        self.offsets.iter().enumerate().map(bit).fold(0, |bits, bit| bits | bit)
    }
}

impl Graph for Lattice {
    fn len(&self) -> usize {
        self.free.len()
    }

    #[inline]
    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        let steps = [self.step, SQRT_2 * self.step];
        let open = self.open[node];
        if open == u8::MAX {
            for (direction, offset) in self.offsets.iter().enumerate() {
                visit(node.wrapping_add_signed(*offset), steps[direction % 2]);
            }
        } else {
            for direction in 0..8 {
                if let Some(neighbour) = self.neighbour(node, direction) {
                    let is_open = open >> direction & 1 == 1;
                    visit(neighbour, if is_open { steps[direction % 2] } else { f64::INFINITY });
                }
            }
        }
    }

    fn usual_step(&self) -> Option<f64> {
        Some(self.step)
    }
}
