//! Rates of a trajectory from elsewhere, with what its rows tell: a limit is broken where any motion through the rows exceeds
//! it, and kept where the curve between them does, rounding aside; what lies in between is not judged, and said so.
//!
//! Contact is no matter of this: it is judged on the curve as it is, with no tolerance.

use super::bernstein::Bernstein;
use super::continuity::JUMP_ROUNDING;
use super::doubt::{Allowance, Allowed, Unjudged, Unknown};
use super::least_rate::{Least, least_rate};
use super::peak::Peak;
use super::rate::{Quantity, Rate};
use super::rows::{Column, Rows};
use super::verdict::Violation;
use crate::arm::Joint;
use crate::trajectory::{Curve, Piece};

/// A rate that is less certain than this share of its limit is not judged.
pub const SMALL: f64 = 0.1;

/// The most that rounding may put a joint beyond a stop (rad).
pub const STOP_DIGITS: f64 = 5e-6;

/// A piece whose jerk differs from what the one beside it leads to by no more than this share is a part of the same polynomial,
/// and no guess.
const SAME: f64 = 1e-3;

/// Rounding of a comparison with a limit, as a share of it.
const ROUNDING: f64 = 1e-12;

const RATES: [Rate; 3] = [Rate::Velocity, Rate::Acceleration, Rate::Jerk];

/// What is let pass and what is left open.
#[derive(Default)]
pub(super) struct Leniency {
    pub(super) allowed: Vec<Allowed>,
    pub(super) unjudged: Vec<Unjudged>,
}

/// Takes from the violations of rates and joint limits those that the rows do not prove, and adds those that only the rows prove.
pub(super) fn judge(
    rows: &Rows,
    joints: &[Joint],
    pieces: &[&Piece],
    violations: &mut Vec<Violation>,
) -> Leniency {
    let mut leniency = Leniency::default();
    if pieces.is_empty() {
        return leniency;
    }
    for (j, joint) in joints.iter().enumerate() {
        let limits = [joint.motion.velocity, joint.motion.acceleration, joint.motion.jerk]
            .map(|limit| limit.map(|limit| limit * (1.0 + rows.tolerance)));
        let Some(curve) = rows.curve else {
            tolerate(j, &limits, violations, &mut leniency);
            continue;
        };
        let column = Column::of(rows, curve, pieces, j);
        let rests = forgive_ends(&column, j, &limits, violations);
        let jumps = jumps(&column, j);
        for (rate, limit) in RATES.into_iter().zip(limits) {
            let Some(limit) = limit else { continue };
            let stated = limit / (1.0 + rows.tolerance);
            let judged = Judged { column: &column, j, rate, limit, stated };
            // What a curve lets jump by its nature: the velocity of a linear one, the acceleration of a cubic one.
            let jump = (rate.order() > by_nature(curve)).then_some(jumps.or(rests)).flatten();
            judged.judge(jump, violations, &mut leniency);
        }
        forgive_stops(&column, j, violations, &mut leniency);
    }
    leniency
}

/// Where a rate may jump between pieces, or at an end: at a guess or beyond.
#[derive(Clone, Copy, PartialEq)]
enum Jump {
    AtGuess,
    Elsewhere,
}

/// The order of the highest derivative that does not jump by the curve's nature.
const fn by_nature(curve: Curve) -> usize {
    match curve {
        Curve::Linear => 1,
        Curve::Cubic => 2,
        Curve::Quintic => 3,
    }
}

struct Judged<'a> {
    column: &'a Column<'a>,
    j: usize,
    rate: Rate,
    /// With tolerance.
    limit: f64,
    /// Without.
    stated: f64,
}

