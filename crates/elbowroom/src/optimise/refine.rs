use super::control_points::ControlPoints;
use super::program::{Program, Sample};
use super::signed_distance::signed_distances;
use crate::scene::Scene;
use crate::trajectory::{Motion, SpeedLimits};
use crate::verify::{Trajectory, VerifySettings, Violation};

/// How to search for the fastest motion. Lengths are shares of the reach.
struct Settings {
    /// Pieces of constant jerk.
    pieces: usize,
    /// Where every piece is sampled, as shares of it.
    shares: [f64; 3],
    /// Clearance that is kept at the places sampled, and by how much it grows with every search.
    margin: f64,
    margin_growth: f64,
    /// Links nearer than this to something count.
    near: f64,
    /// How far a control point may move in the first step (rad), at most, and when a step is too small to go on.
    trust: [f64; 3],
    /// By what the reach of a step changes after one that was better, and one that was not.
    grow: f64,
    shrink: f64,
    /// What being one reach deep costs, in durations.
    penalty: f64,
    /// Gain, as a share, with which a search ends.
    gain: f64,
    /// Most steps of one search.
    steps: usize,
    /// Searches, each with more places that are sampled.
    rounds: usize,
}

const SETTINGS: Settings = Settings {
    pieces: 32,
    shares: [0.0, 1.0 / 3.0, 2.0 / 3.0],
    margin: 3e-4,
    margin_growth: 2.0,
    near: 0.1,
    trust: [0.3, 1.0, 1e-4],
    grow: 1.5,
    shrink: 0.4,
    penalty: 50.0,
    gain: 3e-4,
    steps: 25,
    rounds: 8,
};

/// What the fastest motion has to keep to.
pub(crate) struct Constraints<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) limits: &'a [SpeedLimits],
    /// Where each joint may be (rad).
    pub(crate) ranges: &'a [[f64; 2]],
    pub(crate) keep_going: &'a dyn Fn() -> bool,
}

/// The fastest motion that is found near `motion`, from its start to its end, at rest at both, proved to be safe; `None` where that
/// is not found, or `keep_going` said no.
pub(crate) fn fastest(constraints: &Constraints<'_>, motion: &Motion) -> Option<Trajectory> {
    let [_, reach] = constraints.scene.arm().reach();
    let mut search = Search {
        constraints,
        reach,
        places: (0..SETTINGS.pieces).flat_map(|piece| SETTINGS.shares.map(|share| (piece, share))).collect(),
        margin: SETTINGS.margin * reach,
    };
    let mut control = ControlPoints::of(motion, SETTINGS.pieces);
    for _ in 0..SETTINGS.rounds {
        control = search.improved(control)?;
        let step = control.least_step(constraints.limits);
        let found = control.motion(step)?;
        let settings = VerifySettings::default();
        match Trajectory::certify_until(constraints.scene, found, &settings, constraints.keep_going) {
            Ok(trajectory) => return Some(trajectory),
            Err(verdict) => {
                if !(constraints.keep_going)() {
                    return None;
                }
                let contact = |violation: &Violation| {
                    matches!(violation, Violation::Contact { .. } | Violation::Undecided { .. })
                };
                let times: Vec<f64> =
                    verdict.violations.iter().filter(|it| contact(it)).map(Violation::time).collect();
                if times.len() < verdict.violations.len() || times.is_empty() {
                    return None;
                }
                search.sample_at(&times, step);
                search.margin *= SETTINGS.margin_growth;
            }
        }
    }
    None
}

struct Search<'a> {
    constraints: &'a Constraints<'a>,
    reach: f64,
    /// Pieces, and shares of them, that are sampled.
    places: Vec<(usize, f64)>,
    margin: f64,
}

impl Search<'_> {
    /// Control points from which no step is better by more than a little.
    fn improved(&self, start: ControlPoints) -> Option<ControlPoints> {
        let Constraints { limits, ranges, keep_going, .. } = *self.constraints;
        let mut control = start;
        let mut samples = self.samples(&control);
        let mut step = control.least_step(limits);
        let whole = step;
        let merit = |step: f64, samples: &[Sample]| step / whole + SETTINGS.penalty * self.depth(samples);
        let mut best = merit(step, &samples);
        let [mut trust, widest, narrowest] = SETTINGS.trust;
        for _ in 0..SETTINGS.steps {
            if !keep_going() {
                return None;
            }
            let program = Program {
                control: &control,
                step,
                limits,
                ranges,
                samples: &samples,
                margin: self.margin,
                reach: self.reach,
                trust,
                penalty: SETTINGS.penalty * whole / step,
            };
            let Some(next) = program.solved() else {
                trust *= SETTINGS.shrink;
                if trust < narrowest {
                    break;
                }
                continue;
            };
            let (next_step, next_samples) = (next.least_step(limits), self.samples(&next));
            let found = merit(next_step, &next_samples);
            if found < best {
                let gain = best - found;
                (control, step, samples, best) = (next, next_step, next_samples, found);
                trust = (trust * SETTINGS.grow).min(widest);
                if gain < SETTINGS.gain * best {
                    break;
                }
            } else {
                trust *= SETTINGS.shrink;
                // As good as the last, but for rounding: there is nothing left to gain.
                if trust < narrowest || found - best < SETTINGS.gain * SETTINGS.gain * best {
                    break;
                }
            }
        }
        Some(control)
    }

    fn samples(&self, control: &ControlPoints) -> Vec<Sample> {
        let sample = |&(piece, share): &(usize, f64)| {
            let q = control.position(piece, share);
            let signed_distances = signed_distances(self.constraints.scene, &q, SETTINGS.near * self.reach);
            Sample { piece, share, signed_distances }
        };
        self.places.iter().map(sample).collect()
    }

    /// How far the margin is missed at the worst (reaches).
    fn depth(&self, samples: &[Sample]) -> f64 {
        let all = samples.iter().flat_map(|sample| &sample.signed_distances);
        all.map(|it| (self.margin - it.distance) / self.reach).fold(0.0, f64::max)
    }

    /// Samples more closely from now on where something was touched at these times (s).
    fn sample_at(&mut self, times: &[f64], step: f64) {
        for time in times {
            for nearby in [-1.0 / 6.0, 0.0, 1.0 / 6.0] {
                let at = (time / step + nearby).clamp(0.0, SETTINGS.pieces as f64 - 1e-9);
                let place = (at as usize, at.fract());
                if !self.places.contains(&place) {
                    self.places.push(place);
                }
            }
        }
    }
}
