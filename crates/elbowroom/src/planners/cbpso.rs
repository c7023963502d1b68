//! A cultural swarm over motions of quartic and quintic pieces, in the style of CBPSO.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::swarms::{
    EndpointChoice, Incumbent, MOST_EVALUATIONS, PathObjective, Stagnation, around_straight,
};
use crate::arm::Configuration;
use crate::planning::{
    Candidate, Found, Monitor, OptionValue, Pace, Pick, PlanError, Planner, Problem, Round, Stage,
};
use crate::scene::Scene;
use crate::swarm::{CulturalSettings, CulturalSwarm, Fitness, SwarmSettings};
use crate::trajectory::{Motion, Piece, SpeedLimits, TICK, quartic, quintic, stretch};
use crate::verify::{Trajectory, VerifySettings};

/// `cbpso`: a cultural swarm whose particles are via configurations, the velocities there, and durations: all pieces but
/// the last are polynomials of degree four, the last is a quintic, and acceleration is continuous throughout.
///
/// The motion is scaled to be as fast as the motion limits allow, or to the duration asked for, and goes before the
/// verifier as it is.
///
/// # Reference
/// CBPSO-style: Guo et al., the sixth reference of the paper, of whom only the cultural swarm over quartic and quintic pieces in
/// joint space is known; encoding and equations are our reconstruction, after Tian and Collins (2004).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CbpsoPlanner {
    /// How many configurations the motion is led through.
    pub vias: usize,
    /// How many candidates may be judged.
    pub evaluations: usize,
}

impl Default for CbpsoPlanner {
    fn default() -> Self {
        Self { vias: 2, evaluations: 20_000 }
    }
}

/// How the swarm goes about it.
struct Settings {
    /// Particles of a swarm, and iterations over which its inertia falls.
    particles: usize,
    iterations: usize,
    /// Durations of pieces before they are scaled to the motion limits (s): only their ratios count.
    durations: [f64; 2],
    /// Looks at one piece.
    looks: usize,
    /// Rounds of lengthening a motion whose pieces were rounded to whole ticks.
    rounds: usize,
}

const SETTINGS: Settings =
    Settings { particles: 40, iterations: 250, durations: [0.3, 3.0], looks: 24, rounds: 6 };

impl Planner for CbpsoPlanner {
    fn name(&self) -> &str {
        "cbpso"
    }

    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        vec![("vias", OptionValue::Count(self.vias)), ("evaluations", OptionValue::Count(self.evaluations))]
    }

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), String> {
        match option {
            "vias" => self.vias = value.count_in(1..=64)?,
            _ => self.evaluations = value.count_in(1..=MOST_EVALUATIONS)?,
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
        let encoding = MotionEncoding {
            choice: &choice,
            vias: self.vias,
            limits: path_objective.limits(),
            pace: settings.pace,
        };
        let mut incumbent = Incumbent::new(self.evaluations, *monitor);
        let bounds = choice.bounds(self.vias, &encoding.rates()).map_err(|error| bad(error.to_string()))?;
        let swarm = SwarmSettings {
            particles: SETTINGS.particles,
            iterations: SETTINGS.iterations,
            ..SwarmSettings::default()
        };
        let cultural = CulturalSettings { swarm, ..CulturalSettings::default() };
        let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
        while !incumbent.is_over() {
            let first: Vec<Vec<f64>> =
                around_straight(&choice, self.vias, cultural.swarm.particles / 2, &mut rng)
                    .into_iter()
                    .map(|position| encoding.with_even_rates(&position))
                    .collect();
            let mut swarm = CulturalSwarm::<Fitness>::starting_at(&bounds, &cultural, &first, rng.next_u64())
                .map_err(|error| bad(error.to_string()))?;
            let mut stagnation = Stagnation::new();
            while !incumbent.is_over() && stagnation.lasts(swarm.best().1) {
                swarm.step(&mut |x: &[f64]| {
                    let Some(motion) = encoding.motion(x) else {
                        return incumbent.evaluate(|| f64::MAX, || 0.0, || None);
                    };
                    let looks = motion.instants(SETTINGS.looks);
                    incumbent.evaluate(
                        || violation(&path_objective, &motion, &looks),
                        || settings.objective.of_looks(scene.arm(), &looks, motion.duration()),
                        || is_safe(scene, &motion, *monitor).then(|| motion.clone()),
                    )
                });
            }
        }
        let (motion, effort) = incumbent.end()?;
        Ok(Found::new(vec![Candidate::draft(motion)], Pick::First).with_effort(effort))
    }
}

/// What a particle's coordinates stand for: via configurations, velocities there, durations, and the choice of ends.
struct MotionEncoding<'a> {
    choice: &'a EndpointChoice,
    vias: usize,
    limits: &'a [SpeedLimits],
    pace: Pace,
}

