//! A swarm over waypoints whose first particles are perturbed where the straight path is bad, in the style of NSC-PSO.

use rand_chacha::ChaCha8Rng;

use super::swarms::{EndpointChoice, MOST_EVALUATIONS, PathObjective, PolylineSwarm, search_polylines};
use crate::planning::{Found, OptionValue, PlanError, Planner, Problem, Round};
use crate::random::unit;
use crate::swarm::{Neighbourhood, SwarmSettings};

/// Where the first particles are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Initialisation {
    /// On the straight path, perturbed where its normalised step cost is great.
    StepCost,
    /// Anywhere: the ablation.
    Uniform,
}

/// `nsc-pso`: a swarm whose particles are `waypoints` configurations, joined by straight moves, perturbed at first where the straight
/// way is bad.
///
/// A step's cost is how deep in contact the arm is there times the way of its points; divided by the greatest it tells how
/// much noise a waypoint starts with. The noise is smooth: it has the covariance (AᵀA)⁻¹ of STOMP, with A the matrix of
/// second differences, and the same matrix smooths the velocities of all particles.
///
/// # Reference
/// NSC-PSO-style: Kim and Lee, the eighth reference of the paper, whose formula of the normalised step cost is not known; the
/// reconstruction is ours. Kalakrishnan et al., *STOMP*, ICRA 2011, for the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NscPsoPlanner {
    /// How many configurations lie between start and goal.
    pub waypoints: usize,
    /// Where the first particles are.
    pub initialisation: Initialisation,
    /// How many candidates may be judged.
    pub evaluations: usize,
}

impl Default for NscPsoPlanner {
    fn default() -> Self {
        Self { waypoints: 12, initialisation: Initialisation::StepCost, evaluations: 40_000 }
    }
}

/// How the swarm begins, and how long it goes on.
struct Settings {
    /// Iterations over which a swarm's inertia falls.
    iterations: usize,
    /// Largest perturbation of a waypoint (rad): each particle has its own share of it.
    shake: f64,
    /// Part of the shaking that does not regard the step cost, so that a way that is free all along is varied too.
    least_shake: f64,
}

const SETTINGS: Settings = Settings { iterations: 200, shake: 7.0, least_shake: 0.05 };

impl Planner for NscPsoPlanner {
    fn name(&self) -> &str {
        "nsc-pso"
    }

    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        let initialisation = match self.initialisation {
            Initialisation::StepCost => "step-cost",
            Initialisation::Uniform => "uniform",
        };
        vec![
            ("waypoints", OptionValue::Count(self.waypoints)),
            ("initialisation", OptionValue::word(initialisation)),
            ("evaluations", OptionValue::Count(self.evaluations)),
        ]
    }

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), String> {
        match option {
            "waypoints" => self.waypoints = value.count_in(1..=64)?,
            "initialisation" => {
                let words = [("step-cost", Initialisation::StepCost), ("uniform", Initialisation::Uniform)];
                self.initialisation = value.one_of(&words)?;
            }
            _ => self.evaluations = value.count_in(1..=MOST_EVALUATIONS)?,
        }
        Ok(())
    }

    fn budget(&self) -> Option<&'static str> {
        Some("evaluations")
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let swarm = SwarmSettings {
            iterations: SETTINGS.iterations,
            neighbourhood: Neighbourhood::Ring { k: 2 },
            ..SwarmSettings::default()
        };
        let count = swarm.particles;
        let polylines = PolylineSwarm { vias: self.waypoints, evaluations: self.evaluations, swarm };
        let first = |choice: &EndpointChoice, objective: &PathObjective<'_>, rng: &mut ChaCha8Rng| match self
            .initialisation
        {
            Initialisation::StepCost => perturbed(choice, objective, self.waypoints, count, rng),
            Initialisation::Uniform => Vec::new(),
        };
        let (smoothing, joints) = (Smoothing::new(self.waypoints), problem.scene.arm().links());
        let shape = |velocity: &mut [f64]| smoothing.smooth(velocity, joints);
        search_polylines(problem, self.name(), &polylines, first, shape)
    }
}

