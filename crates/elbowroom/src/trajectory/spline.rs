use super::{Piece, State};
use crate::arm::Configuration;

/// Configurations nearer than this are one via (rad): a piece between them would last no time.
const SAME_CONFIGURATION: f64 = 1e-9;

/// A configuration that a motion is led through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Via {
    /// Where.
    pub q: Configuration<2>,
    /// Whether the arm comes to rest there; between two stops every joint turns evenly with the others, so
    /// the motion is straight in configuration space.
    pub stop: bool,
}

/// The vias at `places`, with stops at the ends only. A via that is where the one before it is, to within
/// rounding, is left out; first and last stay exact.
pub fn vias_at(places: &[Configuration<2>]) -> Vec<Via> {
    let mut vias: Vec<Via> = Vec::with_capacity(places.len());
    for q in places {
        if vias.last().is_none_or(|last| last.q.distance(q) > SAME_CONFIGURATION) {
            vias.push(Via { q: *q, stop: false });
        }
    }
    if let ([_, .., last], Some(goal)) = (&mut vias[..], places.last()) {
        last.q = *goal;
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
            pair[0].q.distance(&pair[1].q) * (1.0 + 0.5 * stops)
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
/// piece that stands still for no time.
pub fn quintic_through(vias: &[Via], durations: &[f64]) -> Vec<Piece<2>> {
    if let [only] = vias {
        let coefficients = only.q.0.map(|position| [position, 0.0, 0.0, 0.0, 0.0, 0.0]);
        return vec![Piece { start: 0.0, duration: 0.0, coefficients }];
    }
    let states: Vec<State<2>> = (0..vias.len())
        .map(|i| {
            if vias[i].stop || i == 0 || i + 1 == vias.len() {
                State::rest(vias[i].q.0)
            } else {
                parabola([&vias[i - 1], &vias[i], &vias[i + 1]], durations[i - 1], durations[i])
            }
        })
        .collect();
    let mut start = 0.0;
    durations
        .iter()
        .enumerate()
        .map(|(i, &duration)| {
            let piece = Piece::quintic(start, duration, &states[i], &states[i + 1]);
            start += duration;
            piece
        })
        .collect()
}

/// Velocity and acceleration at the middle one of three vias, `before` and `after` it (s).
fn parabola(vias: [&Via; 3], before: f64, after: f64) -> State<2> {
    let [a, b, c] = vias.map(|via| via.q.0);
    let slopes = |j: usize| ((b[j] - a[j]) / before, (c[j] - b[j]) / after);
    State {
        position: b,
        velocity: std::array::from_fn(|j| {
            let (s0, s1) = slopes(j);
            (s0 * after + s1 * before) / (before + after)
        }),
        acceleration: std::array::from_fn(|j| {
            let (s0, s1) = slopes(j);
            2.0 * (s1 - s0) / (before + after)
        }),
        jerk: [0.0; 2],
    }
}
