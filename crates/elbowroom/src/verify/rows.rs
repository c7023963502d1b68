//! Rows of a trajectory from elsewhere: what their digits and spacing tell of the motion they are taken from.

use super::rate::Quantity;
use crate::trajectory::{Curve, Piece};

/// Rows no farther apart than this (s) count as samples of some motion, and what is taken between them as a guess at it. Rows
/// farther apart are via points: what is taken between them is what a controller runs.
pub const SAMPLED: f64 = 0.02;

/// So many pieces as short as that make samples.
const FEWEST_SAMPLED: usize = 8;

/// How unequal the spacing of even rows may be, as a share of it; the rounding of times may add to it.
const UNEVEN: f64 = 1e-9;

/// How far from what was meant a number with all the digits of a double may be, as a share of it.
const DOUBLE: f64 = 4.0 * f64::EPSILON;

/// How the rows were written that a motion interpolates: a piece between each two.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows {
    /// What is taken between them; `None` where that differs: then only the tolerance counts.
    pub curve: Option<Curve>,
    /// To multiples of what positions, velocities and accelerations are rounded, per joint (rad, rad/s, rad/s²); 0 where they have
    /// all the digits of a double.
    pub quanta: Vec<[f64; 3]>,
    /// To multiples of what times are rounded (s); 0 where they are exact.
    pub time_quantum: f64,
    /// By what share motion limits may be exceeded.
    pub tolerance: f64,
}

/// What is known of the rows of one joint.
pub(super) struct Column<'a> {
    pub(super) curve: Curve,
    pub(super) times: Vec<f64>,
    /// Positions, velocities and accelerations as far as the rows state them, and how far each may be off.
    pub(super) series: Vec<Vec<(f64, f64)>>,
    pub(super) quanta: [f64; 3],
    pub(super) pieces: &'a [&'a Piece],
    /// Whether the pieces that are short enough are guesses.
    pub(super) sampled: bool,
}

impl<'a> Column<'a> {
    /// Of joint `j` (from 0); the pieces are one or more.
    pub(super) fn of(rows: &Rows, curve: Curve, pieces: &'a [&'a Piece], j: usize) -> Self {
        let quanta = rows.quanta.get(j).copied().unwrap_or([0.0; 3]);
        let sampled = is_sampled(curve, pieces, rows.time_quantum);
        let mut times: Vec<f64> = pieces.iter().map(|piece| piece.start).collect();
        let stated = 1 + match curve {
            Curve::Linear => 0,
            Curve::Cubic => 1,
            Curve::Quintic => 2,
        };
        let mut values: Vec<Vec<f64>> =
            (0..stated).map(|order| pieces.iter().map(|piece| at(piece, j, order, 0.0)).collect()).collect();
        if let Some(last) = pieces.last() {
            times.push(last.start + last.duration);
            for (order, values) in values.iter_mut().enumerate() {
                values.push(at(last, j, order, last.duration));
            }
        }
        // What comes of arithmetic is off by last places of the greatest numbers in it.
        let greatest: Vec<f64> = values
            .iter()
            .map(|values| values.iter().fold(0.0, |most: f64, value| most.max(value.abs())))
            .collect();
        let clock = 0.5 * rows.time_quantum;
        let off = |order: usize, i: usize| {
            let digits = 0.5 * quanta[order] + if sampled { DOUBLE * greatest[order] } else { 0.0 };
            // A time that is off is as much as a value that is off by what it changes in between.
            let slope =
                |a: usize, b: usize| ((values[order][b] - values[order][a]) / (times[b] - times[a])).abs();
            let before = if i > 0 { slope(i - 1, i) } else { 0.0 };
            let after = if i + 1 < times.len() { slope(i, i + 1) } else { 0.0 };
            digits + if clock > 0.0 { clock * before.max(after) } else { 0.0 }
        };
        let series = (0..stated)
            .map(|order| (0..times.len()).map(|i| (values[order][i], off(order, i))).collect())
            .collect();
        Self { curve, times, series, quanta, pieces, sampled }
    }

    /// Whether what is taken over piece `i` is a guess at what was sampled.
    pub(super) fn is_guess(&self, i: usize) -> bool {
        self.sampled && is_short(self.pieces[i])
    }

    /// How far rounding may have put a rate, or the position, anywhere in piece `i` of the curve: the greatest sum of what
    /// the Hermite basis makes of the errors of both rows. And which quantity contributes the most.
    pub(super) fn spread(&self, i: usize, order: usize) -> (f64, Quantity) {
        let h = self.pieces[i].duration;
        let mut worst = (0.0, Quantity::Position);
        let mut sum = 0.0;
        for (k, what) in
            [Quantity::Position, Quantity::Velocity, Quantity::Acceleration].into_iter().enumerate()
        {
            let Some(series) = self.series.get(k) else { continue };
            let off = series[i].1.max(series[i + 1].1);
            let grown = (order..k).fold(off, |off, _| off * h);
            let scaled = (k..order).fold(grown, |off, _| off / h);
            let part = HERMITE[self.series.len() - 1][order][k] * scaled;
            sum += part;
            if part > worst.0 {
                worst = (part, what);
            }
        }
        (sum, worst.1)
    }
}

