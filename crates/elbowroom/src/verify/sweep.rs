//! All links against all that they must not touch, over all of a motion: bisection in time with bounds on the motion.

use super::bernstein::Bernstein;
use super::clearance::Body;
use super::moving::Way;
use super::pairs::{Curves, Pair, Stretch, pairs};
use super::verdict::{Clearance, Violation};
use super::{FLOOR, VerifySettings};
use crate::geometry::Point;
use crate::scene::Scene;
use crate::trajectory::Piece;

/// An interval over which a link moves by no more than this (m) is not halved again.
const STILL: f64 = 0.05 * FLOOR;

/// Halvings after which an interval is not halved again.
const DEEPEST: u32 = 48;

/// Accuracy of the least clearance: this (m) or the share, whichever is more.
const ACCURACY: f64 = 1e-6;
const ACCURACY_SHARE: f64 = 0.01;

/// Looks between two questions whether to keep going.
const LOOKS_BETWEEN: u32 = 64;

/// Configurations per piece examined beforehand, for a first idea of the least clearance.
const GLANCES: u32 = 4;

/// The most pieces that are glanced at.
const GLANCED_AT: usize = 64;

/// Configurations examined for the depth of a contact, shared by the pieces; the least for one piece.
const SOUNDINGS: usize = 512;
const LEAST_SOUNDINGS: usize = 4;

/// Rounds of taking the better two thirds of a dip; each tells the place better by half.
const THIRDS: u32 = 40;

/// A motion, piece by piece, and a scene in time.
pub(super) struct Passage<'a> {
    pub(super) scene: &'a Scene,
    pub(super) pieces: &'a [&'a Piece],
    /// Jumps between pieces, which passed as rounding; they must not carry a link through what stays of the clearance:
    /// its way is kept on top.
    pub(super) passed_jumps: &'a [f64],
}

impl Passage<'_> {
    /// Does `work` with the pieces and with all links and what they must not touch.
    fn with_pairs<T>(&self, work: impl FnOnce(&[Stretch], &[Pair]) -> T) -> T {
        let arm = self.scene.arm();
        let stretches: Vec<Stretch> =
            self.pieces.iter().map(|piece| Stretch::new(piece, arm.self_collision())).collect();
        let obstacles = self.scene.obstacles();
        let bodies: Vec<Body> = obstacles.iter().map(|obstacle| Body::new(&obstacle.shape)).collect();
        // Each link in its own frame, for those after it.
        let lines: Vec<[Point; 2]> = match arm.self_collision() {
            true => {
                arm.lengths().iter().map(|&length| [Point::new(0.0, 0.0), Point::new(length, 0.0)]).collect()
            }
            false => Vec::new(),
        };
        let links: Vec<Body> = lines.iter().map(Body::segment).collect();
        let ways: Vec<Option<Way>> =
            obstacles.iter().map(|obstacle| obstacle.motion.as_ref().map(Way::new)).collect();
        let ends = stretches.first().zip(stretches.last());
        let times = ends.map_or([0.0; 2], |(first, last)| [first.time(0.0), last.time(1.0)]);
        let pairs = pairs(arm, &bodies, &ways, &links, self.passed_jumps, times);
        work(&stretches, &pairs)
    }

    /// Reports contacts and what stays undecided; gives the least clearance of all.
    pub(super) fn check(
        &self,
        settings: &VerifySettings,
        keep_going: &dyn Fn() -> bool,
        violations: &mut Vec<Violation>,
    ) -> Option<Clearance> {
        let mut judge = Judge::new(settings, keep_going, true);
        self.with_pairs(|stretches, pairs| {
            for pair in pairs {
                for stretch in stretches.iter().step_by(stretches.len().div_ceil(GLANCED_AT).max(1)) {
                    for glance in 0..GLANCES {
                        judge.glance(pair, stretch, f64::from(glance) / f64::from(GLANCES));
                    }
                }
            }
            let before = violations.len();
            for pair in pairs {
                if judge.stopped {
                    break;
                }
                violations.extend(judge.check_pair(pair, stretches));
            }
            if judge.stopped {
                violations.push(Violation::Stopped {
                    time: stretches.first().map_or(0.0, |stretch| stretch.start),
                });
            }
            let decided = violations.len() == before && !stretches.is_empty();
            judge.nearest.map(|nearest| Clearance {
                at_least: decided.then_some(judge.proved.min(nearest.distance)),
                ..nearest
            })
        })
    }

    /// When the first of the violations begins that [`check`](Self::check) would report (s), or `latest` if none does
    /// before; of any of them, if `any_will_do`.
    pub(super) fn clear_until(&self, settings: &VerifySettings, latest: f64, any_will_do: bool) -> f64 {
        let mut judge = Judge::new(settings, &|| true, false);
        self.with_pairs(|stretches, pairs| {
            let mut first = latest;
            for pair in pairs {
                let found = match judge.first_trouble(pair, stretches, first) {
                    Some(Trouble::Contact { stretch, fraction }) => stretches[stretch].time(fraction),
                    Some(Trouble::Undecided { time }) => time,
                    None => continue,
                };
                first = first.min(found);
                if any_will_do {
                    break;
                }
            }
            first
        })
    }
}

