use rand_chacha::ChaCha8Rng;

use super::swarms::{
    EndpointChoice, MOST_EVALUATIONS, PathObjective, PolylineSwarm, around_straight, search_polylines,
};
use crate::planning::{Found, OptionValue, PlanError, Planner, Problem, Round};
use crate::swarm::{Neighbourhood, SwarmSettings};

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

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), String> {
        match option {
            "vias" => self.vias = value.count_in(1..=64)?,
            "neighbourhood" => {
                let words = [("global", Neighbourhood::Global), ("ring", Neighbourhood::Ring { k: 2 })];
                self.neighbourhood = value.one_of(&words)?;
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
            neighbourhood: self.neighbourhood,
            iterations: ITERATIONS,
            ..SwarmSettings::default()
        };
        let half = swarm.particles / 2;
        let polylines = PolylineSwarm { vias: self.vias, evaluations: self.evaluations, swarm };
        let first = |choice: &EndpointChoice, _: &PathObjective<'_>, rng: &mut ChaCha8Rng| {
            around_straight(choice, self.vias, half, rng)
        };
        search_polylines(problem, self.name(), &polylines, first, |_| {})
    }
}
