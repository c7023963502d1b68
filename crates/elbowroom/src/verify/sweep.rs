//! Both links against all obstacles, over all of a motion: bisection in time with bounds on the motion.

use super::bernstein::Bernstein;
use super::clearance::{Axis, Body};
use super::verdict::{Clearance, Violation};
use super::{FLOOR, VerifySettings};
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

/// Configurations per piece looked at beforehand, for a first idea of the least clearance.
const GLANCES: u32 = 4;

/// The most pieces that are glanced at.
const GLANCED_AT: usize = 64;

/// Configurations looked at for the depth of a contact, shared by the pieces; the least for one piece.
const SOUNDINGS: usize = 512;
const LEAST_SOUNDINGS: usize = 4;

/// Rounds of taking the better two thirds of a dip; each tells the place better by half.
const THIRDS: u32 = 40;

/// Directions of what a link is made of over one piece (rad).
#[derive(Clone, Copy)]
struct Curves {
    /// Of the arm that carries the link's start.
    carrier: Bernstein<6>,
    /// Of the link itself.
    link: Bernstein<6>,
}

impl Curves {
    fn halves(&self) -> [Self; 2] {
        let ([c0, c1], [l0, l1]) = (self.carrier.halves(), self.link.halves());
        [Self { carrier: c0, link: l0 }, Self { carrier: c1, link: l1 }]
    }
}

/// One piece, for both links.
struct Stretch {
    start: f64,
    duration: f64,
    links: [Curves; 2],
}

impl Stretch {
    fn new(piece: &Piece<2>) -> Self {
        let [q1, q2] =
            piece.coefficients.each_ref().map(|terms| Bernstein::derivative(terms, 0, piece.duration));
        let sum = q1.plus(&q2);
        let links = [Curves { carrier: q1, link: q1 }, Curves { carrier: q1, link: sum }];
        Self { start: piece.start, duration: piece.duration, links }
    }

    fn time(&self, fraction: f64) -> f64 {
        self.start + self.duration * fraction
    }
}

/// Reports contacts and what stays undecided; gives the least clearance of all. A jump between pieces, which
/// passed as rounding, must not carry a link through what stays of the clearance: its way is kept on top.
pub(super) fn check(
    scene: &Scene,
    pieces: &[Piece<2>],
    passed_jumps: [f64; 2],
    settings: &VerifySettings,
    keep_going: &dyn Fn() -> bool,
    violations: &mut Vec<Violation>,
) -> Option<Clearance> {
    let stretches: Vec<Stretch> = pieces.iter().map(Stretch::new).collect();
    let bodies: Vec<Body> = scene.obstacles.iter().map(|obstacle| Body::new(&obstacle.shape)).collect();
    let [l1, l2] = scene.arm.lengths();
    let base = [scene.arm.base().x, scene.arm.base().y];
    let half_width = scene.arm.half_width();
    let reach = base[0].abs() + base[1].abs() + l1 + l2 + half_width;
    let [jump1, jump2] = passed_jumps;
    let pairs = bodies.iter().enumerate().flat_map(|(obstacle, body)| {
        let rounding = body.rounding(reach) + (l1 + l2) * jump1 + l2 * jump2;
        let pair = move |link: usize, carrier: f64, length: f64| Pair {
            body,
            link,
            obstacle,
            base,
            carrier,
            length,
            half_width,
            rounding,
        };
        [pair(0, 0.0, l1), pair(1, l1, l2)]
    });
    // Not `max`, which would turn a margin that is not a number into one that is.
    let margin = if settings.margin <= FLOOR { FLOOR } else { settings.margin };
    let mut judge = Judge {
        margin,
        evaluations: settings.evaluations,
        keep_going,
        stopped: false,
        nearest: None,
        proved: f64::INFINITY,
    };
    for pair in pairs.clone() {
        for stretch in stretches.iter().step_by(stretches.len().div_ceil(GLANCED_AT).max(1)) {
            for glance in 0..GLANCES {
                judge.glance(&pair, stretch, f64::from(glance) / f64::from(GLANCES));
            }
        }
    }
    let before = violations.len();
    for pair in pairs {
        if judge.stopped {
            break;
        }
        violations.extend(judge.check_pair(&pair, &stretches));
    }
    if judge.stopped {
        violations.push(Violation::Stopped { time: stretches.first().map_or(0.0, |stretch| stretch.start) });
    }
    let decided = violations.len() == before && !stretches.is_empty();
    judge.nearest.map(|nearest| Clearance {
        at_least: decided.then_some(judge.proved.min(nearest.distance)),
        ..nearest
    })
}

/// One link and one obstacle.
#[derive(Clone, Copy)]
struct Pair<'a> {
    body: &'a Body<'a>,
    link: usize,
    obstacle: usize,
    base: [f64; 2],
    /// From the base to the link's start (m).
    carrier: f64,
    length: f64,
    half_width: f64,
    /// How far a clearance may be off (m).
    rounding: f64,
}