/// What keeps a pair from being clear.
enum Trouble {
    Contact { stretch: usize, fraction: f64 },
    Undecided { time: f64 },
}

/// What is known of one pair over one piece.
#[derive(Default)]
struct Progress {
    looks: u32,
    exhausted: bool,
    /// Where the pair could not be decided first.
    undecided: Option<f64>,
}

struct Judge<'a> {
    margin: f64,
    evaluations: u32,
    keep_going: &'a dyn Fn() -> bool,
    stopped: bool,
    /// Whether the least clearance is asked for.
    measures: bool,
    nearest: Option<Clearance>,
    /// Least of the bounds that closed the intervals so far (m).
    proved: f64,
}

impl<'a> Judge<'a> {
    fn new(settings: &VerifySettings, keep_going: &'a dyn Fn() -> bool, measures: bool) -> Self {
        Self {
            // Not `max`, which would turn a margin that is not a number into one that is.
            margin: if settings.margin <= FLOOR { FLOOR } else { settings.margin },
            evaluations: settings.evaluations,
            keep_going,
            stopped: false,
            measures,
            nearest: None,
            proved: f64::INFINITY,
        }
    }

    fn check_pair(&mut self, pair: &Pair, stretches: &[Stretch]) -> Option<Violation> {
        let (link, against) = (pair.link + 1, pair.against);
        match self.first_trouble(pair, stretches, f64::INFINITY)? {
            Trouble::Contact { stretch, fraction } => {
                let time = stretches[stretch].time(fraction);
                let depth = self.depth(pair, &stretches[stretch..], fraction);
                Some(Violation::Contact { time, link, against, depth })
            }
            Trouble::Undecided { time } => Some(Violation::Undecided { time, link, against }),
        }
    }

    /// The first contact of a pair or, where there is none, what is not decided, in the pieces that begin before `latest`
    /// (s).
    fn first_trouble(&mut self, pair: &Pair, stretches: &[Stretch], latest: f64) -> Option<Trouble> {
        let mut undecided = None;
        for (i, stretch) in stretches.iter().enumerate().take_while(|(_, stretch)| stretch.start < latest) {
            let mut progress = Progress::default();
            let at_start = pair.clearance_at(stretch, 0.0);
            let contact = if at_start > self.margin {
                self.first_contact(pair, stretch, pair.curves(stretch), (0.0, 1.0, 0), &mut progress)
            } else {
                Some(0.0)
            };
            if let Some(fraction) = contact {
                return Some(Trouble::Contact { stretch: i, fraction });
            }
            if let Some(fraction) = progress.undecided {
                undecided.get_or_insert(Trouble::Undecided { time: stretch.time(fraction) });
            }
            if progress.exhausted || self.stopped {
                break;
            }
        }
        undecided
    }

    /// The first contact (a fraction of the stretch) in the interval from `from`, `width` long, or `None` when
    /// there is none or it was not decided.
    fn first_contact(
        &mut self,
        pair: &Pair,
        stretch: &Stretch,
        curves: &[Bernstein<6>],
        (from, width, depth): (f64, f64, u32),
        progress: &mut Progress,
    ) -> Option<f64> {
        if !self.may_look(progress) {
            progress.undecided.get_or_insert(from);
            return None;
        }
        let (first, second): (Curves, Curves) = curves.iter().map(|curve| curve.halves().into()).unzip();
        let width = 0.5 * width;
        let middle = from + width;
        let at_middle = |k: usize| second[k].coefficients[0];
        let (time, times) = (stretch.time(middle), [from, from + 2.0 * width].map(|at| stretch.time(at)));
        let axis = pair.axis(time, (0..curves.len()).map(at_middle));

        let deviation = |k: usize| curves[k].deviation(at_middle(k));
        let carriers = pair.lengths[..curves.len() - 1].iter().enumerate();
        let carried: f64 = carriers.map(|(k, length)| length * deviation(k)).sum();
        let turn = deviation(curves.len() - 1);
        let enough = self.enough(progress);
        let (drift, [doubt, most_doubt]) = pair.spread(times, time);
        let lost = carried + drift + most_doubt + pair.rounding + pair.half_width;
        let hull = pair.body.distance_of_hull(&axis, turn) - lost;
        if hull > enough {
            self.proved = self.proved.min(hull);
            return None;
        }
        let clearance = pair.clearance(&axis, time);
        self.consider(pair, clearance, time);
        let touches = !is_above(clearance, self.margin);
        let still =
            depth == DEEPEST || carried + drift + (most_doubt - doubt) + pair.length() * turn <= STILL;
        if touches && still {
            return Some(middle);
        }
        if !touches {
            let kept = pair.body.distance_while_turning(&axis, turn) - lost;
            if kept > enough {
                self.proved = self.proved.min(kept);
                return None;
            }
            if still || !is_above(clearance - pair.rounding, self.margin) {
                progress.undecided.get_or_insert(middle);
                return None;
            }
        }
        let left = self.first_contact(pair, stretch, &first, (from, width, depth + 1), progress);
        if left.is_some() || touches {
            return left.or(Some(middle));
        }
        if progress.exhausted {
            return None;
        }
        self.first_contact(pair, stretch, &second, (middle, width, depth + 1), progress)
    }

