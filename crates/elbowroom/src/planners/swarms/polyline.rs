//! Particles that stand for configurations joined by straight turns.

use rand_chacha::ChaCha8Rng;

use super::endpoint_choice::EndpointChoice;
use crate::arm::Configuration;
use crate::path::straight_move_is_free;
use crate::random::unit;
use crate::scene::Scene;

/// Start, the configurations in a particle's coordinates, and goal, as its last coordinate chooses them.
pub(in crate::planners) fn places(coordinates: &[f64], choice: &EndpointChoice) -> Vec<Configuration> {
    let (chosen, inner) = coordinates.split_last().unwrap_or((&0.0, &[]));
    let [start, goal] = choice.pair(*chosen);
    let mut places = vec![start.clone()];
    places.extend(inner.chunks_exact(start.len()).map(Configuration::from));
    places.push(goal.clone());
    places
}

/// `places`, if the arm may turn straight from each to the next.
pub(in crate::planners) fn certified(
    scene: &Scene,
    places: Vec<Configuration>,
) -> Option<Vec<Configuration>> {
    places.windows(2).all(|pair| straight_move_is_free(scene, &pair[0], &pair[1])).then_some(places)
}

/// Coordinates of `count` particles with `vias` configurations each, on the straight turns from starts to goals and, one
/// after the other, ever farther from them.
pub(in crate::planners) fn around_straight(
    choice: &EndpointChoice,
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
