/// The last of Newton's steps towards a root, as a share of the stretch: the next would be about the square of it, and at
/// a turning point the value changes by the square of that.
const NEAR_ENOUGH: f64 = 1e-6;

/// Steps after which a root is taken as it is; each at least halves the last one.
const MOST_STEPS: u32 = 60;

/// Greatest sizes over [0, `end`] of the first, second and third derivative of the polynomial with these coefficients,
/// the constant first.
///
/// Between neighbouring roots of its derivative a polynomial is monotone, so there is one root of its own at most, and
/// the ends tell whether: degree by degree, from the fourth derivative, a straight line, to the second.
pub(super) fn peaks(position: &[f64; 6], end: f64) -> [f64; 3] {
    let velocity: [f64; 5] = derivative(position);
    let acceleration: [f64; 4] = derivative(&velocity);
    let jerk: [f64; 3] = derivative(&acceleration);
    let snap: [f64; 2] = derivative(&jerk);
    let jerk_turns = roots(&snap, &Places::default(), end);
    let acceleration_turns = roots(&jerk, &jerk_turns, end);
    let velocity_turns = roots(&acceleration, &acceleration_turns, end);
    [
        greatest(&velocity, &velocity_turns, end),
        greatest(&acceleration, &acceleration_turns, end),
        greatest(&jerk, &jerk_turns, end),
    ]
}

/// Places between the ends of the stretch, ascending: a cubic has three roots at most.
#[derive(Default)]
struct Places {
    at: [f64; 3],
    count: usize,
}

impl Places {
    fn iter(&self) -> impl Iterator<Item = f64> {
        self.at.into_iter().take(self.count)
    }
}

fn derivative<const N: usize, const M: usize>(coefficients: &[f64; N]) -> [f64; M] {
    std::array::from_fn(|k| coefficients[k + 1] * (k + 1) as f64)
}

/// Greatest size of a polynomial that turns at `turns`.
fn greatest<const N: usize>(coefficients: &[f64; N], turns: &Places, end: f64) -> f64 {
    let places = [0.0, end].into_iter().chain(turns.iter());
    places.map(|s| value_and_slope(coefficients, s)[0].abs()).fold(0.0, f64::max)
}

/// Roots in (0, `end`) of a polynomial that turns at `turns`; one that is 0 everywhere has none here.
fn roots<const N: usize>(coefficients: &[f64; N], turns: &Places, end: f64) -> Places {
    let mut found = Places::default();
    let mut low = 0.0;
    for high in turns.iter().chain([end]) {
        if let Some(root) = root_between(coefficients, low, high, NEAR_ENOUGH * end)
            && found.count < found.at.len()
        {
            found.at[found.count] = root;
            found.count += 1;
        }
        low = high;
    }
    found
}

/// Newton's steps from the middle, halving where they leave the bracket or do not get smaller fast enough.
fn root_between<const N: usize>(
    coefficients: &[f64; N],
    mut low: f64,
    mut high: f64,
    near: f64,
) -> Option<f64> {
    let rising = value_and_slope(coefficients, low)[0] < 0.0;
    if rising == (value_and_slope(coefficients, high)[0] < 0.0) {
        return None;
    }
    let mut root = 0.5 * (low + high);
    let mut last_step = high - low;
    for _ in 0..MOST_STEPS {
        let [value, slope] = value_and_slope(coefficients, root);
        if (value < 0.0) == rising {
            low = root;
        } else {
            high = root;
        }
        let newton = root - value / slope;
        let sound = low <= newton && newton <= high && 2.0 * (newton - root).abs() < last_step;
        let next = if sound { newton } else { 0.5 * (low + high) };
        last_step = (next - root).abs();
        root = next;
        if sound && last_step <= near {
            break;
        }
    }
    Some(root)
}

fn value_and_slope<const N: usize>(coefficients: &[f64; N], s: f64) -> [f64; 2] {
    coefficients.iter().rev().fold([0.0; 2], |[value, slope], c| [value * s + c, slope * s + value])
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::{Rng, SeedableRng};

    use super::peaks;

    /// The size of a derivative, term by term.
    fn size(position: &[f64; 6], order: usize, s: f64) -> f64 {
        let factor = |k: usize| (k + 1 - order..=k).product::<usize>() as f64;
        (order..6).map(|k| position[k] * factor(k) * s.powi((k - order) as i32)).sum::<f64>().abs()
    }

    #[test]
    fn no_sample_is_above_and_some_sample_is_near() {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        for case in 0..5_000 {
            let mut unit = || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
            let end = 1e-3 + 3.0 * unit();
            let mut position = [0.0; 6].map(|_| 2.0 * unit() - 1.0);
            // Double roots, straight lines, and coefficients of very different size.
            match case % 5 {
                0 => position[3..].fill(0.0),
                1 => position[4..].fill(0.0),
                2 => position = [0.0, 0.0, end * end / 2.0, -end * 2.0 / 3.0, 0.25, 0.0],
                3 => position.iter_mut().for_each(|c| *c *= libm::exp(20.0 * unit() - 10.0)),
                _ => {}
            }
            let found = peaks(&position, end);
            for (order, peak) in (1..).zip(found) {
                let samples = (0..=2_000).map(|i| size(&position, order, end * f64::from(i) / 2_000.0));
                let most = samples.fold(0.0, f64::max);
                assert!(most <= peak * (1.0 + 1e-12) + 1e-300, "case {case}, {order}: {most} > {peak}");
                assert!(peak <= most * (1.0 + 1e-4) + 1e-12, "case {case}, {order}: {peak} > {most}");
            }
        }
        assert_eq!(peaks(&[0.0; 6], 1.0), [0.0; 3]);
    }
}