    fn may_look(&mut self, progress: &mut Progress) -> bool {
        if progress.looks.is_multiple_of(LOOKS_BETWEEN) && !self.stopped {
            self.stopped = !(self.keep_going)();
        }
        progress.exhausted = self.stopped || progress.looks >= self.evaluations;
        progress.looks += 1;
        !progress.exhausted
    }

    /// The clearance (m) that an interval must be proved to have more of: the margin, and while there is
    /// budget to spare, nearly the least clearance.
    fn enough(&self, progress: &Progress) -> f64 {
        match &self.nearest {
            Some(nearest) if progress.looks <= self.evaluations / 2 => {
                let accuracy = (ACCURACY_SHARE * nearest.distance).max(ACCURACY);
                self.margin.max(nearest.distance - accuracy)
            }
            _ => self.margin,
        }
    }

    /// Looks at a configuration unless the disc around the other is too far away to matter.
    fn glance(&mut self, pair: &Pair, stretch: &Stretch, fraction: f64) {
        let axis = pair.axis_at(stretch, fraction);
        let time = stretch.time(fraction);
        let hull = pair.body.distance_of_hull(&axis, 0.0) - pair.half_width;
        if self.nearest.is_none_or(|nearest| hull < nearest.distance) {
            self.consider(pair, pair.clearance(&axis, time), time);
        }
    }

    fn note(&mut self, pair: &Pair, stretch: &Stretch, fraction: f64) -> f64 {
        let clearance = pair.clearance_at(stretch, fraction);
        self.consider(pair, clearance, stretch.time(fraction));
        clearance
    }

    fn consider(&mut self, pair: &Pair, distance: f64, time: f64) {
        if self.measures && self.nearest.is_none_or(|nearest| distance < nearest.distance) {
            let (link, against) = (pair.link + 1, pair.against);
            self.nearest = Some(Clearance { distance, at_least: None, time, link, against });
        }
    }

    /// By how much the clearance falls short of the margin (m) while the contact lasts that begins at
    /// `fraction` of the first stretch.
    fn depth(&mut self, pair: &Pair, stretches: &[Stretch], fraction: f64) -> f64 {
        let soundings = (SOUNDINGS / stretches.len().max(1)).max(LEAST_SOUNDINGS);
        let mut from = fraction;
        let mut least = f64::INFINITY;
        let mut around = None;
        'contact: for stretch in stretches {
            let step = (1.0 - from) / soundings as f64;
            for i in 0..=soundings {
                let place = from + step * i as f64;
                let clearance = self.note(pair, stretch, place);
                if clearance < least {
                    least = clearance;
                    around = Some((stretch, [(place - step).max(from), (place + step).min(1.0)]));
                }
                if i > 0 && is_above(clearance, self.margin) {
                    break 'contact;
                }
            }
            from = 0.0;
        }
        if let Some((stretch, around)) = around {
            least = least.min(self.bottom(pair, stretch, around));
        }
        self.margin - least
    }

    /// Clearance (m) at the bottom of a dip, by thirds.
    fn bottom(&mut self, pair: &Pair, stretch: &Stretch, [mut from, mut to]: [f64; 2]) -> f64 {
        for _ in 0..THIRDS {
            let third = (to - from) / 3.0;
            if pair.clearance_at(stretch, from + third) < pair.clearance_at(stretch, to - third) {
                to -= third;
            } else {
                from += third;
            }
        }
        self.note(pair, stretch, 0.5 * (from + to))
    }
}

/// `a > b`, spelled so that its opposite reads as what it is: not above, or not a number.
fn is_above(a: f64, b: f64) -> bool {
    a > b
}
