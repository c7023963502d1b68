//! When the elbow changes sides.

use std::f64::consts::PI;

use super::bernstein::Bernstein;
use crate::trajectory::Piece;

/// The most posture changes that a verdict lists.
pub const MOST_POSTURE_CHANGES: usize = 1000;

/// A joint that moves by no more than this (rad, or share of its angle) is taken to stand, and to be on a
/// multiple of π when it is as near to it.
const STANDING: f64 = 1e-12;

/// Halvings in all, enough for all changes that are listed; angles of 1e12 rad and more, which have no digits
/// left to tell sides apart, could use up any number.
const MOST_HALVINGS: u32 = 100_000;

/// Halvings after which an interval is taken as a point.
const DEEPEST: u32 = 50;

/// Times (s) at which the second joint of two passes a multiple of π; a joint that only touches one, or begins or
/// ends there, changes no posture. None for arms of more links, which have no two postures.
pub(super) fn posture_changes(pieces: &[&Piece]) -> Vec<f64> {
    let mut walk = Walk { side: None, meeting: None, times: Vec::new(), halvings_left: MOST_HALVINGS };
    for piece in pieces {
        let [_, bend] = &piece.coefficients[..] else { continue };
        let bend: Bernstein<6> = Bernstein::derivative(bend, 0, piece.duration);
        let clock = Clock { start: piece.start, duration: piece.duration };
        walk.visit(bend.coefficients[0], clock.time(0.0));
        walk.search(&bend, &clock, (0.0, 1.0), 0);
    }
    walk.times
}

struct Clock {
    start: f64,
    duration: f64,
}

impl Clock {
    fn time(&self, fraction: f64) -> f64 {
        self.start + self.duration * fraction
    }
}

struct Walk {
    /// In which multiple of π the joint was last seen off the multiples themselves.
    side: Option<f64>,
    /// Since when it stands on a multiple (s).
    meeting: Option<f64>,
    times: Vec<f64>,
    halvings_left: u32,
}

impl Walk {
    fn visit(&mut self, angle: f64, time: f64) {
        let multiple = libm::round(angle / PI) * PI;
        if (angle - multiple).abs() <= STANDING * angle.abs().max(1.0) {
            self.meeting.get_or_insert(time);
            return;
        }
        let side = (angle / PI).floor();
        let met = self.meeting.take();
        if self.side.is_some_and(|last| last != side) && self.times.len() < MOST_POSTURE_CHANGES {
            self.times.push(met.unwrap_or(time));
        }
        self.side = Some(side);
    }

    /// The start of the interval from `from`, `width` long, has been visited.
    fn search(&mut self, bend: &Bernstein<6>, clock: &Clock, (from, width): (f64, f64), depth: u32) {
        let [low, high] = bend.hull();
        let stays = (low / PI).floor() == (high / PI).floor() && low != (low / PI).floor() * PI;
        if stays
            || depth == DEEPEST
            || high - low <= STANDING * high.abs().max(1.0)
            || self.times.len() == MOST_POSTURE_CHANGES
            || self.halvings_left == 0
        {
            self.visit(bend.coefficients[5], clock.time(from + width));
            return;
        }
        self.halvings_left -= 1;
        let width = 0.5 * width;
        for (half, from) in bend.halves().iter().zip([from, from + width]) {
            self.search(half, clock, (from, width), depth + 1);
        }
    }
}
