use smallvec::SmallVec;

use super::settings::SHORTEST;
use crate::geometry::{Segment, Vector};
use crate::scene::{Course, Obstacle, Scene};

/// The links are to keep this `clearance` (m), at times from `now` to `horizon` (s), among the obstacles of `scene` as they move.
pub(super) struct SafeIntervals<'a> {
    pub(super) scene: &'a Scene,
    pub(super) clearance: f64,
    pub(super) now: f64,
    pub(super) horizon: f64,
}

/// When the arm may stand at a configuration.
pub(super) struct Standing {
    /// From when to when (s), in their order, as far as courses are known; infinite at its end where nothing comes before
    /// the horizon.
    pub(super) intervals: Vec<[f64; 2]>,
    /// From when on obstacles of unknown course may be there (s).
    pub(super) doubtful_from: f64,
}

impl SafeIntervals<'_> {
    pub(super) fn at(&self, q: &[f64; 2]) -> Standing {
        let never = Standing { intervals: Vec::new(), doubtful_from: self.now };
        if !self.scene.arm().within_limits(q) {
            return never;
        }
        let links: SmallVec<[Segment; 4]> = self.scene.arm().link_segments(q).collect();
        let obstacles = self.scene.obstacles();
        let mut still = obstacles.iter().filter(|obstacle| obstacle.motion.is_none());
        if still.any(|obstacle| self.left(&links, obstacle, Vector::new(0.0, 0.0)) <= 0.0) {
            return never;
        }
        let mut touched: Vec<[f64; 2]> = Vec::new();
        let mut doubtful_from = f64::INFINITY;
        for obstacle in obstacles {
            let Some(motion) = &obstacle.motion else { continue };
            match motion.course() {
                Course::Absent => {}
                course if course.is_unknown() => {
                    let seen = if let Course::Unknown { seen, .. } = course { *seen } else { 0.0 };
                    let clearance = self.left(&links, obstacle, course.shift_at(self.now));
                    doubtful_from = doubtful_from.min(seen + clearance / motion.greatest_speed());
                }
                course => self.add_touched(&links, obstacle, course, &mut touched),
            }
        }
        Standing { intervals: self.between(touched), doubtful_from }
    }

    /// Clearance left beyond what is to be kept (m), negative in contact.
    fn left(&self, links: &[Segment], obstacle: &Obstacle, shift: Vector) -> f64 {
        let distances = links
            .iter()
            .map(|link| obstacle.signed_distance_to_segment(Segment::new(link.a + -shift, link.b + -shift)));
        distances.fold(f64::INFINITY, f64::min) - self.scene.arm().half_width() - self.clearance
    }

    /// Steps as long as the clearance left allows: no obstacle gets ahead farther than that in the time.
    fn add_touched(
        &self,
        links: &[Segment],
        obstacle: &Obstacle,
        course: &Course,
        touched: &mut Vec<[f64; 2]>,
    ) {
        let speed = course.greatest_speed().max(f64::MIN_POSITIVE);
        let mut time = self.now;
        let mut since = None;
        while time < self.horizon {
            let clearance = self.left(links, obstacle, course.shift_at(time));
            match since {
                None if clearance <= 0.0 => since = Some(time),
                Some(start) if clearance > 0.0 => {
                    touched.push([start, time]);
                    since = None;
                }
                _ => {}
            }
            time += (clearance.abs() / speed).max(SHORTEST);
        }
        touched.extend(since.map(|start| [start, f64::INFINITY]));
    }

    fn between(&self, mut touched: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        touched.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut intervals = Vec::new();
        let mut free_from = self.now;
        for [start, end] in touched {
            if start > free_from {
                intervals.push([free_from, start]);
            }
            free_from = free_from.max(end);
        }
        if free_from < self.horizon {
            intervals.push([free_from, f64::INFINITY]);
        }
        intervals
    }
}