impl Judged<'_> {
    fn judge(&self, jump: Option<Jump>, violations: &mut Vec<Violation>, leniency: &mut Leniency) {
        let (joint, rate, limit, order) = (self.j + 1, self.rate, self.limit, self.rate.order());
        let mut highest = Peak::NONE;
        // The pieces where the curve is beyond the limit, and whether all of them are guesses.
        let mut excess: Option<(usize, f64)> = None;
        let (mut all_guessed, mut all_near) = (true, true);
        let mut error = (0.0, 0, Quantity::Position);
        for (i, piece) in self.column.pieces.iter().enumerate() {
            let peak = peak(piece, self.j, order);
            let (spread, what) = self.column.spread(i, order);
            if spread > error.0 {
                error = (spread, i, what);
            }
            if peak.bound > highest.bound {
                highest = peak;
            }
            if peak.bound <= (limit + spread) * (1.0 + ROUNDING) {
                continue;
            }
            let difference = self.difference(i);
            if difference.is_some_and(|difference| peak.bound <= limit + spread + difference) {
                continue;
            }
            all_guessed &= self.column.is_guess(i) && difference.is_none();
            all_near &= peak.bound <= limit * (1.0 + SMALL) + spread;
            if excess.is_none_or(|(_, most)| peak.bound > most) {
                excess = Some((i, peak.bound));
            }
        }
        let uncertain = error.0 > SMALL * limit;
        if !uncertain && jump.is_none() && highest.bound <= self.stated * (1.0 + ROUNDING) {
            return;
        }
        let least = least_rate(self.column, order);
        if least.value > limit * (1.0 + ROUNDING) {
            self.report(least, &highest, uncertain, jump, violations);
            return;
        }
        let spacing = |i: usize| self.column.pieces[i].duration;
        let unjudged = |cause| Unjudged { joint, rate, limit: self.stated, at_least: least.value, cause };
        if uncertain {
            let (error, i, what) = error;
            let quantum = self.column.quanta[what.order()];
            self.withdraw(violations);
            let cause = Unknown::Rounding { what, quantum, spacing: spacing(i), error };
            leniency.unjudged.push(unjudged(cause));
            return;
        }
        if jump == Some(Jump::Elsewhere) || (excess.is_some() && !all_guessed) {
            return;
        }
        self.withdraw(violations);
        if jump.is_some() {
            let spacing = self.column.pieces.iter().map(|piece| piece.duration).fold(0.0, f64::max);
            leniency.unjudged.push(unjudged(Unknown::Spacing { spacing, reached: None }));
            return;
        }
        let by = match excess {
            Some((i, reached)) if !all_near => {
                let cause = Unknown::Spacing { spacing: spacing(i), reached: Some(reached) };
                leniency.unjudged.push(unjudged(cause));
                return;
            }
            Some(_) => Allowance::Spacing,
            None if highest.bound <= limit * (1.0 + ROUNDING) => Allowance::Tolerance,
            None => Allowance::Rounding,
        };
        leniency.allowed.push(Allowed {
            joint,
            rate: Some(rate),
            value: highest.bound,
            limit: self.stated,
            by,
        });
    }

    /// That any motion through the rows breaks the limit; by what the curve reaches where that is known well.
    fn report(
        &self,
        least: Least,
        highest: &Peak,
        uncertain: bool,
        jump: Option<Jump>,
        violations: &mut Vec<Violation>,
    ) {
        let found = violations.iter().any(|one| self.is_of(one));
        if found && !uncertain && jump != Some(Jump::AtGuess) {
            return;
        }
        self.withdraw(violations);
        let exact = !uncertain && jump.is_none();
        let (value, time) = if exact { (highest.bound, highest.time) } else { (least.value, least.time) };
        let (joint, rate, limit) = (self.j + 1, self.rate, self.stated);
        violations.push(Violation::MotionLimit { joint, rate, time, value, limit });
    }

    fn withdraw(&self, violations: &mut Vec<Violation>) {
        violations.retain(|one| !self.is_of(one));
    }

    /// Whether a violation is that of this limit: the rate itself, or a jump of the rate below it that the curve has by nature.
    fn is_of(&self, violation: &Violation) -> bool {
        match *violation {
            Violation::MotionLimit { joint, rate, .. } => joint == self.j + 1 && rate == self.rate,
            Violation::Discontinuity { joint, what, .. } => {
                joint == self.j + 1
                    && what.order() == by_nature(self.column.curve)
                    && self.rate.order() > what.order()
            }
            _ => false,
        }
    }

    /// By how much the rate in piece `i` differs from what a piece beside it leads to, if that makes them one polynomial.
    fn difference(&self, i: usize) -> Option<f64> {
        let pieces = self.column.pieces;
        if self.column.curve != Curve::Quintic || !self.column.sampled {
            return None;
        }
        let here = pieces[i];
        let greatest = peak(here, self.j, 3).bound;
        let beside = [i.checked_sub(1), (i + 1 < pieces.len()).then_some(i + 1)];
        let differs = |other: usize| {
            let other = pieces[other];
            let shift = here.start - other.start;
            let at = [0.0, 0.5, 1.0].map(|fraction| {
                let s = fraction * here.duration;
                (jerk(&here.coefficients[self.j], s) - jerk(&other.coefficients[self.j], s + shift)).abs()
            });
            at.into_iter().fold(0.0, f64::max)
        };
        let least = beside.into_iter().flatten().map(differs).fold(f64::INFINITY, f64::min);
        let rounding = 8.0 * self.column.spread(i, 3).0;
        let same = least <= SAME * greatest + rounding;
        same.then(|| (self.rate.order()..3).fold(least, |difference, _| difference * here.duration))
    }
}

fn jerk(terms: &[f64; 6], s: f64) -> f64 {
    6.0 * terms[3] + s * (24.0 * terms[4] + s * 60.0 * terms[5])
}

