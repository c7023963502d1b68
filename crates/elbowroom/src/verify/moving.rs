//! Where obstacles that move are, by the verifier's own reckoning.

use crate::scene::{Course, ObstacleMotion};

/// Rounding of a shift as a share of what it is made from: some eight roundings, and twice as many for safety.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The way of one obstacle.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    course: &'a Course,
    speed: f64,
}

impl<'a> Way<'a> {
    pub(super) fn new(motion: &'a ObstacleMotion) -> Self {
        Self { course: motion.course(), speed: motion.greatest_speed() }
    }

    /// Whether there is anything to touch.
    pub(super) fn is_there(&self) -> bool {
        !matches!(self.course, Course::Absent)
    }

    /// How far the obstacle is from where the scene has it at `time` (s) (m).
    pub(super) fn shift(&self, time: f64) -> [f64; 2] {
        match self.course {
            Course::Waypoints(points) => {
                let last = points.len() - 1;
                if time <= points[0].time {
                    return [points[0].shift.x, points[0].shift.y];
                }
                if time >= points[last].time {
                    return [points[last].shift.x, points[last].shift.y];
                }
                let after = points.partition_point(|point| point.time <= time);
                let (a, b) = (points[after - 1], points[after]);
                let share = (time - a.time) / (b.time - a.time);
                [a.shift.x + (b.shift.x - a.shift.x) * share, a.shift.y + (b.shift.y - a.shift.y) * share]
            }
            Course::Drift { start, velocity } => {
                let going = if time > *start { time - start } else { 0.0 };
                [velocity.x * going, velocity.y * going]
            }
            Course::Chase { .. } | Course::Absent => [0.0; 2],
            Course::Unknown { shift, .. } => [shift.x, shift.y],
        }
    }

    /// How far from there it may be at `time` (s) (m).
    pub(super) fn doubt(&self, time: f64) -> f64 {
        match self.course {
            Course::Chase { .. } => self.speed * time.abs(),
            Course::Unknown { seen, .. } => self.speed * (time - seen).abs(),
            Course::Waypoints(_) | Course::Drift { .. } | Course::Absent => 0.0,
        }
    }

    /// How far from `place`, a shift, its course is at any time between two (s) (m). Straight between waypoints, it is
    /// farthest at an end or at a waypoint.
    pub(super) fn drift(&self, [from, to]: [f64; 2], place: [f64; 2]) -> f64 {
        let off = |shift: [f64; 2]| length([shift[0] - place[0], shift[1] - place[1]]);
        let ends = off(self.shift(from)).max(off(self.shift(to)));
        let between = match self.course {
            Course::Waypoints(points) => points[points.partition_point(|point| point.time <= from)..]
                .iter()
                .take_while(|point| point.time < to)
                .map(|point| off([point.shift.x, point.shift.y]))
                .fold(0.0, f64::max),
            Course::Drift { start, .. } if from < *start && *start < to => off([0.0; 2]),
            Course::Drift { .. } | Course::Chase { .. } | Course::Absent | Course::Unknown { .. } => 0.0,
        };
        ends.max(between)
    }

    /// Greatest coordinate of a shift between two times (s) (m).
    pub(super) fn size(&self, [from, to]: [f64; 2]) -> f64 {
        self.drift([from, to], [0.0; 2])
    }

    /// How far a shift between two times may be off (m).
    pub(super) fn rounding(&self, [from, to]: [f64; 2]) -> f64 {
        ROUNDING * (self.size([from, to]) + self.speed * from.abs().max(to.abs()))
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}
