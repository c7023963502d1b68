//! Whether pieces join.

use super::rate::Quantity;
use super::verdict::Violation;
use crate::arm::Joint;
use crate::trajectory::Piece;

/// A jump up to this share of what the polynomials' terms amount to is rounding, for all three quantities;
/// terms that amount to less than 1 count as 1.
pub const JUMP_ROUNDING: f64 = 1e-9;

const KINDS: [Quantity; 3] = [Quantity::Position, Quantity::Velocity, Quantity::Acceleration];

/// Reports the greatest jump of each kind per joint, and gives the greatest jump of position that passed as
/// rounding, per joint (rad).
///
/// Up to `continuous` nothing may jump. Beyond it a jump is compared with a joint that has a limit on a higher rate: to
/// jump in velocity takes more acceleration, and more jerk, than any limit allows.
pub(super) fn check(
    pieces: &[Piece],
    joints: &[Joint],
    continuous: Quantity,
    violations: &mut Vec<Violation>,
) -> Vec<f64> {
    let mut passed = vec![0.0_f64; joints.len()];
    let mut worst: Vec<[Option<(f64, f64)>; 3]> = vec![[None; 3]; joints.len()];
    for pair in pieces.windows(2) {
        let [before, after] = [&pair[0], &pair[1]];
        let end = before.start + before.duration;
        // Times join to within rounding of their own; what a joint would move in between counts as a jump.
        let gap = (after.start - end).abs();
        for (joint, worst) in worst.iter_mut().enumerate() {
            for (order, worst) in worst.iter_mut().enumerate() {
                let (left, left_size) = value(&before.coefficients[joint], order, before.duration);
                let (right, _) = value(&after.coefficients[joint], order, 0.0);
                let size = left_size.max(right.abs());
                let fastest = rate_size(before, joint).max(rate_size(after, joint));
                let drift = if order == 0 { gap * fastest } else { 0.0 };
                let jump = (right - left).abs() + drift;
                if jump <= JUMP_ROUNDING * size.max(1.0) {
                    if order == 0 {
                        passed[joint] = passed[joint].max(jump);
                    }
                } else if worst.is_none_or(|(most, _)| jump > most) {
                    *worst = Some((jump, after.start));
                }
            }
        }
    }
    for (joint, worst) in worst.iter().enumerate() {
        for (what, worst) in KINDS.into_iter().zip(worst) {
            let motion = joints[joint].motion;
            let limited = match what {
                Quantity::Position => true,
                Quantity::Velocity => motion.acceleration.is_some() || motion.jerk.is_some(),
                Quantity::Acceleration => motion.jerk.is_some(),
            };
            if let Some((jump, time)) = *worst
                && (what <= continuous || limited)
            {
                violations.push(Violation::Discontinuity { joint: joint + 1, what, time, jump });
            }
        }
    }
    passed
}

/// A derivative at `s` seconds into a piece, and the sum of the sizes of its terms.
fn value(terms: &[f64; 6], order: usize, s: f64) -> (f64, f64) {
    let mut power = 1.0;
    let (mut sum, mut size) = (0.0, 0.0);
    for (k, term) in terms.iter().enumerate().skip(order) {
        let factor: usize = (k + 1 - order..=k).product();
        let term = if *term == 0.0 { 0.0 } else { term * factor as f64 * power };
        sum += term;
        size += term.abs();
        power *= s;
    }
    (sum, size)
}

/// More than a joint's speed anywhere in the piece (rad/s).
fn rate_size(piece: &Piece, joint: usize) -> f64 {
    value(&piece.coefficients[joint], 1, piece.duration).1
}
