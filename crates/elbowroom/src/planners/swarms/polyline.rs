//! Particles that stand for configurations joined by straight joint motions.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::endpoint_choice::EndpointChoice;
use super::incumbent::{Incumbent, Stagnation};
use super::path_objective::PathObjective;
use crate::arm::Configuration;
use crate::path::{JointPath, straight_move_is_free};
use crate::planning::{Candidate, Found, PathToFollow, Pick, PlanError, Problem, Stage};
use crate::random::unit;
use crate::scene::Scene;
use crate::swarm::{Fitness, Swarm, SwarmSettings};

/// How a swarm over configurations joined by straight moves is set.
pub(in crate::planners) struct PolylineSwarm {
    /// How many configurations lie between start and goal.
    pub(in crate::planners) vias: usize,
    /// How many candidates may be judged.
    pub(in crate::planners) evaluations: usize,
    pub(in crate::planners) swarm: SwarmSettings,
}

/// The best path that such swarms find, one after the other until the evaluations are spent: each begins at `first` and has `shape`
/// put to every velocity.
///
/// # Errors
/// [`PlanError`], in the name of `planner`.
pub(in crate::planners) fn search_polylines(
    problem: &Problem<'_>,
    planner: &str,
    PolylineSwarm { vias, evaluations, swarm: swarm_settings }: &PolylineSwarm,
    mut first: impl FnMut(&EndpointChoice, &PathObjective<'_>, &mut ChaCha8Rng) -> Vec<Vec<f64>>,
    mut shape: impl FnMut(&mut [f64]),
) -> Result<Found, PlanError> {
    let Problem { scene, endpoints, settings, monitor, .. } = problem;
    let bad = |reason: String| PlanError::BadSettings { planner: planner.to_owned(), reason };
    monitor.stage(Stage::JointPath);
    let choice = EndpointChoice::new(scene.arm(), endpoints);
    let path_objective = PathObjective::new(scene, settings.objective, endpoints.keep_posture);
    let mut incumbent: Incumbent<'_, Vec<Configuration>> = Incumbent::new(*evaluations, *monitor);
    let bounds = choice.bounds(*vias, &[]).map_err(|error| bad(error.to_string()))?;
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
    while !incumbent.is_over() {
        let first = first(&choice, &path_objective, &mut rng);
        let mut swarm = Swarm::<Fitness>::starting_at(&bounds, swarm_settings, &first, rng.next_u64())
            .map_err(|error| bad(error.to_string()))?;
        let mut stagnation = Stagnation::new();
        while !incumbent.is_over() && stagnation.lasts(swarm.best().1) {
            let mut objective = |x: &[f64]| {
                let places = places(x, &choice);
                incumbent.evaluate(
                    || path_objective.violation(&places),
                    || path_objective.cost(&places),
                    || certified(scene, places.clone()),
                )
            };
            swarm.step_shaped(&mut objective, &mut shape);
        }
    }
    let (places, effort) = incumbent.end()?;
    let path = PathToFollow::closely(JointPath(places));
    Ok(Found::new(vec![Candidate::certified(path)], Pick::First).with_effort(effort))
}

/// Start, the configurations in a particle's coordinates, and goal, as its last coordinate chooses them.
fn places(coordinates: &[f64], choice: &EndpointChoice) -> Vec<Configuration> {
    let (chosen, inner) = coordinates.split_last().unwrap_or((&0.0, &[]));
    let [start, goal] = choice.pair(*chosen);
    let mut places = vec![start.clone()];
    places.extend(inner.chunks_exact(start.len()).map(Configuration::from));
    places.push(goal.clone());
    places
}

/// `places`, if the arm may turn straight from each to the next.
fn certified(scene: &Scene, places: Vec<Configuration>) -> Option<Vec<Configuration>> {
    places.windows(2).all(|pair| straight_move_is_free(scene, &pair[0], &pair[1])).then_some(places)
}

/// Coordinates of `count` particles with `vias` configurations each, on the straight joint motions from starts to goals and, one
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
