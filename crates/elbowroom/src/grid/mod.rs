//! A square grid of points over a rectangle.

use thiserror::Error;

use crate::geometry::Point;
use crate::units::{Told, Units};

/// The most points a grid may have; beyond it the maps would not fit in the memory of a common machine.
pub const MAX_POINTS: u64 = 1 << 25;

/// Why no grid has the asked shape.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum GridError {
    /// The step is not a positive finite length.
    #[error("{}", self.told(Units::SI))]
    Step {
        /// What was asked (m).
        step: f64,
    },
    /// A range is infinite, not a number, or ends before it begins.
    #[error("{}", self.told(Units::SI))]
    Range {
        /// `x` or `y`.
        axis: char,
        /// Where it begins (m).
        min: f64,
        /// Where it ends (m).
        max: f64,
    },
    /// More points than [`MAX_POINTS`].
    #[error(
        "{} x {} points are more than the {MAX_POINTS} allowed; make the step larger",
        in_digits(*columns),
        in_digits(*rows)
    )]
    TooManyPoints {
        /// Points along x; a rounded figure where it is huge.
        columns: f64,
        /// Points along y.
        rows: f64,
    },
}

impl Told for GridError {
    fn told(&self, units: Units) -> String {
        let length = |metres| units.stated_length(metres);
        match *self {
            Self::Step { step } => format!("step is {}, it must be finite and greater than 0", length(step)),
            Self::Range { axis, min, max } => format!(
                "range {axis} is {} to {}, it must be finite and must not end before it begins",
                length(min),
                length(max)
            ),
            Self::TooManyPoints { .. } => self.to_string(),
        }
    }
}

/// A whole number; one of hundreds of digits as a power of ten.
fn in_digits(count: f64) -> String {
    if count < 1e15 { count.to_string() } else { format!("{count:e}") }
}

/// Points at `origin + (column, row) * step`; both ends of a range belong to it where the step divides it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    origin: Point,
    step: f64,
    columns: usize,
    rows: usize,
}

impl Grid {
    /// The grid over the ranges `x` and `y`, each `[min, max]` (m).
    ///
    /// # Errors
    /// [`GridError`] for numbers that make no grid, or a grid of more than [`MAX_POINTS`] points.
    pub fn new(x: [f64; 2], y: [f64; 2], step: f64) -> Result<Self, GridError> {
        if !(step.is_finite() && step > 0.0) {
            return Err(GridError::Step { step });
        }
        let count = |axis: char, [min, max]: [f64; 2]| {
            let length = max - min;
            if !(length.is_finite() && length >= 0.0) {
                return Err(GridError::Range { axis, min, max });
            }
            // A range that is a whole number of steps must not lose its last point to the rounding of its ends,
            // which weighs the more the farther from 0 they are; nor may a quarter of a step become a point.
            let rounding = f64::EPSILON * (min.abs() + max.abs() + length) / step;
            Ok((length / step + rounding.min(0.25)).floor() + 1.0)
        };
        let (columns, rows) = (count('x', x)?, count('y', y)?);
        if columns * rows > MAX_POINTS as f64 {
            return Err(GridError::TooManyPoints { columns, rows });
        }
        Ok(Self { origin: Point::new(x[0], y[0]), step, columns: columns as usize, rows: rows as usize })
    }

    /// The point in column 0 and row 0: least x, least y.
    pub fn origin(&self) -> Point {
        self.origin
    }

    /// Distance between neighbours along an axis (m).
    pub fn step(&self) -> f64 {
        self.step
    }

    /// How many points lie along x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// How many points lie along y.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// How many points there are; a cell is a number below this, row after row.
    pub fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Never: a grid has at least one point.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The cell in `column` and `row`.
    pub fn cell(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    /// Column and row of `cell`.
    pub fn column_row(&self, cell: usize) -> (usize, usize) {
        (cell % self.columns, cell / self.columns)
    }

    /// Where `cell` lies.
    pub fn point(&self, cell: usize) -> Point {
        let (column, row) = self.column_row(cell);
        Point::new(self.x(column), self.y(row))
    }

    /// x of the points in `column` (m).
    pub fn x(&self, column: usize) -> f64 {
        self.origin.x + column as f64 * self.step
    }

    /// y of the points in `row` (m).
    pub fn y(&self, row: usize) -> f64 {
        self.origin.y + row as f64 * self.step
    }

    /// The cell nearest to `point`, or `None` when it lies more than half a step outside the grid.
    pub fn nearest(&self, point: Point) -> Option<usize> {
        let index = |offset: f64, count: usize| {
            let i = (offset / self.step).round();
            (i >= 0.0 && i < count as f64).then_some(i as usize)
        };
        let column = index(point.x - self.origin.x, self.columns)?;
        let row = index(point.y - self.origin.y, self.rows)?;
        Some(self.cell(column, row))
    }

    /// The corners of the square of the grid that `point` lies in: four, fewer at the grid's edge and
    /// outside it.
    pub fn corners(&self, point: Point) -> impl Iterator<Item = usize> + '_ {
        let column = ((point.x - self.origin.x) / self.step).floor();
        let row = ((point.y - self.origin.y) / self.step).floor();
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].into_iter().filter_map(move |(dx, dy)| {
            let within = |i: f64, count: usize| (i >= 0.0 && i < count as f64).then_some(i as usize);
            Some(self.cell(within(column + dx, self.columns)?, within(row + dy, self.rows)?))
        })
    }

    /// The neighbour of `cell` in `direction`, from 0 (along x) once round to 7 in eighths of a turn, or
    /// `None` past the edge of the grid. The way back is `(direction + 4) % 8`.
    pub fn neighbour(&self, cell: usize, direction: usize) -> Option<usize> {
        let (column, row) = self.column_row(cell);
        let (dx, dy) = OFFSETS[direction % 8];
        let column = column.checked_add_signed(dx).filter(|&c| c < self.columns)?;
        let row = row.checked_add_signed(dy).filter(|&r| r < self.rows)?;
        Some(self.cell(column, row))
    }

    /// Distance to a neighbour in `direction` (m): `step`, or `step * √2` on a diagonal.
    pub fn neighbour_distance(&self, direction: usize) -> f64 {
        if direction.is_multiple_of(2) { self.step } else { self.step * std::f64::consts::SQRT_2 }
    }

    /// The up to eight neighbours of `cell`, each with its distance (m).
    pub fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        (0..8).filter_map(move |direction| {
            Some((self.neighbour(cell, direction)?, self.neighbour_distance(direction)))
        })
    }
}

/// Columns and rows from a cell to its eight neighbours.
const OFFSETS: [(isize, isize); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
