use crate::arm::Configuration;
use crate::geometry::{Segment, Vector};
use crate::scene::{Course, Mover, Scene};

/// Shortest step in time (s): a touch that is over sooner may be passed over. What is planned with the intervals is
/// verified in any case.
const SHORTEST: f64 = 0.02;

/// The links are to keep so much room (m), at times from `now` to `horizon` (s).
pub(super) struct SafeIntervals<'a> {
    pub(super) scene: &'a Scene,
    pub(super) movers: &'a [Mover],
    pub(super) room: f64,
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
    pub(super) fn at(&self, q: &Configuration<2>) -> Standing {
        let never = Standing { intervals: Vec::new(), doubtful_from: self.now };
        let arm = &self.scene.arm;
        if !arm.joints().iter().zip(q.0).all(|(joint, angle)| joint.limits.contains(angle)) {
            return never;
        }
        let links = arm.links(q);
        let is_moving = |obstacle| self.movers.iter().any(|mover| mover.obstacle() == obstacle);
        for (i, _) in self.scene.obstacles.iter().enumerate().filter(|(i, _)| !is_moving(*i)) {
            if self.clearance(&links, i, Vector::new(0.0, 0.0)) <= 0.0 {
                return never;
            }
        }
        let mut touched: Vec<[f64; 2]> = Vec::new();
        let mut doubtful_from = f64::INFINITY;
        for mover in self.movers {
            match mover.course() {
                Course::Absent => {}
                Course::Chase { .. } | Course::Unknown { .. } => {
                    let seen = if let Course::Unknown { seen, .. } = mover.course() { *seen } else { 0.0 };
                    let clearance =
                        self.clearance(&links, mover.obstacle(), mover.course().shift_at(self.now));
                    doubtful_from = doubtful_from.min(seen + clearance / mover.greatest_speed());
                }
                course => self.add_touched(&links, mover, course, &mut touched),
            }
        }
        Standing { intervals: self.between(touched), doubtful_from }
    }

    /// Room beyond what is to be kept (m), negative in contact.
    fn clearance(&self, links: &[Segment; 2], obstacle: usize, shift: Vector) -> f64 {
        let obstacle = &self.scene.obstacles[obstacle];
        let distances = links
            .map(|link| obstacle.signed_distance_to_segment(Segment::new(link.a + -shift, link.b + -shift)));
        distances[0].min(distances[1]) - self.scene.arm.half_width() - self.room
    }

    /// Steps as long as the clearance allows: no obstacle gets ahead farther than that in the time.
    fn add_touched(&self, links: &[Segment; 2], mover: &Mover, course: &Course, touched: &mut Vec<[f64; 2]>) {
        let speed = course.greatest_speed().max(f64::MIN_POSITIVE);
        let mut time = self.now;
        let mut since = None;
        while time < self.horizon {
            let clearance = self.clearance(links, mover.obstacle(), course.shift_at(time));
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
