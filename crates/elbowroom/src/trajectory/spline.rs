use super::piece::quintic;
use super::{Piece, State};
use crate::arm::joint_distance;

/// Configurations nearer than this are one via (rad): a piece between them would last no time.
const SAME_CONFIGURATION: f64 = 1e-9;

/// A configuration that a motion is led through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Via<'a> {
    /// Where, one position per joint (rad).
    pub q: &'a [f64],
    /// Whether the arm comes to rest there; between two stops every joint turns evenly with the others, so
    /// the motion is straight in configuration space.
    pub stop: bool,
}

/// The vias at `places`, with stops at the ends only. A via that is where the one before it is, to within
/// rounding, is left out; first and last stay exact.
pub fn vias_at<Q: AsRef<[f64]>>(places: &[Q]) -> Vec<Via<'_>> {
    let mut vias: Vec<Via<'_>> = Vec::with_capacity(places.len());
    for q in places {
        let q = q.as_ref();
        if vias.last().is_none_or(|last| joint_distance(last.q, q) > SAME_CONFIGURATION) {
            vias.push(Via { q, stop: false });
        }
    }
    if let ([_, .., last], Some(goal)) = (&mut vias[..], places.last()) {
        last.q = goal.as_ref();
    }
    if let [first, .., last] = &mut vias[..] {
        first.stop = true;
        last.stop = true;
    }
    vias
}

/// How to share `duration` (s) among the pieces between `vias`: by length in configuration space, with half
/// as much again for each end at rest.
pub fn durations_by_length(vias: &[Via], duration: f64) -> Vec<f64> {
    let shares: Vec<f64> = vias
        .windows(2)
        .map(|pair| {
            let stops = f64::from(u8::from(pair[0].stop)) + f64::from(u8::from(pair[1].stop));
            joint_distance(pair[0].q, pair[1].q) * (1.0 + 0.5 * stops)
        })
        .collect();
    let sum: f64 = shares.iter().sum();
    shares.iter().map(|share| duration * (share / sum)).collect()
}

/// Quintic pieces through `vias`, one per duration (s); position, velocity and acceleration are continuous
/// (eqs (11) to (21) of the paper).
///
/// The paper leaves open how fast a via is passed. Here it is passed with the velocity and acceleration of
/// the parabola through it and its neighbours, or at rest where it is a stop. A single via gives a single
/// piece that is at rest for no time.
pub fn quintic_through(vias: &[Via], durations: &[f64]) -> Vec<Piece> {
    if let [only] = vias {
        let coefficients = only.q.iter().map(|&position| [position, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
        return vec![Piece { start: 0.0, duration: 0.0, coefficients }];
    }
    let mut start = 0.0;
    durations
        .iter()
        .enumerate()
        .map(|(i, &duration)| {
            let coefficients = (0..vias[i].q.len()).map(|j| joint_between(vias, durations, i, j)).collect();
            let piece = Piece { start, duration, coefficients };
            start += duration;
            piece
        })
        .collect()
}

/// The polynomial of joint `j` in piece `i` of [`quintic_through`].
pub(super) fn joint_between(vias: &[Via], durations: &[f64], i: usize, j: usize) -> [f64; 6] {
    quintic(passing(vias, durations, i, j), passing(vias, durations, i + 1, j), durations[i])
}

/// [`joint_between`] for an arm that is at the first via as `state` says, instead of at rest.
pub(super) fn joint_from(state: &State, vias: &[Via], durations: &[f64], i: usize, j: usize) -> [f64; 6] {
    let from = if i == 0 {
        [state.position[j], state.velocity[j], state.acceleration[j]]
    } else {
        passing(vias, durations, i, j)
    };
    quintic(from, passing(vias, durations, i + 1, j), durations[i])
}

/// Position, velocity and acceleration of joint `j` at via `i`.
fn passing(vias: &[Via], durations: &[f64], i: usize, j: usize) -> [f64; 3] {
    let position = vias[i].q[j];
    if vias[i].stop || i == 0 || i + 1 == vias.len() {
        return [position, 0.0, 0.0];
    }
    let (before, after) = (durations[i - 1], durations[i]);
    let slope_before = (position - vias[i - 1].q[j]) / before;
    let slope_after = (vias[i + 1].q[j] - position) / after;
    let velocity = (slope_before * after + slope_after * before) / (before + after);
    [position, velocity, 2.0 * (slope_after - slope_before) / (before + after)]
}
