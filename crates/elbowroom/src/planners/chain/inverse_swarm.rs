//! Inverse kinematics by a particle swarm over the joint angles.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use thiserror::Error;

use crate::arm::{Arm, JointLimits, PlanarArm};
use crate::geometry::{Point, angle_difference};
use crate::swarm::{Bounds, BoundsError, Fitness, Neighbourhood, Swarm, SwarmError, SwarmSettings};

/// Iterations without a hundredth of gain after which a swarm has come to rest and another one begins.
const PATIENCE: usize = 25;

/// How far from 0 continuous joints are drawn (rad): more than half a turn, so that no direction lies at an edge only.
const WIDEST_DRAW: f64 = 1.5 * std::f64::consts::PI;

/// How [`inverse_by_swarm`] looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseSwarmSettings {
    /// How many particles there are.
    pub particles: usize,
    /// How often every particle is evaluated at the most.
    pub iterations: usize,
    /// How near the tip has to come (m).
    pub tolerance: f64,
}

impl Default for InverseSwarmSettings {
    fn default() -> Self {
        Self { particles: 30, iterations: 400, tolerance: 1e-9 }
    }
}

/// The configuration that a tip path comes from: the swarm starts around it and is drawn to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Previous<'a> {
    /// A position per joint (rad).
    pub q: &'a [f64],
    /// How far from it the swarm looks, in every joint (rad).
    pub radius: f64,
    /// What a squared radian of distance from it costs (m²/rad²).
    pub weight: f64,
}

/// What [`inverse_by_swarm`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct SwarmInverse {
    /// The best configuration (rad).
    pub q: Vec<f64>,
    /// How far its tip is from where it shall be (m).
    pub error: f64,
    /// By how much it violates the constraints; 0 when it does not.
    pub violation: f64,
    /// How many configurations were judged.
    pub evaluations: usize,
    /// The error of the best configuration after each iteration (m).
    pub convergence: Vec<f64>,
}

