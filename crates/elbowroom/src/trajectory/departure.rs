use super::motion::{Motion, MotionError};
use super::piece::{Piece, State};
use super::spline::{Via, joint_from};
use super::timing::{SpeedLimits, TICK, fastest_durations, joint_stretch};

/// How long the first piece may last, as a multiple of what it would from rest.
const FIRST: [f64; 8] = [0.4, 0.6, 0.8, 1.0, 1.3, 1.7, 2.5, 4.0];

/// How long the others may last.
const OTHERS: [f64; 6] = [1.0, 1.2, 1.5, 2.0, 3.0, 5.0];

/// A motion that takes over at `start` (s) from an arm that moves, `state`, and leads it through `vias`, the first of
/// which is where it is, to rest at the last: no jump in position, velocity or acceleration.
///
/// As fast as this search finds under `limits`, one per joint; `None` where it finds nothing. Durations are whole
/// numbers of [`TICK`].
///
/// # Errors
/// [`MotionError`] where the polynomials overflow.
pub fn departing(
    start: f64,
    state: &State,
    vias: &[Via],
    limits: &[SpeedLimits],
) -> Result<Option<Motion>, MotionError> {
    if vias.len() < 2 {
        return Ok(None);
    }
    let from_rest = fastest_durations(vias, limits);
    let ticks = |duration: f64| (duration / TICK).ceil().max(1.0) * TICK;
    let mut tried: Vec<(f64, Vec<f64>)> = FIRST
        .iter()
        .flat_map(|first| OTHERS.iter().map(move |others| (*first, *others)))
        .map(|(first, others)| {
            let durations = from_rest.iter().enumerate();
            let durations: Vec<f64> =
                durations.map(|(i, d)| ticks(d * if i == 0 { first } else { others })).collect();
            (durations.iter().sum(), durations)
        })
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    tried.dedup_by(|a, b| a.1 == b.1);
    let keeps = |durations: &[f64]| {
        (0..durations.len()).all(|i| {
            limits.iter().enumerate().all(|(j, limit)| {
                joint_stretch(&joint_from(state, vias, durations, i, j), durations[i], limit) <= 1.0
            })
        })
    };
    let Some((_, durations)) = tried.into_iter().find(|(_, durations)| keeps(durations)) else {
        return Ok(None);
    };
    let mut begin = start;
    let pieces = (0..durations.len())
        .map(|i| {
            let coefficients = (0..limits.len()).map(|j| joint_from(state, vias, &durations, i, j)).collect();
            let piece = Piece { start: begin, duration: durations[i], coefficients };
            begin += durations[i];
            piece
        })
        .collect();
    Motion::new(pieces).map(Some)
}