/// The greatest sum of the absolute derivatives of both basis functions over an interval of length 1: for linear, cubic and
/// quintic curves, by the order of the derivative, of positions, velocities and accelerations. Rounded up; a test compares.
pub(super) const HERMITE: [[[f64; 3]; 4]; 3] = [
    [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
    [[1.0, 0.25, 0.0], [3.0, 1.0, 0.0], [12.0, 6.0, 0.0], [24.0, 12.0, 0.0]],
    [[1.0, 0.3125, 0.03125], [3.75, 1.0, 0.0963], [11.5471, 5.7736, 1.0], [120.0, 60.0, 12.0]],
];

fn at(piece: &Piece, j: usize, order: usize, s: f64) -> f64 {
    let terms = piece.coefficients[j];
    (order..6).rev().fold(0.0, |sum, k| {
        let factor: usize = (k + 1 - order..=k).product();
        sum * s + terms[k] * factor as f64
    })
}

fn is_short(piece: &Piece) -> bool {
    piece.duration <= SAMPLED * (1.0 + 1e-6)
}

/// Whether there are enough short pieces; with accelerations, which make the curve known where rows stand at all knots of the
/// motion, only if they are evenly long, but for the first and the last.
fn is_sampled(curve: Curve, pieces: &[&Piece], time_quantum: f64) -> bool {
    let short: Vec<f64> = pieces.iter().filter(|piece| is_short(piece)).map(|piece| piece.duration).collect();
    if short.len() < FEWEST_SAMPLED || curve != Curve::Quintic {
        return short.len() >= FEWEST_SAMPLED;
    }
    let inner = &pieces[1..pieces.len() - 1];
    let lengths = || inner.iter().map(|piece| piece.duration);
    let [least, most] = [lengths().fold(f64::INFINITY, f64::min), lengths().fold(0.0, f64::max)];
    // The start of a piece is as exact as a double of its size.
    let clock = pieces.last().map_or(0.0, |last| DOUBLE * (last.start.abs() + last.duration));
    most - least <= UNEVEN * most + 1.01 * time_quantum + clock
}

#[cfg(test)]
mod tests {
    use super::HERMITE;
    use crate::trajectory::{Samples, interpolate};

    /// What one wrong number at an end of a piece of length 1 makes of each derivative, at 2001 places.
    #[test]
    fn errors_spread_as_the_basis_functions_do() {
        for stated in 1..=3 {
            for quantity in 0..stated {
                let curves = [0, 1].map(|end| {
                    let rows = |k: usize| {
                        let row = |i: usize| vec![if k == quantity && i == end { 1.0 } else { 0.0 }];
                        vec![row(0), row(1)]
                    };
                    let samples = Samples {
                        times: vec![0.0, 1.0],
                        positions: rows(0),
                        velocities: (stated > 1).then(|| rows(1)),
                        accelerations: (stated > 2).then(|| rows(2)),
                    };
                    interpolate(&samples).expect("two rows").motion.pieces()[0].clone()
                });
                for (order, row) in HERMITE[stated - 1].iter().enumerate() {
                    let sum = |s: f64| -> f64 {
                        curves.iter().map(|piece| super::at(piece, 0, order, s).abs()).sum()
                    };
                    let most = (0..=2000).map(|i| sum(f64::from(i) / 2000.0)).fold(0.0, f64::max);
                    let told = row[quantity];
                    assert!(
                        most <= told + 1e-12 && told <= most * 1.001 + 1e-12,
                        "{stated} {quantity} {order}: {most}, {told}"
                    );
                }
            }
        }
    }
}
