//! A plain particle swarm over via points in joint space, gbest or lbest: what the paper's planner starts from.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::swarms::{
    EndpointChoice, Incumbent, MOST_EVALUATIONS, PathObjective, Stagnation, around_straight, certified,
    places,
};
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::planning::{
    Candidate, CertifiedPath, Found, OptionValue, Pick, PlanError, Planner, Problem, Round, Stage,
};
use crate::swarm::{Fitness, Neighbourhood, Swarm, SwarmSettings};

/// Iterations over which a swarm's inertia falls.
const ITERATIONS: usize = 200;

/// `pso`: a plain particle swarm whose particles are a few configurations, joined by straight moves: what the paper's planner starts
/// from.
///
/// Candidates go by Deb's rule: those in contact by how deep, the others by their cost. The best is certified move by
/// move and then smoothed as any path is.
///
/// # Reference
/// Kennedy and Eberhart, *Particle swarm optimization* (1995); Shi and Eberhart (1998) for the inertia weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PsoPlanner {
    /// How many configurations lie between start and goal.
    pub vias: usize,
    /// Whose personal bests a particle knows: of all, or of a ring.
    pub neighbourhood: Neighbourhood,
    /// How many candidates may be judged.
    pub evaluations: usize,
}

impl Default for PsoPlanner {
    fn default() -> Self {
        Self { vias: 3, neighbourhood: Neighbourhood::Global, evaluations: 20_000 }
    }
}

impl Planner for PsoPlanner {
    fn name(&self) -> &str {
        "pso"
    }

    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        let neighbourhood = match self.neighbourhood {
            Neighbourhood::Global => "global",
            Neighbourhood::Ring { .. } => "ring",
        };
        vec![
            ("vias", OptionValue::Count(self.vias)),
            ("neighbourhood", OptionValue::word(neighbourhood)),
            ("evaluations", OptionValue::Count(self.evaluations)),
        ]
    }

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), &'static str> {
        match option {
            "vias" => self.vias = value.count_in(1..=64).ok_or("a whole number from 1 to 64")?,
            "neighbourhood" => {
                let words = [("global", Neighbourhood::Global), ("ring", Neighbourhood::Ring { k: 2 })];
                self.neighbourhood = value.one_of(&words).ok_or("global or ring")?;
            }
            _ => {
                self.evaluations =
                    value.count_in(1..=MOST_EVALUATIONS).ok_or("a whole number from 1 to 1000000000")?
            }
        }
        Ok(())
    }

    fn budget(&self) -> Option<&'static str> {
        Some("evaluations")
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let bad = |reason: String| PlanError::BadSettings { planner: self.name().to_owned(), reason };
        let Problem { scene, endpoints: ends, settings, monitor, .. } = problem;
        monitor.stage(Stage::JointPath);
        let choice = EndpointChoice::new(scene.arm(), ends);
        let path_objective = PathObjective::new(scene, settings.objective, ends.keep_posture);
        let mut incumbent: Incumbent<'_, Vec<Configuration>> = Incumbent::new(self.evaluations, *monitor);
        let bounds = choice.bounds(self.vias, &[]).map_err(|error| bad(error.to_string()))?;
        let swarm_settings = SwarmSettings {
            neighbourhood: self.neighbourhood,
            iterations: ITERATIONS,
            ..SwarmSettings::default()
        };
        let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
        while !incumbent.is_over() {
            let first = around_straight(&choice, self.vias, swarm_settings.particles / 2, &mut rng);
            let mut swarm = Swarm::<Fitness>::starting_at(&bounds, &swarm_settings, &first, rng.next_u64())
                .map_err(|error| bad(error.to_string()))?;
            let mut stagnation = Stagnation::new();
            while !incumbent.is_over() && stagnation.lasts(swarm.best().1) {
                swarm.step(&mut |x: &[f64]| {
                    let places = places(x, &choice);
                    incumbent.evaluate(
                        || path_objective.violation(&places),
                        || path_objective.cost(&places),
                        || certified(scene, places.clone()),
                    )
                });
            }
        }
        let (places, effort) = incumbent.end()?;
        let path = CertifiedPath::as_found(JointPath(places));
        Ok(Found::new(vec![Candidate::along(scene, path)], Pick::First).with_effort(effort))
    }
}
