use std::ops::Range;

use crate::geometry::Point;
use crate::grid::Grid;

/// Points along each side of the blocks that are not split further.
pub(super) const SIDE: usize = 8;

/// A rectangle of a grid's points, at least one.
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
}

impl Block {
    /// How many points it has.
    pub(super) fn points(&self) -> usize {
        self.columns.len() * self.rows.len()
    }

    /// Whether no side is longer than [`SIDE`].
    pub(super) fn is_small(&self) -> bool {
        self.columns.len() <= SIDE && self.rows.len() <= SIDE
    }

    /// The two halves of a block that is not small, across its longer side; the first a multiple of [`SIDE`] long.
    pub(super) fn halves(&self) -> [Self; 2] {
        let split = |side: &Range<usize>| side.start + (side.len() / 2).next_multiple_of(SIDE);
        let Self { columns, rows } = self.clone();
        if columns.len() >= rows.len() {
            let at = split(&columns);
            [Self { columns: columns.start..at, rows: rows.clone() }, Self { columns: at..columns.end, rows }]
        } else {
            let at = split(&rows);
            [Self { columns: columns.clone(), rows: rows.start..at }, Self { columns, rows: at..rows.end }]
        }
    }

    /// The middle of its points as seen from `base`, and how far from there the others lie at most (m).
    pub(super) fn circle_around(&self, grid: &Grid, base: Point) -> (Point, f64) {
        // The very coordinates that the points have, so that none is left out by rounding.
        let (left, right) = (grid.x(self.columns.start) - base.x, grid.x(self.columns.end - 1) - base.x);
        let (low, high) = (grid.y(self.rows.start) - base.y, grid.y(self.rows.end - 1) - base.y);
        let (half_width, half_height) = ((right - left) / 2.0, (high - low) / 2.0);
        let radius = (half_width * half_width + half_height * half_height).sqrt();
        (Point::new(left + half_width, low + half_height), radius * (1.0 + 1e-12))
    }
}
