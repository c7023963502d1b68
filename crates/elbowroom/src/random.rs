//! Numbers drawn evenly, for all that searches at random: the same generator draws the same ones everywhere.

use rand_core::Rng;

/// A number in [0, 1).
pub(crate) fn unit(rng: &mut impl Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// A whole number below `count`, which is not 0.
pub(crate) fn below(rng: &mut impl Rng, count: usize) -> usize {
    ((unit(rng) * count as f64) as usize).min(count - 1)
}

/// A number from `min` up to `max`.
pub(crate) fn within(rng: &mut impl Rng, min: f64, max: f64) -> f64 {
    min + unit(rng) * (max - min)
}
