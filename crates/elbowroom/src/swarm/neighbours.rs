//! Which particle has the best personal best of a neighbourhood.

use std::collections::VecDeque;

/// Whether particle `a` is better than `b`; of equal values the first particle's is.
fn better(values: &[f64], a: usize, b: usize) -> bool {
    values[a] < values[b] || (values[a] == values[b] && a < b)
}

/// The particle of the least value; no value may be NaN.
pub(super) fn best(values: &[f64]) -> usize {
    (1..values.len())
        .fold(0, |least, particle| if values[particle] < values[least] { particle } else { least })
}

/// Writes for each particle of a ring the best of itself and the `k` on each side; needs `2 k < values.len()`.
///
/// `waiting` keeps those of the window that may yet be its best, the best first: one pass, whatever `k` is.
/// It needs room for all particles, or it takes it.
pub(super) fn ring_bests(values: &[f64], k: usize, waiting: &mut VecDeque<usize>, bests: &mut [usize]) {
    let particles = values.len();
    waiting.clear();
    // Places count on from the first particle's leftmost neighbour; place `p` is particle `p - k`.
    let particle = |place: usize| (place + particles - k) % particles;
    for place in 0..particles + 2 * k {
        while waiting.back().is_some_and(|&last| better(values, particle(place), particle(last))) {
            waiting.pop_back();
        }
        waiting.push_back(place);
        let Some(centre) = place.checked_sub(2 * k) else { continue };
        if waiting.front().is_some_and(|&first| first < centre) {
            waiting.pop_front();
        }
        if let Some(&first) = waiting.front() {
            bests[centre] = particle(first);
        }
    }
}
