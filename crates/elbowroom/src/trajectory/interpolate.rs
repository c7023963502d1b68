use thiserror::Error;

use super::{Motion, MotionError, Piece, State};

/// The most rows that are read.
pub const MAX_ROWS: usize = 1_000_000;

/// Joint positions at instants, with velocities and accelerations where they are known.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples<const DOF: usize> {
    /// Since the start (s), ascending.
    pub times: Vec<f64>,
    /// One per time (rad).
    pub positions: Vec<[f64; DOF]>,
    /// One per time (rad/s), or unknown.
    pub velocities: Option<Vec<[f64; DOF]>>,
    /// One per time (rad/s²), or unknown; of use only beside velocities.
    pub accelerations: Option<Vec<[f64; DOF]>>,
}

/// The curve taken between two samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    /// A number is infinite or not a number.
    #[error("row {row} has a number that is not finite")]
    NotFinite {
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

/// The motion through `samples`, with the curves that ROS 2's joint trajectory controller would run between them:
/// quintic where velocities and accelerations are known, cubic with velocities alone, else linear.
///
/// # Errors
/// [`SamplesError`] names the first row at fault.
pub fn interpolate<const DOF: usize>(samples: &Samples<DOF>) -> Result<(Motion<DOF>, Curve), SamplesError> {
    check(samples)?;
    let curve = match (&samples.velocities, &samples.accelerations) {
        (Some(_), Some(_)) => Curve::Quintic,
        (Some(_), None) => Curve::Cubic,
        (None, _) => Curve::Linear,
    };
    if let [start] = samples.times[..] {
        let coefficients = samples.positions[0].map(|position| [position, 0.0, 0.0, 0.0, 0.0, 0.0]);
        return Ok((Motion::new(vec![Piece { start, duration: 0.0, coefficients }])?, curve));
    }
    let state = |i: usize| State {
        position: samples.positions[i],
        velocity: samples.velocities.as_ref().map_or([0.0; DOF], |velocities| velocities[i]),
        acceleration: samples.accelerations.as_ref().map_or([0.0; DOF], |accelerations| accelerations[i]),
        jerk: [0.0; DOF],
    };
    let pieces = (1..samples.times.len())
        .map(|i| {
            let (start, duration) = (samples.times[i - 1], samples.times[i] - samples.times[i - 1]);
            let (from, to) = (state(i - 1), state(i));
            match curve {
                Curve::Quintic => Piece::quintic(start, duration, &from, &to),
                Curve::Cubic => cubic(start, duration, &from, &to),
                Curve::Linear => linear(start, duration, &from, &to),
            }
        })
        .collect();
    Ok((Motion::new(pieces)?, curve))
}

fn check<const DOF: usize>(samples: &Samples<DOF>) -> Result<(), SamplesError> {
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
    for row in 0..rows {
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

fn linear<const DOF: usize>(start: f64, duration: f64, from: &State<DOF>, to: &State<DOF>) -> Piece<DOF> {
    let coefficients = std::array::from_fn(|j| {
        let slope = (to.position[j] - from.position[j]) / duration;
        [from.position[j], slope, 0.0, 0.0, 0.0, 0.0]
    });
    Piece { start, duration, coefficients }
}

fn cubic<const DOF: usize>(start: f64, duration: f64, from: &State<DOF>, to: &State<DOF>) -> Piece<DOF> {
    let coefficients = std::array::from_fn(|j| {
        let slope = (to.position[j] - from.position[j]) / duration;
        let (v0, v1) = (from.velocity[j], to.velocity[j]);
        let c2 = (3.0 * slope - 2.0 * v0 - v1) / duration;
        let c3 = (v0 + v1 - 2.0 * slope) / duration / duration;
        [from.position[j], v0, c2, c3, 0.0, 0.0]
    });
    Piece { start, duration, coefficients }
}
