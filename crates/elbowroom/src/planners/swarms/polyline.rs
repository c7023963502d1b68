//! Particles that stand for configurations joined by straight turns.

use rand_chacha::ChaCha8Rng;
use rand_core::Rng;

use super::choice::Choice;
use crate::arm::PlanarArm;
use crate::path::turn_is_free;
use crate::scene::Scene;

/// Start, the configurations in a particle's coordinates, and goal, as its last coordinate chooses them.
pub(super) fn places(coordinates: &[f64], choice: &Choice) -> Vec<Vec<f64>> {
    let (chosen, inner) = coordinates.split_last().unwrap_or((&0.0, &[]));
    let [start, goal] = choice.pair(*chosen);
    let mut places = vec![start.clone()];
    places.extend(inner.chunks_exact(start.len()).map(<[f64]>::to_vec));
    places.push(goal.clone());
    places
}

/// `places`, if the arm may turn straight from each to the next.
pub(super) fn certified(scene: &Scene<PlanarArm>, places: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    places.windows(2).all(|pair| turn_is_free(scene, &pair[0], &pair[1])).then_some(places)
}

/// Coordinates of `count` particles with `vias` configurations each, on the straight turns from starts to goals and, one
/// after the other, ever farther from them.
pub(super) fn around_straight(
    choice: &Choice,
    vias: usize,
    count: usize,
    rng: &mut ChaCha8Rng,
) -> Vec<Vec<f64>> {
    let mut chosen = choice.coordinates().cycle();
    (0..count)
        .map(|i| {
            let coordinate = chosen.next().unwrap_or(0.0);
            let spread = 0.5 * i as f64 / count as f64;
            let [start, goal] = choice.pair(coordinate);
            let mut position = Vec::with_capacity(vias * start.len() + 1);
            for k in 1..=vias {
                let share = k as f64 / (vias + 1) as f64;
                for (j, range) in choice.ranges().iter().enumerate() {
                    let straight = start[j] + (goal[j] - start[j]) * share;
                    position.push(straight + spread * (range[1] - range[0]) * (unit(rng) - 0.5));
                }
            }
            position.push(coordinate);
            position
        })
        .collect()
}

/// In [0, 1).
pub(super) fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}
