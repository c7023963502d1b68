/// Greatest absolute value of the polynomial with these coefficients, the constant first, over [0, `end`].
///
/// Between neighbouring roots of its derivative a polynomial is monotone, so bisection finds its own root
/// there, if there is one: degree by degree, from the constant derivative up.
pub(super) fn peak(coefficients: &[f64], end: f64) -> f64 {
    let mut turns = vec![0.0, end];
    turns.extend(roots(&derivative(coefficients), end));
    turns.into_iter().map(|s| value(coefficients, s).abs()).fold(0.0, f64::max)
}

/// Coefficients of the derivative.
pub(super) fn derivative(coefficients: &[f64]) -> Vec<f64> {
    coefficients.iter().enumerate().skip(1).map(|(k, c)| c * k as f64).collect()
}

/// Roots in (0, `end`), ascending; the polynomial that is 0 everywhere has none here.
fn roots(coefficients: &[f64], end: f64) -> Vec<f64> {
    if coefficients.len() < 2 {
        return Vec::new();
    }
    let mut knots = vec![0.0];
    knots.extend(roots(&derivative(coefficients), end));
    knots.push(end);
    knots.windows(2).filter_map(|knot| root_between(coefficients, knot[0], knot[1])).collect()
}

fn root_between(coefficients: &[f64], mut low: f64, mut high: f64) -> Option<f64> {
    let rising = value(coefficients, low) < 0.0;
    if rising == (value(coefficients, high) < 0.0) {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (value(coefficients, middle) < 0.0) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

fn value(coefficients: &[f64], s: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
}
