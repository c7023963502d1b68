//! The box that a swarm searches.

use thiserror::Error;

/// The most coordinates that all particles of a swarm may have together.
pub const MAX_COORDINATES: usize = 1 << 24;

/// A closed box: one range for each dimension, in whatever unit the objective takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    min: Vec<f64>,
    max: Vec<f64>,
}

/// Why ranges make no box.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BoundsError {
    /// There is no dimension to search, or there are more than [`MAX_COORDINATES`].
    #[error("{found} dimensions, 1 to {MAX_COORDINATES} are allowed")]
    Dimensions {
        /// How many ranges were given.
        found: usize,
    },
    /// A range is reversed, or one of its ends or its width is infinite or not a number.
    #[error("dimension {dimension} ranges from {min} to {max}, it must be in order and of finite width")]
    Range {
        /// Which, from 0.
        dimension: usize,
        /// Its lower end.
        min: f64,
        /// Its upper end.
        max: f64,
    },
}

impl Bounds {
    /// The box with one `[min, max]` range for each dimension; where both ends are equal, nothing moves.
    ///
    /// # Errors
    /// [`BoundsError`] names the first thing that is wrong.
    pub fn new(ranges: &[[f64; 2]]) -> Result<Self, BoundsError> {
        if ranges.is_empty() || ranges.len() > MAX_COORDINATES {
            return Err(BoundsError::Dimensions { found: ranges.len() });
        }
        // Finite ends that are far apart may still have an infinite width.
        let wrong = |&[min, max]: &[f64; 2]| !(min <= max && (max - min).is_finite());
        if let Some(dimension) = ranges.iter().position(wrong) {
            let [min, max] = ranges[dimension];
            return Err(BoundsError::Range { dimension, min, max });
        }
        Ok(Self {
            min: ranges.iter().map(|range| range[0]).collect(),
            max: ranges.iter().map(|range| range[1]).collect(),
        })
    }

    /// How many coordinates a position has.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.min.len()
    }

    /// The lower ends.
    #[must_use]
    pub fn min(&self) -> &[f64] {
        &self.min
    }

    /// The upper ends.
    #[must_use]
    pub fn max(&self) -> &[f64] {
        &self.max
    }

    /// Whether a position is in the box, its faces included.
    #[must_use]
    pub fn contains(&self, position: &[f64]) -> bool {
        position.len() == self.dimensions()
            && position.iter().zip(&self.min).zip(&self.max).all(|((x, min), max)| min <= x && x <= max)
    }
}