impl Pair<'_> {
    /// The link's centre line, with carrier and link in these directions (rad).
    fn axis(&self, carrier: f64, link: f64) -> Axis {
        let mut start = self.base;
        if self.carrier > 0.0 {
            let (sin, cos) = libm::sincos(carrier);
            start = [start[0] + self.carrier * cos, start[1] + self.carrier * sin];
        }
        let (sin, cos) = libm::sincos(link);
        Axis { start, along: [cos, sin], length: self.length }
    }

    fn clearance(&self, axis: &Axis) -> f64 {
        self.body.distance(axis) - self.half_width
    }

    fn axis_at(&self, stretch: &Stretch, fraction: f64) -> Axis {
        let curves = &stretch.links[self.link];
        self.axis(curves.carrier.value(fraction), curves.link.value(fraction))
    }

    fn clearance_at(&self, stretch: &Stretch, fraction: f64) -> f64 {
        self.clearance(&self.axis_at(stretch, fraction))
    }
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
    nearest: Option<Clearance>,
    /// Least of the bounds that closed the intervals so far (m).
    proved: f64,
}

impl Judge<'_> {
    fn check_pair(&mut self, pair: &Pair, stretches: &[Stretch]) -> Option<Violation> {
        let (link, obstacle) = (pair.link + 1, pair.obstacle);
        let mut undecided = None;
        for (i, stretch) in stretches.iter().enumerate() {
            let mut progress = Progress::default();
            let at_start = pair.clearance_at(stretch, 0.0);
            let contact = if at_start > self.margin {
                self.first_contact(pair, stretch, &stretch.links[pair.link], (0.0, 1.0, 0), &mut progress)
            } else {
                Some(0.0)
            };
            if let Some(fraction) = contact {
                let time = stretch.time(fraction);
                let depth = self.depth(pair, &stretches[i..], fraction);
                return Some(Violation::Contact { time, link, obstacle, depth });
            }
            if let Some(fraction) = progress.undecided {
                undecided.get_or_insert(Violation::Undecided {
                    time: stretch.time(fraction),
                    link,
                    obstacle,
                });
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
        curves: &Curves,
        (from, width, depth): (f64, f64, u32),
        progress: &mut Progress,
    ) -> Option<f64> {
        if !self.may_look(progress) {
            progress.undecided.get_or_insert(from);
            return None;
        }
        let halves = curves.halves();
        let width = 0.5 * width;
        let middle = from + width;
        let [carrier, link] = [halves[1].carrier.coefficients[0], halves[1].link.coefficients[0]];
        let axis = pair.axis(carrier, link);

        let carried = if pair.carrier > 0.0 { pair.carrier * curves.carrier.deviation(carrier) } else { 0.0 };
        let turn = curves.link.deviation(link);
        let enough = self.enough(progress);
        let lost = carried + pair.rounding + pair.half_width;
        let hull = pair.body.distance_of_hull(&axis, turn) - lost;
        if hull > enough {
            self.proved = self.proved.min(hull);
            return None;
        }
        let clearance = pair.clearance(&axis);
        self.consider(pair, clearance, stretch.time(middle));
        let touches = !is_above(clearance, self.margin);
        let still = depth == DEEPEST || carried + pair.length * turn <= STILL;
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
        let left = self.first_contact(pair, stretch, &halves[0], (from, width, depth + 1), progress);
        if left.is_some() || touches {
            return left.or(Some(middle));
        }
        if progress.exhausted {
            return None;
        }
        self.first_contact(pair, stretch, &halves[1], (middle, width, depth + 1), progress)
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

    /// Looks at a configuration unless the disc around the obstacle is too far away to matter.
    fn glance(&mut self, pair: &Pair, stretch: &Stretch, fraction: f64) {
        let axis = pair.axis_at(stretch, fraction);
        let hull = pair.body.distance_of_hull(&axis, 0.0) - pair.half_width;
        if self.nearest.is_none_or(|nearest| hull < nearest.distance) {
            self.consider(pair, pair.clearance(&axis), stretch.time(fraction));
        }
    }

    fn note(&mut self, pair: &Pair, stretch: &Stretch, fraction: f64) -> f64 {
        let clearance = pair.clearance_at(stretch, fraction);
        self.consider(pair, clearance, stretch.time(fraction));
        clearance
    }

    fn consider(&mut self, pair: &Pair, distance: f64, time: f64) {
        if self.nearest.is_none_or(|nearest| distance < nearest.distance) {
            let (link, obstacle) = (pair.link + 1, pair.obstacle);
            self.nearest = Some(Clearance { distance, at_least: None, time, link, obstacle });
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