/// Particles on straight paths, perturbed where these are in contact.
fn perturbed(
    choice: &EndpointChoice,
    path_objective: &PathObjective<'_>,
    waypoints: usize,
    count: usize,
    rng: &mut ChaCha8Rng,
) -> Vec<Vec<f64>> {
    let joints = choice.ranges().len();
    let mut chosen = choice.coordinates().cycle();
    (0..count)
        .map(|i| {
            let coordinate = chosen.next().unwrap_or(0.0);
            let [start, goal] = choice.pair(coordinate);
            let at = |k: usize| start.lerp(goal, k as f64 / (waypoints + 1) as f64);
            let costs = normalised(
                &(1..=waypoints).map(|k| path_objective.watch(start).at(&at(k), 0.0)).collect::<Vec<_>>(),
            );
            let shake = SETTINGS.shake * i as f64 / count as f64;
            let noise: Vec<Vec<f64>> = (0..joints).map(|_| smooth_noise(waypoints, rng)).collect();
            let mut position = Vec::with_capacity(waypoints * joints + 1);
            for k in 0..waypoints {
                let straight = at(k + 1);
                let share = SETTINGS.least_shake + (1.0 - SETTINGS.least_shake) * costs[k];
                position.extend((0..joints).map(|j| straight[j] + shake * share * noise[j][k]));
            }
            position.push(coordinate);
            position
        })
        .collect()
}

/// From 0, the least, to 1, the greatest; all 0 where they are alike.
fn normalised(costs: &[f64]) -> Vec<f64> {
    let least = costs.iter().copied().fold(f64::INFINITY, f64::min);
    let most = costs.iter().copied().fold(0.0, f64::max);
    let width = if most > least { most - least } else { f64::INFINITY };
    costs.iter().map(|cost| (cost - least) / width).collect()
}

/// Noise of covariance (AᵀA)⁻¹, scaled to lie within -1 and 1: A⁻¹ times even noise.
fn smooth_noise(count: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let noise = solved((0..count).map(|_| 2.0 * unit(rng) - 1.0).collect());
    let most = noise.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    noise.into_iter().map(|x| if most > 0.0 { x / most } else { 0.0 }).collect()
}

/// The solution x of A x = `right`, with 2 on the diagonal of A and -1 beside it: Thomas' algorithm.
fn solved(mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    let mut above = vec![0.0; count];
    let (mut before_above, mut before) = (0.0, 0.0);
    for i in 0..count {
        let pivot = 2.0 + before_above;
        above[i] = -1.0 / pivot;
        right[i] = (right[i] + before) / pivot;
        (before_above, before) = (above[i], right[i]);
    }
    for i in (0..count.saturating_sub(1)).rev() {
        right[i] -= above[i] * right[i + 1];
    }
    right
}

/// (AᵀA)⁻¹, scaled so that its greatest row sums up to 1.
struct Smoothing {
    rows: Vec<Vec<f64>>,
}

impl Smoothing {
    fn new(count: usize) -> Self {
        let unit = |k: usize| (0..count).map(|i| f64::from(u8::from(i == k))).collect();
        let mut rows: Vec<Vec<f64>> = (0..count).map(|k| solved(unit(k))).collect();
        let most = rows.iter().map(|row| row.iter().sum::<f64>()).fold(f64::MIN_POSITIVE, f64::max);
        rows.iter_mut().flatten().for_each(|x| *x /= most);
        Self { rows }
    }

    /// Smooths what waypoints after each other, of so many `joints` each, have in `velocity`; what comes after them stays.
    fn smooth(&self, velocity: &mut [f64], joints: usize) {
        for j in 0..joints {
            let of_joint: Vec<f64> = (0..self.rows.len()).map(|k| velocity[k * joints + j]).collect();
            for (k, row) in self.rows.iter().enumerate() {
                velocity[k * joints + j] = row.iter().zip(&of_joint).map(|(m, v)| m * v).sum();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Smoothing, normalised, solved};

    #[test]
    fn the_system_is_solved() {
        for count in 1..20 {
            let right: Vec<f64> = (0..count).map(|i| ((i * i) as f64).sin()).collect();
            let x = solved(right.clone());
            for i in 0..count {
                let side = |k: Option<usize>| k.and_then(|k| x.get(k)).copied().unwrap_or(0.0);
                let row = 2.0 * x[i] - side(i.checked_sub(1)) - side(Some(i + 1));
                assert!((row - right[i]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn smoothing_keeps_what_is_smooth_and_flattens_what_is_not() {
        let smoothing = Smoothing::new(9);
        let wave = |turns: f64| -> Vec<f64> {
            (1..=9).flat_map(|k| [(std::f64::consts::PI * turns * f64::from(k) / 10.0).sin(), 0.0]).collect()
        };
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let share = |turns: f64| {
            let (before, mut after) = (wave(turns), wave(turns));
            smoothing.smooth(&mut after, 2);
            size(&after) / size(&before)
        };
        assert!(share(1.0) > 0.7 && share(5.0) < 0.1, "{} {}", share(1.0), share(5.0));
    }

    #[test]
    fn step_costs_go_from_0_to_1() {
        assert_eq!(normalised(&[0.2, 0.6, 1.0]), [0.0, 0.49999999999999994, 1.0]);
        assert_eq!(normalised(&[0.3; 3]), [0.0; 3]);
    }
}
