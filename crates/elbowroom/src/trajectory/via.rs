use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// `count` different places between the ends of a path of `places` places, drawn at random, in order, with
/// the first and the last place around them; all places when there are not as many.
pub fn random_vias(places: usize, count: usize, seed: u64) -> Vec<usize> {
    let inner = places.saturating_sub(2);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut left = count.min(inner);
    let mut chosen = Vec::with_capacity(left + 2);
    chosen.extend((places > 0).then_some(0));
    // Selection sampling: each place is taken with the chance that keeps every subset equally likely.
    for place in 1..=inner {
        let remaining = (inner + 1 - place) as u64;
        if left > 0 && uniform_below(&mut rng, remaining) < left as u64 {
            chosen.push(place);
            left -= 1;
        }
    }
    chosen.extend((places > 1).then(|| places - 1));
    chosen
}

/// A whole number below `bound`; the bias of the product is below 2⁻³² for the bounds of paths.
fn uniform_below(rng: &mut ChaCha8Rng, bound: u64) -> u64 {
    ((u128::from(rng.next_u64()) * u128::from(bound)) >> 64) as u64
}
