//! The least that a rate must reach in any motion through given rows.
//!
//! By the mean value theorem of divided differences, `n! f[t0, ..., tn]` is a mean of the n-th derivative over the interval,
//! weighted by a B-spline: somewhere the derivative is as great. Times may repeat where the first derivative is known. The
//! same holds for the rows of velocities and accelerations, of which the rate is a lower derivative.
//!
//! # Reference
//! De Boor, *A practical guide to splines*, chapters I and IX.

use super::rows::Column;

/// The greatest number of rows between those of a difference. Rounding counts the less the farther they are apart.
const WIDEST: usize = 64;

/// Rounding of a divided difference, as a share of the sum of its terms' sizes.
const ARITHMETIC: f64 = 32.0 * f64::EPSILON;

/// A rate that any motion through the rows must reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Least {
    /// Its absolute value, 0 where nothing is known.
    pub(super) value: f64,
    /// In the middle of the rows it is known from (s).
    pub(super) time: f64,
}

/// Of the rate of this order, 1 to 3.
pub(super) fn least_rate(column: &Column, order: usize) -> Least {
    let mut least = Least { value: 0.0, time: column.times.first().copied().unwrap_or(0.0) };
    let count = column.times.len();
    let mut stride = 1;
    while stride <= WIDEST && stride < count {
        let step = (stride / 4).max(1);
        for (k, series) in column.series.iter().enumerate().take(order + 1) {
            let nodes = order - k;
            for i in (0..count.saturating_sub(nodes * stride)).step_by(step) {
                let places: [usize; 4] = std::array::from_fn(|n| i + n.min(nodes) * stride);
                least.raise(&column.times, &places[..=nodes], |at| series[at]);
            }
        }
        if let [positions, velocities, ..] = column.series.as_slice() {
            for i in (0..count - stride).step_by(step) {
                least.raise_repeated(&column.times, positions, velocities, [i, i + stride], order);
            }
        }
        stride *= 2;
    }
    least
}

impl Least {
    fn propose(&mut self, value: f64, off: f64, size: f64, time: f64) {
        let value = value.abs() - off - ARITHMETIC * size;
        if value > self.value {
            *self = Self { value, time };
        }
    }

    /// The divided difference over these rows. A value that stands alone may have been cut off, not rounded.
    fn raise(&mut self, times: &[f64], places: &[usize], value: impl Fn(usize) -> (f64, f64)) {
        let (mut sum, mut off, mut size) = (0.0, 0.0, 0.0);
        let mut factor = if places.len() == 1 { 2.0 } else { 1.0 };
        for n in 1..places.len() {
            factor *= n as f64;
        }
        for &i in places {
            let mut weight = 1.0;
            for &other in places {
                if other != i {
                    weight /= times[i] - times[other];
                }
            }
            let (value, error) = value(i);
            sum += weight * value;
            off += weight.abs() * error;
            size += (weight * value).abs();
        }
        let scale = if places.len() == 1 { 1.0 } else { factor };
        let time = 0.5 * (times[places[0]] + times[places[places.len() - 1]]);
        self.propose(scale * sum, factor * off, scale * size, time);
    }

    /// Those over `[t0, t0, t1]` and `[t0, t1, t1]`, or `[t0, t0, t1, t1]`.
    fn raise_repeated(
        &mut self,
        times: &[f64],
        positions: &[(f64, f64)],
        velocities: &[(f64, f64)],
        [i, j]: [usize; 2],
        order: usize,
    ) {
        let h = times[j] - times[i];
        let time = times[i] + 0.5 * h;
        let slope = (positions[j].0 - positions[i].0) / h;
        let slope_off = (positions[j].1 + positions[i].1) / h;
        let slope_size = (positions[j].0.abs() + positions[i].0.abs()) / h;
        let ([v0, v1], [e0, e1]) = ([velocities[i].0, velocities[j].0], [velocities[i].1, velocities[j].1]);
        match order {
            2 => {
                for (v, off) in [(v0, e0), (v1, e1)] {
                    let scale = 2.0 / h;
                    self.propose(
                        scale * (slope - v),
                        scale * (slope_off + off),
                        scale * (slope_size + v.abs()),
                        time,
                    );
                }
            }
            3 => {
                let scale = 6.0 / (h * h);
                let size = 2.0 * slope_size + v0.abs() + v1.abs();
                self.propose(
                    scale * (v0 + v1 - 2.0 * slope),
                    scale * (e0 + e1 + 2.0 * slope_off),
                    scale * size,
                    time,
                );
            }
            _ => {}
        }
    }
}
