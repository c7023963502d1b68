//! From certified straight joint motions to a smooth motion that the verifier accepts.

use super::{Mismatch, Monitor, Pace, PlanError};
use crate::arm::Configuration;
use crate::path::simplify;
use crate::scene::Scene;
use crate::trajectory::{
    Motion, MotionError, SpeedLimits, TICK, Via, fastest_durations, quintic_through, rescaled, stretch,
};
use crate::verify::{Trajectory, Verdict, VerifySettings, Violation};

/// Rounds of adding vias; after them every refused stretch becomes straight joint motions from stop to stop.
const ROUNDS: usize = 24;

/// How a motion begins as.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Style {
    /// Through as few vias as keep elbow and tip this near to the path, in grid steps; more where the verifier refuses.
    Flowing {
        /// In grid steps.
        tolerance: f64,
    },
    /// The path itself: straight joint motions from place to place, with a stop at each.
    StopToStop,
}

/// How a motion came to be.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Smoothed {
    pub(super) trajectory: Trajectory,
    /// Places of the path that the motion is led through, by their index.
    pub(super) vias: Vec<usize>,
}

/// Why there is no motion along a certified path.
#[derive(Debug)]
pub(super) enum SmoothError {
    /// The monitor stopped it.
    Stopped,
    /// The duration asked for is shorter than the limits allow (s).
    TooFast { fastest: f64 },
    /// Numbers overflow.
    Motion(MotionError),
    /// Even straight joint motions from stop to stop are refused, which certified joint motions should not be.
    Refused(Box<Verdict>),
    /// Even those change the posture (at this time, s), though it is to be kept.
    PostureChanged { time: f64 },
}

impl SmoothError {
    /// What it means for a plan of `planner` at `pace`.
    pub(super) fn in_terms_of(self, planner: &str, pace: Pace) -> PlanError {
        match (self, pace) {
            (Self::TooFast { fastest }, Pace::Duration(duration)) => PlanError::TooFast { duration, fastest },
            (Self::Motion(error), _) => error.into(),
            (Self::Refused(verdict), _) => PlanError::Refused { planner: planner.to_owned(), verdict },
            (Self::PostureChanged { time }, _) => PlanError::Mismatch {
                planner: planner.to_owned(),
                mismatch: Mismatch::PostureChanged { time },
            },
            (Self::Stopped | Self::TooFast { .. }, _) => PlanError::Stopped,
        }
    }
}

/// A motion through places of a path, whose straight joint motions from place to place are certified free.
///
/// Quintic pieces through few vias at first; where the verifier refuses a piece, or it changes a posture that is to be kept,
/// places between its ends become vias too, and where none is left the piece is turned straight, from stop to stop.
pub(super) fn smooth(
    scene: &Scene,
    places: &[Configuration],
    limits: &[SpeedLimits],
    stated: &[SpeedLimits],
    (pace, keep_posture): (Pace, bool),
    style: Style,
    monitor: &dyn Monitor,
) -> Result<Smoothed, SmoothError> {
    let (mut chosen, mut stops) = match style {
        Style::Flowing { tolerance } => {
            (simplify(scene.arm(), places, tolerance * scene.grid().step()), vec![false; places.len()])
        }
        Style::StopToStop => ((0..places.len()).collect(), vec![true; places.len()]),
    };
    for end in [0, places.len() - 1] {
        stops[end] = true;
    }
    for round in 0.. {
        if !monitor.keep_going() {
            return Err(SmoothError::Stopped);
        }
        let vias: Vec<Via> = chosen.iter().map(|&i| Via { q: &places[i], stop: stops[i] }).collect();
        let durations = durations_of(&vias, limits, stated, pace)?;
        let motion = Motion::new(quintic_through(&vias, &durations)).map_err(SmoothError::Motion)?;
        let keep_going = || monitor.keep_going();
        let certified = Trajectory::certify_until(scene, motion, &VerifySettings::default(), &keep_going);
        let (times, why) = match certified {
            Ok(trajectory) => {
                // A smooth motion may cut through full stretch where its path only comes near.
                let changes = if keep_posture { &trajectory.verdict().posture_changes[..] } else { &[] };
                let Some(&time) = changes.first() else {
                    return Ok(Smoothed { trajectory, vias: chosen });
                };
                // One where two pieces meet may be either's.
                let around = changes.iter().flat_map(|&time| [time - TICK / 2.0, time]);
                (around.collect(), SmoothError::PostureChanged { time })
            }
            Err(verdict) => (times_of(&verdict)?, SmoothError::Refused(verdict)),
        };
        let refused = pieces_at(&times, &durations);
        let before = (chosen.len(), stops.iter().filter(|stop| **stop).count());
        for &piece in refused.iter().rev() {
            let (from, to) = (chosen[piece], chosen[piece + 1]);
            if round >= ROUNDS || to - from == 1 {
                (from..=to).for_each(|i| stops[i] = true);
                chosen.splice(piece + 1..piece + 1, from + 1..to);
            } else {
                chosen.insert(piece + 1, usize::midpoint(from, to));
            }
        }
        if before == (chosen.len(), stops.iter().filter(|stop| **stop).count()) {
            return Err(why);
        }
    }
    Err(SmoothError::Stopped)
}

/// Durations of the pieces between `vias`: the fastest found, or stretched evenly to what was asked.
fn durations_of(
    vias: &[Via],
    limits: &[SpeedLimits],
    stated: &[SpeedLimits],
    pace: Pace,
) -> Result<Vec<f64>, SmoothError> {
    let durations = fastest_durations(vias, limits);
    let Pace::Duration(asked) = pace else { return Ok(durations) };
    let fastest: f64 = durations.iter().sum();
    // Only what the scene states forbids a duration; the rest is taste.
    let slow_down = |durations: &[f64]| {
        quintic_through(vias, durations).iter().map(|piece| stretch(piece, stated)).fold(0.0, f64::max)
    };
    let needed = slow_down(&durations) * fastest;
    if asked < needed {
        return Err(SmoothError::TooFast { fastest: needed });
    }
    let on_ticks = rescaled(&durations, asked);
    if slow_down(&on_ticks) <= 1.0 {
        return Ok(on_ticks);
    }
    Ok(durations.iter().map(|duration| duration * (asked / fastest)).collect())
}

/// When the verifier's complaints are (s).
fn times_of(verdict: &Verdict) -> Result<Vec<f64>, SmoothError> {
    if verdict.violations.iter().any(|violation| matches!(violation, Violation::Stopped { .. })) {
        return Err(SmoothError::Stopped);
    }
    Ok(verdict.violations.iter().map(Violation::time).collect())
}

/// The pieces that `times` (s) fall on, in order.
fn pieces_at(times: &[f64], durations: &[f64]) -> Vec<usize> {
    let ends: Vec<f64> = durations
        .iter()
        .scan(0.0, |end, duration| {
            *end += duration;
            Some(*end)
        })
        .collect();
    let at = |time: f64| ends.partition_point(|end| *end <= time).min(durations.len().saturating_sub(1));
    let mut pieces: Vec<usize> = times.iter().map(|&time| at(time)).collect();
    pieces.sort_unstable();
    pieces.dedup();
    pieces
}
