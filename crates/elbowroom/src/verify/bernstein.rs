use std::array::from_fn;

/// Rounding of the change of basis: at most seven roundings of the sum of the terms' sizes.
const CONVERSION: f64 = 8.0 * f64::EPSILON;

/// Rounding of one halving: five averages, each off by half a last place of the greatest coefficient.
const HALVING: f64 = 3.0 * f64::EPSILON;

/// Binomial coefficients: `PASCAL[n][k]`.
const PASCAL: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 2.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 3.0, 3.0, 1.0, 0.0, 0.0],
    [1.0, 4.0, 6.0, 4.0, 1.0, 0.0],
    [1.0, 5.0, 10.0, 10.0, 5.0, 1.0],
];

/// A polynomial over an interval, by its `N` Bernstein coefficients: its values lie between the least and
/// the greatest of them, give or take `rounding`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bernstein<const N: usize> {
    /// The first and the last are the values at the ends of the interval.
    pub(super) coefficients: [f64; N],
    /// How far the exact coefficients may be from these.
    pub(super) rounding: f64,
    /// What a halving adds to `rounding`.
    step: f64,
}

impl<const N: usize> Bernstein<N> {
    /// The derivative of the given order of the polynomial with `terms` (the constant first), over
    /// [0, `duration`].
    ///
    /// `rounding` comes out infinite or not a number where the arithmetic overflows.
    pub(super) fn derivative(terms: &[f64; 6], order: usize, duration: f64) -> Self {
        let mut power = 1.0;
        let mut scaled = [0.0; N];
        for (k, scaled) in scaled.iter_mut().enumerate() {
            let factor: usize = (k + 1..=k + order).product();
            let term = terms[k + order];
            // 0 times a power that overflowed would not be a number.
            *scaled = if term == 0.0 { 0.0 } else { term * factor as f64 * power };
            power *= duration;
        }
        let coefficients: [f64; N] =
            from_fn(|i| (0..=i).map(|k| PASCAL[i][k] / PASCAL[N - 1][k] * scaled[k]).sum());
        let size: f64 = scaled.iter().map(|s| s.abs()).sum();
        let tiny = if size > 0.0 { f64::MIN_POSITIVE } else { 0.0 };
        let greatest = coefficients.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        Self { coefficients, rounding: CONVERSION * size + tiny, step: HALVING * greatest + tiny }
    }

    /// Whether nothing overflowed.
    pub(super) fn is_finite(&self) -> bool {
        self.rounding.is_finite() && self.coefficients.iter().all(|c| c.is_finite())
    }

    /// The sum of both polynomials, over the same interval.
    pub(super) fn plus(&self, other: &Self) -> Self {
        let coefficients = from_fn(|i| self.coefficients[i] + other.coefficients[i]);
        let rounding = self.rounding + other.rounding + self.step + other.step;
        Self { coefficients, rounding, step: self.step + other.step }
    }

    /// The polynomial of opposite sign.
    pub(super) fn negated(&self) -> Self {
        Self { coefficients: self.coefficients.map(|c| -c), ..*self }
    }

    /// The polynomial over the first and the second half of the interval.
    pub(super) fn halves(&self) -> [Self; 2] {
        let mut right = self.coefficients;
        let mut left = [0.0; N];
        for (i, left) in left.iter_mut().enumerate() {
            *left = right[0];
            for j in 0..N - 1 - i {
                right[j] = 0.5 * (right[j] + right[j + 1]);
            }
        }
        // The averages went down the array, so what is left of each round stands in its place from the end.
        let rounding = self.rounding + self.step;
        [left, right].map(|coefficients| Self { coefficients, rounding, step: self.step })
    }

    /// The value at `fraction` of the interval.
    pub(super) fn value(&self, fraction: f64) -> f64 {
        let mut row = self.coefficients;
        for last in (0..N - 1).rev() {
            for j in 0..=last {
                row[j] += fraction * (row[j + 1] - row[j]);
            }
        }
        row[0]
    }

    /// How far any value over the interval can be from `center`.
    pub(super) fn deviation(&self, center: f64) -> f64 {
        self.coefficients.iter().fold(0.0, |most: f64, c| most.max((c - center).abs())) + self.rounding
    }

    /// The least and the greatest coefficient.
    pub(super) fn hull(&self) -> [f64; 2] {
        self.coefficients
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &c| [low.min(c), high.max(c)])
    }

    /// Whether the coefficients go up only, or down only: then so does the polynomial.
    pub(super) fn is_monotone(&self) -> bool {
        self.coefficients.is_sorted() || self.coefficients.is_sorted_by(|a, b| a >= b)
    }
}
