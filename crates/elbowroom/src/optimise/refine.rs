use super::control_points::ControlPoints;
use super::length::{Length, sum_of_chords, sum_of_squares};
use super::program::{Chords, Cost, Program, Sample};
use super::signed_distance::signed_distances;
use crate::scene::Scene;
use crate::trajectory::{Motion, SpeedLimits};
use crate::verify::{Trajectory, VerifySettings, Violation};

/// How to search for a better motion. Lengths are shares of the reach.
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
    /// What being one reach deep costs, and being longer than allowed by the whole length, in terms of the first motion's cost.
    penalty: f64,
    length_penalty: f64,
    /// What joint travel counts beside the length, where the shortest is sought: without it joints drift where the length does not say.
    joint_share: f64,
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
    margin_growth: 1.4,
    near: 0.1,
    trust: [0.3, 1.0, 1e-4],
    grow: 1.5,
    shrink: 0.4,
    penalty: 50.0,
    length_penalty: 100.0,
    joint_share: 1e-3,
    gain: 3e-4,
    steps: 25,
    rounds: 10,
};

/// What a motion is made better for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Goal {
    /// Least duration.
    Fastest,
    /// Least length.
    Shortest(Length),
    /// Least jerk, as the integral of its square, in so much time (s).
    Smoothest(f64),
}

/// What the motion has to keep to.
pub(crate) struct Constraints<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) limits: &'a [SpeedLimits],
    /// Where each joint may be (rad).
    pub(crate) ranges: &'a [[f64; 2]],
    /// The most that it may measure (m or rad), if that is bounded.
    pub(crate) longest: Option<(Length, f64)>,
    pub(crate) keep_going: &'a dyn Fn() -> bool,
}

