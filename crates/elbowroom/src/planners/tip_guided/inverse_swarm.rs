//! Inverse kinematics by a particle swarm over the joint angles.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use thiserror::Error;

use super::settings::SETTINGS;
use crate::arm::{Arm, Configuration, Joint, JointLimits};
use crate::geometry::{Point, Vector};
use crate::swarm::{Bounds, BoundsError, Fitness, Neighbourhood, Swarm, SwarmError, SwarmSettings, Value};

/// Iterations that room is taken for beforehand.
const MOST_RESERVED: usize = 1_000;

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
        Self { particles: 30, iterations: 3000, tolerance: 1e-9 }
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
    /// The best configuration.
    pub q: Configuration,
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
    /// The previous configuration is none of this arm's, or the distance from it no angle.
    #[error(
        "previous configuration of {finite} finite angles for {joints} joints, within {radius} rad: there must be as many, and \
         the distance finite and not negative"
    )]
    Previous {
        /// How many of its angles are numbers.
        finite: usize,
        /// How many the arm has.
        joints: usize,
        /// As given (rad).
        radius: f64,
    },
    /// The joints span no box.
    #[error(transparent)]
    Bounds(#[from] BoundsError),
}

/// The configuration that a swarm over the joint angles finds to put the tip at `tip`.
///
/// Fitness is the square of the tip's position error, to which `previous` adds its weight times the squared distance
/// from it, continuous joints along the shorter direction. `violation` is 0 or less where a configuration may be taken; what may be
/// taken beats what may not, which goes by its violation (Deb's rule). The swarm has one inertia and one best for all, and
/// ends when its best may be taken and errs by less than the tolerance, or with the iterations; one that has come to rest
/// short of that is drawn
/// anew, around its best as long as that gains, then anywhere. The same seed gives the same bytes.
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
    arm: &Arm,
    tip: Point,
    previous: Option<Previous<'_>>,
    settings: &InverseSwarmSettings,
    seed: u64,
    violation: &mut impl FnMut(&[f64]) -> f64,
) -> Result<SwarmInverse, InverseSwarmError> {
    if let Some(Previous { q, radius, .. }) = previous {
        let (finite, joints) = (q.iter().filter(|angle| angle.is_finite()).count(), arm.joints().len());
        if finite != joints || q.len() != joints || !(radius.is_finite() && radius >= 0.0) {
            return Err(InverseSwarmError::Previous { finite, joints, radius });
        }
    }
    let bounds = Bounds::new(&ranges(arm, previous, SETTINGS.widest_draw))?;
    let allowed = ranges(arm, previous, f64::INFINITY);
    let swarm_settings = SwarmSettings {
        particles: settings.particles,
        neighbourhood: Neighbourhood::Global,
        first_inertia: SETTINGS.inertia,
        last_inertia: SETTINGS.inertia,
        c_personal: SETTINGS.pull,
        c_neighbour: SETTINGS.pull,
        v_max: Some(0.5),
        iterations: settings.iterations.max(1),
    };
    let error = |q: &[f64]| arm.tip(q).distance(tip);
    let mut fitness_of = |q: &[f64]| {
        let off = error(q);
        let away = previous.map_or(0.0, |previous| previous.weight * squared_distance(arm, previous.q, q));
        Fitness { violation: violation(q), cost: off * off + away }
    };
    let mut seeds = ChaCha8Rng::seed_from_u64(seed);
    // The first particle of the first swarm stands where the arm is.
    let first: Vec<Vec<f64>> = previous.iter().map(|previous| previous.q.to_vec()).collect();
    let mut swarm = Swarm::starting_at(&bounds, &swarm_settings, &first, seeds.next_u64())?;
    let mut frame: Option<Frame> = None;
    let mut best: Option<(Configuration, Fitness)> = None;
    let mut convergence = Vec::with_capacity(settings.iterations.min(MOST_RESERVED));
    let (mut gained_at, mut gained, mut before) = (0, Fitness::WORST, Fitness::WORST);
    for iteration in 0..settings.iterations {
        let place = |x: &[f64]| frame.as_ref().map_or_else(|| x.into(), |frame| frame.place(x, &allowed));
        swarm.step(&mut |x: &[f64]| fitness_of(&place(x)));
        let (x, fitness) = swarm.best();
        if best.as_ref().is_none_or(|(_, known)| fitness.is_better(*known)) {
            best = Some((place(x), fitness));
        }
        let Some((q, least)) = &best else { break };
        let off = error(q);
        convergence.push(off);
        if least.is_feasible() && off < settings.tolerance {
            break;
        }
        if is_gain(fitness, gained, 0.99) {
            (gained_at, gained) = (iteration, fitness);
        } else if iteration - gained_at >= SETTINGS.swarm_patience {
            // Around the best for as long as that gains, then anywhere.
            let closer = least.is_feasible() && is_gain(*least, before, 0.5);
            before = if closer { *least } else { Fitness::WORST };
            frame = closer.then(|| Frame::around(arm, q, least.cost.sqrt()));
            let seed = seeds.next_u64();
            swarm = if closer {
                let unit = Bounds::new(&vec![[-1.0, 1.0]; q.len()])?;
                Swarm::starting_at(&unit, &swarm_settings, &[vec![0.0; q.len()]], seed)?
            } else {
                Swarm::new(&bounds, &swarm_settings, seed)?
            };
            (gained_at, gained) = (iteration, Fitness::WORST);
        }
    }
    let (q, fitness) = best.unwrap_or_else(|| (swarm.best().0.into(), swarm.best().1));
    Ok(SwarmInverse {
        error: error(&q),
        q,
        violation: fitness.violation.max(0.0),
        evaluations: convergence.len() * settings.particles,
        convergence,
    })
}

