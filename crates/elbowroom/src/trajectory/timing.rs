use super::Piece;
use super::peak::peaks;
use super::spline::{Via, durations_by_length, joint_between};

/// Rounds of evening out the pieces; more gain less than a percent.
const ROUNDS: usize = 12;

/// Room left below the limits for rounding in other people's arithmetic.
const HEADROOM: f64 = 1.0 + 1e-9;

/// The fastest a joint may move, all of it known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedLimits {
    /// Greatest speed (rad/s).
    pub velocity: f64,
    /// Greatest acceleration (rad/s²).
    pub acceleration: f64,
    /// Greatest jerk (rad/s³).
    pub jerk: f64,
}

/// What the pieces of a planned motion last whole numbers of (s): samples taken this often meet every via, so that
/// the quintic curve through them is the motion itself.
pub const TICK: f64 = 0.01;

/// Rounds of giving single pieces more ticks before all are given more.
const TICK_ROUNDS: usize = 32;

/// Durations (s) of the pieces between `vias`, whole numbers of [`TICK`], as short as this search finds under
/// `limits`, joint by joint.
///
/// Pieces that press against a limit are given more time, the others less, a few rounds long; then all are
/// stretched by what the worst one needs.
pub fn fastest_durations(vias: &[Via], limits: &[SpeedLimits]) -> Vec<f64> {
    let durations = fastest_between_ticks(vias, limits);
    let mut ticks: Vec<f64> = durations.iter().map(|duration| (duration / TICK).ceil().max(1.0)).collect();
    for round in 0.. {
        let durations: Vec<f64> = ticks.iter().map(|count| count * TICK).collect();
        let slow_down: Vec<f64> =
            stretches(vias, &durations, limits).iter().map(|stretch| stretch * HEADROOM).collect();
        // A piece's neighbours shape it, so that lengthening one may press another: in the end all are lengthened.
        let worst = slow_down.iter().copied().fold(0.0, f64::max);
        if worst <= 1.0 || durations.is_empty() || !worst.is_finite() {
            return durations;
        }
        for (count, needed) in ticks.iter_mut().zip(slow_down) {
            let needed = if round < TICK_ROUNDS { needed } else { worst };
            if needed > 1.0 {
                *count = (*count * needed).ceil().max(*count + 1.0);
            }
        }
    }
    durations
}

/// `durations` stretched or shortened evenly to add up to `total` (s), each via moved to the nearest tick unless a
/// piece would be left without any.
pub fn rescaled(durations: &[f64], total: f64) -> Vec<f64> {
    let factor = total / durations.iter().sum::<f64>();
    let plain = || durations.iter().map(|duration| duration * factor).collect();
    let last = durations.len().saturating_sub(1);
    let (mut end, mut before) = (0.0, 0.0);
    let mut on_ticks = Vec::with_capacity(durations.len());
    for (i, duration) in durations.iter().enumerate() {
        end += duration * factor;
        let at = if i == last { total } else { (end / TICK).round() * TICK };
        if at - before < TICK / 2.0 {
            return plain();
        }
        on_ticks.push(at - before);
        before = at;
    }
    on_ticks
}

fn fastest_between_ticks(vias: &[Via], limits: &[SpeedLimits]) -> Vec<f64> {
    let mut durations = durations_by_length(vias, 1.0);
    let mut best: Option<(f64, Vec<f64>)> = None;
    for _ in 0..ROUNDS {
        let stretches = stretches(vias, &durations, limits);
        let worst = stretches.iter().copied().fold(0.0, f64::max) * HEADROOM;
        let total = durations.iter().sum::<f64>() * worst;
        if best.as_ref().is_none_or(|(least, _)| total < *least) {
            best = Some((total, durations.iter().map(|d| d * worst).collect()));
        }
        for (duration, stretch) in durations.iter_mut().zip(&stretches) {
            *duration *= (stretch / worst).clamp(0.1, 1.0).sqrt() * worst;
        }
    }
    best.map_or(durations, |(_, durations)| durations)
}

/// By what factor `piece` must be slowed down to keep within `limits`, one per joint; below 1 it could be faster.
pub fn stretch(piece: &Piece, limits: &[SpeedLimits]) -> f64 {
    let joints = piece.coefficients.iter().zip(limits);
    joints.map(|(position, limit)| joint_stretch(position, piece.duration, limit)).fold(0.0, f64::max)
}

/// [`stretch`] of each piece through `vias`.
fn stretches(vias: &[Via], durations: &[f64], limits: &[SpeedLimits]) -> Vec<f64> {
    let of_joint =
        |i: usize, j: usize| joint_stretch(&joint_between(vias, durations, i, j), durations[i], &limits[j]);
    (0..durations.len()).map(|i| (0..limits.len()).map(|j| of_joint(i, j)).fold(0.0, f64::max)).collect()
}

/// By what factor one joint must be slowed down to keep within `limit`.
pub(super) fn joint_stretch(position: &[f64; 6], duration: f64, limit: &SpeedLimits) -> f64 {
    let [speed, push, jolt] = peaks(position, duration);
    let (speed, push, jolt) = (speed / limit.velocity, push / limit.acceleration, jolt / limit.jerk);
    speed.max(push.sqrt()).max(libm::cbrt(jolt))
}