/// Of the absolute value of the rate of this order over a piece.
fn peak(piece: &Piece, j: usize, order: usize) -> Peak {
    let mut peak = Peak::NONE;
    let terms = &piece.coefficients[j];
    let mut raise = |terms: &[f64; 6]| match order {
        1 => peak.raise(&Bernstein::<5>::derivative(terms, 1, piece.duration), piece.start, piece.duration),
        2 => peak.raise(&Bernstein::<4>::derivative(terms, 2, piece.duration), piece.start, piece.duration),
        _ => peak.raise(&Bernstein::<3>::derivative(terms, 3, piece.duration), piece.start, piece.duration),
    };
    raise(terms);
    raise(&terms.map(|term| -term));
    peak
}

/// Whether the derivative jumps that the curve lets jump by nature.
fn jumps(column: &Column, j: usize) -> Option<Jump> {
    let order = by_nature(column.curve);
    if order == 3 {
        return None;
    }
    let derivative = |piece: &Piece, s: f64| {
        let terms = piece.coefficients[j];
        (order..6).rev().fold(0.0, |sum, k| {
            let factor: usize = (k + 1 - order..=k).product();
            sum * s + terms[k] * factor as f64
        })
    };
    let mut found = None;
    for i in 1..column.pieces.len() {
        let (before, after) = (column.pieces[i - 1], column.pieces[i]);
        let (left, right) = (derivative(before, before.duration), derivative(after, 0.0));
        if (right - left).abs() > JUMP_ROUNDING * left.abs().max(right.abs()).max(1.0) {
            if !(column.is_guess(i - 1) && column.is_guess(i)) {
                return Some(Jump::Elsewhere);
            }
            found = Some(Jump::AtGuess);
        }
    }
    found
}

/// Takes back that a joint does not rest at an end where the rows are those of a motion that may: within rounding, and by the
/// limits on its rates.
fn forgive_ends(
    column: &Column,
    j: usize,
    limits: &[Option<f64>; 3],
    violations: &mut Vec<Violation>,
) -> Option<Jump> {
    let mut forgiven = None;
    violations.retain(|one| {
        let Violation::NotAtRest { joint, at_end, what, .. } = *one else { return true };
        let piece = if at_end { column.pieces.len() - 1 } else { 0 };
        if joint != j + 1 || what.order() != by_nature(column.curve) || !column.is_guess(piece) {
            return true;
        }
        let may = may_rest(column, at_end, limits);
        if may {
            forgiven = Some(Jump::AtGuess);
        }
        !may
    });
    forgiven
}

/// Whether a joint that rests at an end can be where the rows next to it say.
fn may_rest(column: &Column, at_end: bool, limits: &[Option<f64>; 3]) -> bool {
    let count = column.times.len();
    let from_end = |k: usize| if at_end { count - 1 - k } else { k };
    let rest = from_end(0);
    (1..count.min(8)).all(|k| {
        let row = from_end(k);
        let t = (column.times[row] - column.times[rest]).abs();
        column.series.iter().enumerate().all(|(order, series)| {
            let way = (series[row].0 - series[rest].0).abs() - series[row].1 - series[rest].1;
            let mut most = 1.0;
            limits.iter().enumerate().skip(order).all(|(k, limit)| {
                most *= t / (k + 1 - order) as f64;
                limit.is_none_or(|limit| way <= limit * most * (1.0 + 1e-9))
            })
        })
    })
}

/// Lets a joint be beyond a stop by what the rounding of its rows may have put it there.
fn forgive_stops(column: &Column, j: usize, violations: &mut Vec<Violation>, leniency: &mut Leniency) {
    if column.quanta[0] == 0.0 {
        return;
    }
    let most = (0..column.pieces.len()).map(|i| column.spread(i, 0).0).fold(0.0, f64::max).min(STOP_DIGITS);
    violations.retain(|one| {
        let Violation::JointLimit { joint, angle, limit, .. } = *one else { return true };
        if joint != j + 1 || (angle - limit).abs() > most {
            return true;
        }
        let by = Allowance::Rounding;
        leniency.allowed.push(Allowed { joint, rate: None, value: angle, limit, by });
        false
    });
}

/// Lets rates be beyond their limits by the tolerance.
fn tolerate(j: usize, limits: &[Option<f64>; 3], violations: &mut Vec<Violation>, leniency: &mut Leniency) {
    violations.retain(|one| {
        let Violation::MotionLimit { joint, rate, value, limit, .. } = *one else { return true };
        let most = limits[rate.order() - 1].unwrap_or(limit);
        if joint != j + 1 || value > most * (1.0 + ROUNDING) {
            return true;
        }
        leniency.allowed.push(Allowed { joint, rate: Some(rate), value, limit, by: Allowance::Tolerance });
        false
    });
}