/// Why there is no such swarm.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum InverseSwarmError {
    /// A setting makes no sense.
    #[error(transparent)]
    Swarm(#[from] SwarmError),
    /// The joints span no box.
    #[error(transparent)]
    Bounds(#[from] BoundsError),
}

/// The configuration that a swarm over the joint angles finds to put the tip at `tip`.
///
/// Fitness is the square of the tip's position error, to which `previous` adds its weight times the squared distance
/// from it, continuous joints the short way round. `violation` is 0 or less where a configuration may be taken; what may be
/// taken beats what may not, which goes by its violation (Deb's rule). The swarm has one inertia and one best for all, and
/// ends when its best may be taken and errs by less than the tolerance, or with the iterations; one that has come to rest
/// short of that is drawn anew. The same seed gives the same bytes.
///
/// IK-PSO-style, our reconstruction: the method's papers are known to us by their abstracts.
///
/// # Errors
/// [`InverseSwarmError`] for settings, or a distance from `previous`, that make no swarm.
///
/// # Reference
/// Rokbani and Alimi, *Inverse kinematics using particle swarm optimization, a statistical analysis*, Procedia Engineering
/// 64 (2013).
pub fn inverse_by_swarm(
    arm: &PlanarArm,
    tip: Point,
    previous: Option<Previous<'_>>,
    settings: &InverseSwarmSettings,
    seed: u64,
    violation: &mut impl FnMut(&[f64]) -> f64,
) -> Result<SwarmInverse, InverseSwarmError> {
    let bounds = bounds(arm, previous)?;
    let swarm_settings = SwarmSettings {
        particles: settings.particles,
        neighbourhood: Neighbourhood::Global,
        // Clerc and Kennedy's constriction.
        first_inertia: 0.7298,
        last_inertia: 0.7298,
        c_personal: 1.49618,
        c_neighbour: 1.49618,
        v_max: Some(0.5),
        iterations: settings.iterations.max(1),
    };
    let error = |q: &[f64]| arm.tip_at(q).distance(tip);
    let mut objective = |q: &[f64]| {
        let off = error(q);
        let away = previous.map_or(0.0, |previous| previous.weight * squared_distance(arm, previous.q, q));
        Fitness { violation: violation(q), cost: off * off + away }
    };
    let mut seeds = ChaCha8Rng::seed_from_u64(seed);
    // The first particle of the first swarm stands where the arm is.
    let first: Vec<Vec<f64>> = previous.iter().map(|previous| previous.q.to_vec()).collect();
    let mut swarm = Swarm::starting_at(&bounds, &swarm_settings, &first, seeds.next_u64())?;
    let mut best: Option<(Vec<f64>, Fitness)> = None;
    let mut convergence = Vec::with_capacity(settings.iterations);
    let (mut gained_at, mut gained) = (0, Fitness { violation: f64::INFINITY, cost: f64::INFINITY });
    for iteration in 0..settings.iterations {
        swarm.step(&mut objective);
        let (q, fitness) = swarm.best();
        if best.as_ref().is_none_or(|(_, known)| crate::swarm::Value::is_better(fitness, *known)) {
            best = Some((q.to_vec(), fitness));
        }
        let Some((q, fitness)) = &best else { break };
        let off = error(q);
        convergence.push(off);
        if fitness.is_feasible() && off < settings.tolerance {
            break;
        }
        if is_gain(swarm.best().1, gained) {
            (gained_at, gained) = (iteration, swarm.best().1);
        } else if iteration - gained_at >= PATIENCE {
            swarm = Swarm::new(&bounds, &swarm_settings, seeds.next_u64())?;
            (gained_at, gained) = (iteration, Fitness { violation: f64::INFINITY, cost: f64::INFINITY });
        }
    }
    let (q, fitness) = best.unwrap_or_else(|| (swarm.best().0.to_vec(), swarm.best().1));
    Ok(SwarmInverse {
        error: error(&q),
        q,
        violation: fitness.violation.max(0.0),
        evaluations: convergence.len() * settings.particles,
        convergence,
    })
}

/// Whether `fitness` is better than `known` by a hundredth.
fn is_gain(fitness: Fitness, known: Fitness) -> bool {
    match (fitness.is_feasible(), known.is_feasible()) {
        (true, true) => fitness.cost < 0.99 * known.cost,
        (true, false) => true,
        (false, true) => false,
        (false, false) => fitness.violation < 0.99 * known.violation,
    }
}

/// Where the swarm looks: between the stops, and around `previous`.
fn bounds(arm: &PlanarArm, previous: Option<Previous<'_>>) -> Result<Bounds, BoundsError> {
    let ranges: Vec<[f64; 2]> = (0..arm.joints().len())
        .map(|j| {
            let [min, max] = match (arm.joints()[j].limits, previous) {
                (JointLimits::Continuous, None) => [-WIDEST_DRAW, WIDEST_DRAW],
                (JointLimits::Continuous, Some(_)) => [f64::NEG_INFINITY, f64::INFINITY],
                (JointLimits::Range { min, max }, _) => [min, max],
            };
            match previous.and_then(|previous| Some((*previous.q.get(j)?, previous.radius))) {
                Some((q, radius)) => {
                    let (low, high) = ((q - radius).max(min), (q + radius).min(max));
                    // A previous configuration beyond a stop: the swarm looks at the stop.
                    [low.min(max), high.max(min)]
                }
                None => [min, max],
            }
        })
        .collect();
    Bounds::new(&ranges)
}

fn squared_distance(arm: &PlanarArm, from: &[f64], to: &[f64]) -> f64 {
    let joints = arm.joints().iter().zip(from.iter().zip(to));
    joints
        .map(|(joint, (&from, &to))| match joint.limits {
            JointLimits::Continuous => angle_difference(from, to),
            JointLimits::Range { .. } => to - from,
        })
        .map(|turn| turn * turn)
        .sum()
}