impl MotionEncoding<'_> {
    /// Ranges of velocities and durations.
    fn rates(&self) -> Vec<[f64; 2]> {
        let velocities = (0..self.vias).flat_map(|_| self.limits.iter());
        let velocities = velocities.map(|limit| [-limit.velocity, limit.velocity]);
        velocities.chain((0..=self.vias).map(|_| SETTINGS.durations)).collect()
    }

    /// A position of via configurations and choice with even durations, and velocities as on the straight way.
    fn with_even_rates(&self, position: &[f64]) -> Vec<f64> {
        let joints = self.limits.len();
        let (choice, vias) = position.split_last().unwrap_or((&0.0, &[]));
        let [start, goal] = self.choice.pair(*choice);
        let duration = 1.0;
        let at = |k: usize, j: usize| match k {
            0 => start[j],
            k if k > self.vias => goal[j],
            k => vias[(k - 1) * joints + j],
        };
        let mut all = vias.to_vec();
        for k in 1..=self.vias {
            for (j, limit) in self.limits.iter().enumerate() {
                let slope = (at(k + 1, j) - at(k - 1, j)) / (2.0 * duration);
                all.push(slope.clamp(-limit.velocity, limit.velocity));
            }
        }
        all.extend((0..=self.vias).map(|_| duration));
        all.push(*choice);
        all
    }

    fn places(&self, x: &[f64]) -> Vec<Configuration> {
        let joints = self.limits.len();
        let [start, goal] = self.choice.pair(x[x.len() - 1]);
        let mut places = vec![start.clone()];
        places.extend(x[..self.vias * joints].chunks_exact(joints).map(Configuration::from));
        places.push(goal.clone());
        places
    }

    /// The motion of a particle at the pace asked for, on whole ticks; `None` where numbers overflow or no scaling keeps
    /// the limits.
    fn motion(&self, x: &[f64]) -> Option<Motion> {
        let joints = self.limits.len();
        let places = self.places(x);
        let (velocities, durations) = x[self.vias * joints..x.len() - 1].split_at(self.vias * joints);
        let asked = match self.pace {
            Pace::Fastest => None,
            Pace::Duration(duration) => Some(duration),
        };
        let slow_down =
            |pieces: &[Piece]| pieces.iter().map(|piece| stretch(piece, self.limits)).fold(0.0, f64::max);
        let even = self.pieces(&places, velocities, durations, 1.0);
        let mut factor = match asked {
            None => slow_down(&even),
            Some(duration) => duration / durations.iter().sum::<f64>(),
        };
        for _ in 0..SETTINGS.rounds {
            let total: f64 = durations.iter().sum::<f64>() * factor;
            let scaled = on_ticks(durations, factor, asked.is_some().then_some(total));
            let pieces = self.pieces(&places, velocities, &scaled, factor);
            let needed = slow_down(&pieces);
            if needed <= 1.0 {
                return Motion::new(pieces).ok();
            }
            if asked.is_some() || !needed.is_finite() {
                return None;
            }
            factor *= needed * (1.0 + 1e-6) + 1e-4;
        }
        None
    }

    /// Pieces of these durations (s), with velocities slowed down by `factor`.
    fn pieces(
        &self,
        places: &[Configuration],
        velocities: &[f64],
        durations: &[f64],
        factor: f64,
    ) -> Vec<Piece> {
        let joints = self.limits.len();
        let mut now = vec![[0.0; 2]; joints];
        let mut start = 0.0;
        (0..=self.vias)
            .map(|k| {
                let duration = durations[k];
                let coefficients = (0..joints)
                    .map(|j| {
                        let from = [places[k][j], now[j][0], now[j][1]];
                        let to = places[k + 1][j];
                        if k == self.vias {
                            return quintic(from, [to, 0.0, 0.0], duration);
                        }
                        let velocity = velocities[k * joints + j] / factor;
                        let (terms, acceleration) = quartic(from, [to, velocity], duration);
                        now[j] = [velocity, acceleration];
                        terms
                    })
                    .collect();
                let piece = Piece { start, duration, coefficients };
                start += duration;
                piece
            })
            .collect()
    }
}

/// Durations times `factor`, each a whole number of ticks but, where a `total` (s) is asked for, the last.
fn on_ticks(durations: &[f64], factor: f64, total: Option<f64>) -> Vec<f64> {
    let mut rounded: Vec<f64> =
        durations.iter().map(|duration| (duration * factor / TICK).ceil().max(1.0) * TICK).collect();
    if let (Some(total), Some(last)) = (total, durations.len().checked_sub(1)) {
        let before: f64 = rounded[..last].iter().sum();
        rounded[last] = (total - before).max(TICK * factor.min(1.0) * 1e-3);
    }
    rounded
}

fn violation(path_objective: &PathObjective<'_>, motion: &Motion, looks: &[Vec<f64>]) -> f64 {
    let start = motion.at(motion.start()).position;
    let mut watch = path_objective.watch(&start);
    let mut at = |pair: &[Vec<f64>]| {
        let moved = path_objective.way(&pair[0], &pair[1]);
        watch.at(&pair[1], moved) * (moved + 1e-6)
    };
    looks.windows(2).map(&mut at).sum()
}

fn is_safe(scene: &Scene, motion: &Motion, monitor: &dyn Monitor) -> bool {
    let keep_going = || monitor.keep_going();
    Trajectory::certify_until(scene, motion.clone(), &VerifySettings::default(), &keep_going).is_ok()
}