/// Where a swarm that is drawn anew around its best looks: the joints' way that moves the tip most is as much narrower than
/// the others as the tip follows it more. With the links in line, where the tip moves with the square of the other angles, a
/// box in the joints' own axes would hold next to nothing that is better.
struct Frame {
    origin: Configuration,
    /// The way, of length 1, that moves the tip most.
    stiff: Vec<f64>,
    /// Half the width along it, and along the others (rad).
    widths: [f64; 2],
}

impl Frame {
    /// Around `q`, whose tip errs by `error` (m).
    fn around(arm: &Arm, q: &[f64], error: f64) -> Self {
        let columns = arm.jacobian(q);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for column in &columns {
            xx += column.x * column.x;
            xy += column.x * column.y;
            yy += column.y * column.y;
        }
        // The tip's direction of the greatest of the two singular values.
        let along = Vector::polar(1.0, 0.5 * libm::atan2(2.0 * xy, xx - yy));
        let pulls: Vec<f64> = columns.iter().map(|column| column.dot(along)).collect();
        let greatest = pulls.iter().map(|shortcut| shortcut * shortcut).sum::<f64>().sqrt();
        let [_, reach] = arm.reach();
        let soft = 2.0 * (error / reach).sqrt();
        let (stiff, narrow) = if greatest > 0.0 {
            (pulls.iter().map(|shortcut| shortcut / greatest).collect(), (2.0 * error / greatest).min(soft))
        } else {
            (vec![0.0; q.len()], soft)
        };
        Self { origin: q.into(), stiff, widths: [narrow, soft] }
    }

    /// The configuration at `x`, each coordinate from -1 to 1, put between the `allowed` ends.
    fn place(&self, x: &[f64], allowed: &[[f64; 2]]) -> Configuration {
        let [narrow, soft] = self.widths;
        let along: f64 = x.iter().zip(&self.stiff).map(|(x, stiff)| x * stiff).sum();
        let at = |j: usize| self.origin[j] + soft * x[j] - (soft - narrow) * along * self.stiff[j];
        (0..x.len()).map(|j| at(j).clamp(allowed[j][0], allowed[j][1])).collect()
    }
}

/// Whether `fitness` is no more than this `share` of `known`, or may be taken where that may not.
fn is_gain(fitness: Fitness, known: Fitness, share: f64) -> bool {
    match (fitness.is_feasible(), known.is_feasible()) {
        (true, true) => fitness.cost < share * known.cost,
        (true, false) => true,
        (false, true) => false,
        (false, false) => fitness.violation < share * known.violation,
    }
}

/// Where each joint may be sought: within the limits, and around `previous`; a continuous one without that up to `widest`
/// from 0 (rad).
fn ranges(arm: &Arm, previous: Option<Previous<'_>>, widest: f64) -> Vec<[f64; 2]> {
    let range = |(j, joint): (usize, &Joint)| {
        let [min, max] = match joint.limits {
            JointLimits::Continuous if previous.is_none() => [-widest, widest],
            JointLimits::Continuous => [f64::NEG_INFINITY, f64::INFINITY],
            JointLimits::Range { min, max } => [min, max],
        };
        previous.map_or([min, max], |Previous { q, radius, .. }| {
            // A previous configuration beyond a stop: the swarm looks at the stop.
            [(q[j] - radius).clamp(min, max), (q[j] + radius).clamp(min, max)]
        })
    };
    arm.joints().iter().enumerate().map(range).collect()
}

fn squared_distance(arm: &Arm, from: &[f64], to: &[f64]) -> f64 {
    let joints = arm.joints().iter().zip(from.iter().zip(to));
    joints.map(|(joint, (&from, &to))| joint.limits.difference(from, to)).map(|turn| turn * turn).sum()
}
