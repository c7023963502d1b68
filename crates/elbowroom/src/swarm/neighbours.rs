//! Which particle has the best personal best of a neighbourhood.

use std::collections::VecDeque;

use super::Value;

/// Whether particle `a` is better than `b`; of equal values the first particle's is.
fn better<V: Value>(values: &[V], a: usize, b: usize) -> bool {
    values[a].is_better(values[b]) || (!values[b].is_better(values[a]) && a < b)
}

/// The particle of the best value.
pub(super) fn best<V: Value>(values: &[V]) -> usize {
    (1..values.len())
        .fold(0, |least, particle| if values[particle].is_better(values[least]) { particle } else { least })
}

/// Writes for each particle of a ring the best of itself and the `k` on each side; needs `2 k < values.len()`.
///
/// `waiting` keeps those of the window that may yet be its best, the best first: one pass, whatever `k` is.
/// It needs room for all particles, or it takes it.
pub(super) fn ring_bests<V: Value>(
    values: &[V],
    k: usize,
    waiting: &mut VecDeque<usize>,
    bests: &mut [usize],
) {
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
