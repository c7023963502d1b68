//! Positions, velocities, accelerations and jerks against what the joints allow.

use super::bernstein::Bernstein;
use super::peak::Peak;
use super::rate::Rate;
use super::verdict::{JointMargin, MotionMargin, MotionMargins, Violation};
use crate::arm::{Joint, JointLimits};
use crate::trajectory::{Motion, Piece};

/// How far beyond a stop rounding may put a joint besides that of its polynomial (rad), and the share of the stop's angle to
/// add. All of it together is less than 1e-10 of the angle: the terms of a polynomial of degree five amount to no more than
/// 3363 times its greatest value over the interval (Chebyshev), so a joint that is truly beyond is not let pass for their size.
const STOP_ROUNDING: f64 = 1e-12;
const STOP_ROUNDING_SHARE: f64 = 64.0 * f64::EPSILON;

/// How far above a motion limit rounding may put a rate, as a share of the limit.
const RATE_ROUNDING: f64 = 1e-12;

/// What one joint does over a motion.
pub(super) struct JointReport {
    pub(super) stops: Option<JointMargin>,
    pub(super) motion: MotionMargins,
}

/// Looks at joint `j` (from 0) over the pieces whose numbers can be worked with.
pub(super) fn check<'a>(
    joint: &Joint,
    j: usize,
    pieces: impl Iterator<Item = &'a Piece>,
    violations: &mut Vec<Violation>,
) -> JointReport {
    let mut highest = Peak::NONE;
    let mut lowest = Peak::NONE;
    let mut rates = [Peak::NONE; 3];
    for piece in pieces {
        let terms = &piece.coefficients[j];
        let raise = |peak: &mut Peak, terms: &[f64; 6]| {
            let position: Bernstein<6> = Bernstein::derivative(terms, 0, piece.duration);
            peak.raise(&position, piece.start, piece.duration);
        };
        if matches!(joint.limits, JointLimits::Range { .. }) {
            raise(&mut highest, terms);
            raise(&mut lowest, &terms.map(|term| -term));
        }
        let velocity: Bernstein<5> = Bernstein::derivative(terms, 1, piece.duration);
        let acceleration: Bernstein<4> = Bernstein::derivative(terms, 2, piece.duration);
        let jerk: Bernstein<3> = Bernstein::derivative(terms, 3, piece.duration);
        raise_size(&mut rates[0], &velocity, piece);
        raise_size(&mut rates[1], &acceleration, piece);
        raise_size(&mut rates[2], &jerk, piece);
    }
    let stops = stop_margin(joint, j, &highest, &lowest, violations);
    let limits = [
        (Rate::Velocity, joint.motion.velocity),
        (Rate::Acceleration, joint.motion.acceleration),
        (Rate::Jerk, joint.motion.jerk),
    ];
    let mut margins = limits.iter().zip(&rates).map(|(&(rate, limit), peak)| {
        if let Some(limit) = limit.filter(|limit| !within(peak.bound, *limit)) {
            let value = peak.bound;
            violations.push(Violation::MotionLimit { joint: j + 1, rate, time: peak.time, value, limit });
        }
        MotionMargin { largest: peak.value.max(0.0), time: peak.time, limit }
    });
    let mut margin = || margins.next().unwrap_or(MotionMargin { largest: 0.0, time: 0.0, limit: None });
    let motion = MotionMargins { velocity: margin(), acceleration: margin(), jerk: margin() };
    JointReport { stops, motion }
}

fn within(bound: f64, limit: f64) -> bool {
    bound <= limit * (1.0 + RATE_ROUNDING)
}

fn raise_size<const N: usize>(peak: &mut Peak, rate: &Bernstein<N>, piece: &Piece) {
    peak.raise(rate, piece.start, piece.duration);
    peak.raise(&rate.negated(), piece.start, piece.duration);
}

fn stop_margin(
    joint: &Joint,
    j: usize,
    highest: &Peak,
    lowest: &Peak,
    violations: &mut Vec<Violation>,
) -> Option<JointMargin> {
    let JointLimits::Range { min, max } = joint.limits else { return None };
    for (peak, sign, limit) in [(lowest, -1.0, min), (highest, 1.0, max)] {
        let angle = sign * peak.bound;
        let beyond = peak.unrounded - sign * limit;
        if beyond > STOP_ROUNDING + STOP_ROUNDING_SHARE * limit.abs() {
            violations.push(Violation::JointLimit { joint: j + 1, time: peak.time, angle, limit });
        }
    }
    let margins = [(max - highest.value, highest.time), (-lowest.value - min, lowest.time)];
    let [above, below] = margins.map(|(distance, time)| JointMargin { distance, time });
    Some(if above.distance < below.distance { above } else { below })
}

/// The pieces of a motion whose numbers the arithmetic can work with; the first of the others per joint is
/// reported.
pub(super) fn workable_pieces<'a>(motion: &'a Motion, violations: &mut Vec<Violation>) -> Vec<&'a Piece> {
    let mut reported = vec![false; motion.joints()];
    let is_workable = |piece: &&Piece| {
        let mut all = true;
        for (j, terms) in piece.coefficients.iter().enumerate() {
            let finite = Bernstein::<6>::derivative(terms, 0, piece.duration).is_finite()
                && Bernstein::<5>::derivative(terms, 1, piece.duration).is_finite()
                && Bernstein::<4>::derivative(terms, 2, piece.duration).is_finite()
                && Bernstein::<3>::derivative(terms, 3, piece.duration).is_finite();
            if !finite && !reported[j] {
                reported[j] = true;
                violations.push(Violation::TooLarge { joint: j + 1, time: piece.start });
            }
            all &= finite;
        }
        all
    };
    motion.pieces().iter().filter(is_workable).collect()
}
