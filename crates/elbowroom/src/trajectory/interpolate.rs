use thiserror::Error;

use super::piece::quintic;
use super::{Motion, MotionError, Piece};

/// The most rows that are read.
pub const MAX_ROWS: usize = 1_000_000;

/// Joint positions at instants, with velocities and accelerations where they are known.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// Since the start (s), ascending.
    pub times: Vec<f64>,
    /// One per time, a number per joint (rad).
    pub positions: Vec<Vec<f64>>,
    /// One per time (rad/s), or unknown; empty where a row has none.
    pub velocities: Option<Vec<Vec<f64>>>,
    /// One per time (rad/s²), or unknown; empty where a row has none. Of use only beside velocities.
    pub accelerations: Option<Vec<Vec<f64>>>,
}

/// The curve taken between two samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Curve {
    /// Straight in every joint: positions are known.
    Linear,
    /// Of degree three: velocities are known too.
    Cubic,
    /// Of degree five: accelerations are known too.
    Quintic,
}

impl Curve {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
        }
    }
}

/// Why samples make no motion. Rows count from 1.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SamplesError {
    /// None, or more than [`MAX_ROWS`].
    #[error("{found} rows, 1 to {MAX_ROWS} are allowed")]
    Rows {
        /// How many.
        found: usize,
    },
    /// Not as many of one thing as of another.
    #[error("{found} {what} for {rows} times")]
    Counts {
        /// `positions`, `velocities` or `accelerations`.
        what: &'static str,
        /// How many of it.
        found: usize,
        /// How many times.
        rows: usize,
    },
    /// A row has another number of joints than the first.
    #[error("row {row} has numbers for {found} joints, the first row for {joints}")]
    Joints {
        /// Which.
        row: usize,
        /// How many it has.
        found: usize,
        /// How many the first row has.
        joints: usize,
    },
    /// A number is infinite or not a number.
    #[error("row {row} has a number that is not finite")]
    NotFinite {
        /// Which.
        row: usize,
    },
    /// The arm moves at an end by the velocities stated there, which no curve takes: the row beside it has none.
    #[error(
        "row {row} states velocities that are not 0, the row beside it states none, so that the curve between them is linear; \
         give velocities in both rows, or in none"
    )]
    EndVelocity {
        /// Which.
        row: usize,
    },
    /// A time is not after the one before it.
    #[error("row {row} is at {time} s, which is not after the {before} s of the row before")]
    Times {
        /// Which.
        row: usize,
        /// Its time (s).
        time: f64,
        /// The time before (s).
        before: f64,
    },
    /// The polynomials between rows overflow.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// Samples as a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolated {
    /// The motion.
    pub motion: Motion,
    /// The curve of the first piece and that of the last.
    pub ends: [Curve; 2],
    /// The least of all curves, by what is known of both rows.
    pub least: Curve,
}

/// The motion through `samples`, with the curves that ROS 2's joint trajectory controller would run between them:
/// quintic between rows of which velocities and accelerations are known, cubic with velocities alone, else linear.
///
/// # Errors
/// [`SamplesError`] names the first row at fault.
pub fn interpolate(samples: &Samples) -> Result<Interpolated, SamplesError> {
    check(samples)?;
    if let [start] = samples.times[..] {
        let standing = |&position: &f64| [position, 0.0, 0.0, 0.0, 0.0, 0.0];
        let coefficients = samples.positions[0].iter().map(standing).collect();
        let motion = Motion::new(vec![Piece { start, duration: 0.0, coefficients }])?;
        let curve = samples.known(0);
        return Ok(Interpolated { motion, ends: [curve; 2], least: curve });
    }
    let of = |values: &Option<Vec<Vec<f64>>>, i: usize, j: usize| {
        values.as_ref().and_then(|values| values[i].get(j)).copied().unwrap_or(0.0)
    };
    let state = |i: usize, j: usize| {
        [samples.positions[i][j], of(&samples.velocities, i, j), of(&samples.accelerations, i, j)]
    };
    let curve = |i: usize| samples.known(i - 1).min(samples.known(i));
    let joints = samples.positions[0].len();
    let pieces = (1..samples.times.len())
        .map(|i| {
            let between = match curve(i) {
                Curve::Quintic => quintic,
                Curve::Cubic => cubic,
                Curve::Linear => linear,
            };
            let (start, duration) = (samples.times[i - 1], samples.times[i] - samples.times[i - 1]);
            let coefficients = (0..joints).map(|j| between(state(i - 1, j), state(i, j), duration)).collect();
            Piece { start, duration, coefficients }
        })
        .collect();
    let last = samples.times.len() - 1;
    for (row, beside) in [(0, 1), (last, last)] {
        let moves = || (0..joints).any(|j| of(&samples.velocities, row, j) != 0.0);
        if curve(beside) == Curve::Linear && moves() {
            return Err(SamplesError::EndVelocity { row: row + 1 });
        }
    }
    let least = (1..=last).map(curve).min().unwrap_or(Curve::Linear);
    Ok(Interpolated { motion: Motion::new(pieces)?, ends: [curve(1), curve(last)], least })
}

impl Samples {
    /// The best curve that what is known of this row serves for.
    fn known(&self, row: usize) -> Curve {
        let has =
            |values: &Option<Vec<Vec<f64>>>| values.as_ref().is_some_and(|values| !values[row].is_empty());
        match (has(&self.velocities), has(&self.accelerations)) {
            (true, true) => Curve::Quintic,
            (true, false) => Curve::Cubic,
            (false, _) => Curve::Linear,
        }
    }
}

fn check(samples: &Samples) -> Result<(), SamplesError> {
    let rows = samples.times.len();
    if !(1..=MAX_ROWS).contains(&rows) {
        return Err(SamplesError::Rows { found: rows });
    }
    let known = [
        ("positions", Some(&samples.positions)),
        ("velocities", samples.velocities.as_ref()),
        ("accelerations", samples.accelerations.as_ref()),
    ];
    for (what, values) in known {
        if let Some(values) = values
            && values.len() != rows
        {
            return Err(SamplesError::Counts { what, found: values.len(), rows });
        }
    }
    let joints = samples.positions[0].len();
    for row in 0..rows {
        for (what, values) in known {
            if let Some(values) = values
                && values[row].len() != joints
                && (what == "positions" || !values[row].is_empty())
            {
                return Err(SamplesError::Joints { row: row + 1, found: values[row].len(), joints });
            }
        }
        let finite =
            known.iter().filter_map(|(_, values)| *values).all(|v| v[row].iter().all(|x| x.is_finite()));
        if !(finite && samples.times[row].is_finite()) {
            return Err(SamplesError::NotFinite { row: row + 1 });
        }
        if row > 0 && samples.times[row] <= samples.times[row - 1] {
            let (time, before) = (samples.times[row], samples.times[row - 1]);
            return Err(SamplesError::Times { row: row + 1, time, before });
        }
    }
    Ok(())
}

fn linear([q0, ..]: [f64; 3], [q1, ..]: [f64; 3], duration: f64) -> [f64; 6] {
    [q0, (q1 - q0) / duration, 0.0, 0.0, 0.0, 0.0]
}

fn cubic([q0, v0, _]: [f64; 3], [q1, v1, _]: [f64; 3], duration: f64) -> [f64; 6] {
    let slope = (q1 - q0) / duration;
    let c2 = (3.0 * slope - 2.0 * v0 - v1) / duration;
    let c3 = (v0 + v1 - 2.0 * slope) / duration / duration;
    [q0, v0, c2, c3, 0.0, 0.0]
}