/// The best motion that is found near `motion`, from its start to its end, at rest at both, proved to be safe; `None` where that
/// is not found, or `keep_going` said no.
pub(crate) fn improved(constraints: &Constraints<'_>, goal: Goal, motion: &Motion) -> Option<Trajectory> {
    let [_, reach] = constraints.scene.arm().reach();
    let mut search = Search {
        constraints,
        goal,
        reach,
        places: (0..SETTINGS.pieces).flat_map(|piece| SETTINGS.shares.map(|share| (piece, share))).collect(),
        margin: SETTINGS.margin * reach,
        longest: constraints.longest,
    };
    let mut control = ControlPoints::of(motion, SETTINGS.pieces);
    if goal == Goal::Fastest && control.least_step(constraints.limits) == 0.0 {
        // Without limits nothing is the fastest.
        return None;
    }
    for _ in 0..SETTINGS.rounds {
        control = search.improved(control)?;
        let step = search.step(&control)?;
        let found = control.motion(step)?;
        let settings = VerifySettings::default();
        let too_long = search.shorten(&control, &found);
        match Trajectory::certify_until(constraints.scene, found, &settings, constraints.keep_going) {
            Ok(_) if too_long => {}
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
    goal: Goal,
    reach: f64,
    /// Pieces, and shares of them, that are sampled.
    places: Vec<(usize, f64)>,
    margin: f64,
    /// The most that the sum of chords may be.
    longest: Option<(Length, f64)>,
}

/// An iterate, and what is known of it.
struct Iterate {
    control: ControlPoints,
    step: f64,
    samples: Vec<Sample>,
    chords: Option<Chords>,
}

impl Search<'_> {
    /// Control points from which no step is better by more than a little.
    fn improved(&self, start: ControlPoints) -> Option<ControlPoints> {
        let Constraints { limits, ranges, keep_going, .. } = *self.constraints;
        let mut now = self.iterate(start);
        let merit = self.merit(&now);
        let mut best = merit(&now);
        let whole = now.step;
        let [mut trust, widest, narrowest] = SETTINGS.trust;
        for _ in 0..SETTINGS.steps {
            if !keep_going() {
                return None;
            }
            let (cost, step, share) = match self.goal {
                Goal::Fastest => (Cost::Step, now.step, now.step / whole),
                Goal::Shortest(_) => (Cost::Chords(SETTINGS.joint_share), now.step, 1.0),
                Goal::Smoothest(duration) => (Cost::Jerk, duration / now.control.pieces() as f64, 1.0),
            };
            let program = Program {
                control: &now.control,
                cost,
                step,
                limits,
                ranges,
                samples: &now.samples,
                chords: now.chords.as_ref(),
                margin: self.margin,
                reach: self.reach,
                trust,
                penalty: SETTINGS.penalty / share,
                length_penalty: SETTINGS.length_penalty / share,
            };
            let Some(next) = program.solved() else {
                trust *= SETTINGS.shrink;
                if trust < narrowest {
                    break;
                }
                continue;
            };
            let next = self.iterate(next);
            let found = merit(&next);
            if found < best {
                let gain = best - found;
                (now, best) = (next, found);
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
        Some(now.control)
    }

    fn iterate(&self, control: ControlPoints) -> Iterate {
        let sample = |&(piece, share): &(usize, f64)| {
            let q = control.position(piece, share);
            let signed_distances = signed_distances(self.constraints.scene, &q, SETTINGS.near * self.reach);
            Sample { piece, share, signed_distances }
        };
        let samples = self.places.iter().map(sample).collect();
        let (length, most) = match (self.goal, self.longest) {
            (Goal::Shortest(length), _) => (Some(length), None),
            (_, Some((length, most))) => (Some(length), Some(most)),
            (_, None) => (None, None),
        };
        let chords = length.map(|length| {
            let places = length.places(self.constraints.scene.arm(), &control);
            Chords { places, most }
        });
        Iterate { step: control.least_step(self.constraints.limits), control, samples, chords }
    }

    /// What is to be little, in terms of the first iterate, and what is broken.
    fn merit(&self, first: &Iterate) -> impl Fn(&Iterate) -> f64 + use<> {
        fn squares(of: &Iterate) -> f64 {
            of.chords.as_ref().map_or(0.0, |chords| sum_of_squares(&chords.places))
        }
        let step = first.step;
        let [travel, jerk] = [1, 3].map(|order| first.control.squares(order));
        let chords = squares(first);
        let (goal, margin, reach) = (self.goal, self.margin, self.reach);
        move |of| {
            let cost = match goal {
                Goal::Fastest => of.step / step,
                Goal::Shortest(_) => {
                    squares(of) / chords + SETTINGS.joint_share * of.control.squares(1) / travel
                }
                Goal::Smoothest(_) => of.control.squares(3) / jerk,
            };
            let all = of.samples.iter().flat_map(|sample| &sample.signed_distances);
            let depth = all.map(|it| (margin - it.distance) / reach).fold(0.0, f64::max);
            let excess = of
                .chords
                .as_ref()
                .and_then(|chords| Some((sum_of_chords(&chords.places) / chords.most? - 1.0).max(0.0)));
            cost + SETTINGS.penalty * depth + SETTINGS.length_penalty * excess.unwrap_or(0.0)
        }
    }

    /// Time between two knots (s); `None` where the limits do not allow what is asked.
    fn step(&self, control: &ControlPoints) -> Option<f64> {
        let least = control.least_step(self.constraints.limits);
        match self.goal {
            Goal::Fastest | Goal::Shortest(_) => Some(least),
            Goal::Smoothest(duration) => {
                let step = duration / control.pieces() as f64;
                (step >= least).then_some(step)
            }
        }
    }

    /// Whether `motion` is longer than it may be; if so the sum of chords may be less from now on.
    fn shorten(&mut self, control: &ControlPoints, motion: &Motion) -> bool {
        let arm = self.constraints.scene.arm();
        let (Some((length, most)), Some((_, chords))) = (self.constraints.longest, &mut self.longest) else {
            return false;
        };
        let exact = length.of(arm, motion);
        if exact <= most {
            return false;
        }
        let sum = sum_of_chords(&length.places(arm, control));
        *chords = (most * sum / exact).min(*chords) * (1.0 - SETTINGS.gain);
        true
    }

    /// Samples more closely from now on where something was touched at these times (s).
    fn sample_at(&mut self, times: &[f64], step: f64) {
        for time in times {
            for nearby in [-0.2, -0.1, 0.0, 0.1, 0.2] {
                let at = (time / step + nearby).clamp(0.0, SETTINGS.pieces as f64 - 1e-9);
                let place = (at as usize, at.fract());
                if !self.places.contains(&place) {
                    self.places.push(place);
                }
            }
        }
    }
}
