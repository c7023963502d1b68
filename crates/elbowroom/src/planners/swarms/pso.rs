//! A plain particle swarm over via points in joint space, gbest or lbest: what the paper's planner starts from.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::super::endpoints::Endpoints;
use super::super::finish::along;
use super::super::settings::PlanSettings;
use super::super::{Monitor, Plan, PlanError, Stage};
use super::choice::Choice;
use super::hunt::{Hunt, Patience};
use super::polyline::{around_straight, certified, places};
use super::track::Track;
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::scene::Scene;
use crate::swarm::{Fitness, Neighbourhood, Swarm, SwarmSettings};

/// Iterations over which a swarm's inertia falls.
const ITERATIONS: usize = 200;

/// How a swarm looks for via points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PsoSettings {
    /// How many configurations lie between start and goal.
    pub vias: usize,
    /// Whose personal bests a particle knows: of all, or of a ring.
    pub neighbourhood: Neighbourhood,
    /// How many candidates may be judged.
    pub evaluations: usize,
}

impl Default for PsoSettings {
    fn default() -> Self {
        Self { vias: 3, neighbourhood: Neighbourhood::Global, evaluations: 20_000 }
    }
}

/// Plans by a swarm whose particles are `settings.vias` configurations, joined by straight turns.
///
/// Candidates go by Deb's rule: those in contact by how deep, the others by their cost. The best is certified turn by
/// turn and then smoothed as any path is.
///
/// # Reference
/// Kennedy and Eberhart, *Particle swarm optimization* (1995); Shi and Eberhart (1998) for the inertia weight.
pub(in crate::planners) fn plan(
    scene: &Scene,
    ends: &Endpoints,
    own: &PsoSettings,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    monitor.stage(Stage::JointPath);
    let choice = Choice::new(scene.arm(), ends);
    let track = Track::new(scene, settings.objective, ends.keep_posture);
    let mut hunt: Hunt<'_, _, Vec<Configuration>> = Hunt::new(own.evaluations, monitor);
    let bounds = choice.bounds(own.vias, &[]).map_err(PlanError::Bounds)?;
    let swarm_settings = SwarmSettings {
        neighbourhood: own.neighbourhood,
        iterations: ITERATIONS,
        ..SwarmSettings::default()
    };
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
    while !hunt.is_over() {
        let first = around_straight(&choice, own.vias, swarm_settings.particles / 2, &mut rng);
        let mut swarm = Swarm::<Fitness>::starting_at(&bounds, &swarm_settings, &first, rng.next_u64())
            .map_err(PlanError::Particles)?;
        let mut patience = Patience::new();
        while !hunt.is_over() && patience.lasts(swarm.best().1) {
            swarm.step(&mut |x: &[f64]| {
                let places = places(x, &choice);
                hunt.judge(
                    || track.violation(&places),
                    || track.cost(&places),
                    || certified(scene, places.clone()),
                )
            });
        }
    }
    let (places, effort) = hunt.end()?;
    along(scene, JointPath(places), settings, effort, monitor)
}
