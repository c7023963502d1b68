use super::known::KnownMotion;
use super::placed::placed;
use crate::geometry::{Point, Vector};
use crate::scene::{Course, Obstacle, ObstacleMotion, Scene, Sight};

/// A scene in time: where its obstacles are, and what the arm knows of those that move.
#[derive(Debug, Clone)]
pub struct World {
    scene: Scene,
    /// Where obstacles that chase are, as shifts from where the scene has them (m), one for each obstacle.
    chased: Vec<Vector>,
    now: f64,
}

impl World {
    /// The world of `scene` at time 0. The motion of its obstacles is what they really do, whatever the arm knows.
    pub fn new(scene: Scene) -> Self {
        let chased = vec![Vector::new(0.0, 0.0); scene.obstacles().len()];
        Self { scene, chased, now: 0.0 }
    }

    /// The scene, its obstacles where it has them.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What time it is (s).
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Time goes on to `now` (s) while the arm is at `q` (rad): obstacles that chase go after its tip.
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    pub fn advance(&mut self, now: f64, q: &[f64]) {
        let tip = self.scene.arm().tip(q);
        for i in 0..self.chased.len() {
            let Some(motion) = &self.scene.obstacles()[i].motion else { continue };
            let Course::Chase { keep_off } = *motion.course() else { continue };
            let way = tip - (self.center(i) + self.chased[i]);
            let most = motion.greatest_speed() * (now - self.now);
            let step = way * (most / way.length().max(most).max(f64::MIN_POSITIVE));
            let shift = self.chased[i] + step;
            if self.clearance(i, shift, q) > keep_off {
                self.chased[i] = shift;
            }
        }
        self.now = now;
    }

    /// Where each obstacle that moves is now, as a shift from where the scene has it (m), in the scene's order.
    pub fn shifts(&self) -> Vec<Vector> {
        self.moving().map(|(i, motion)| self.shift(i, motion)).collect()
    }

    /// The obstacles where they are now, as static ones.
    pub fn obstacles(&self) -> Vec<Obstacle> {
        placed(&self.scene, |i, obstacle| obstacle.motion.as_ref().map(|motion| self.shift(i, motion)))
    }

    /// The obstacles that move as the arm, which is at `q` (rad), knows them now: their course, that they may go anywhere,
    /// or that there is nothing.
    ///
    /// # Panics
    /// Unless `q` has a position for each joint.
    pub fn seen_from(&self, q: &[f64]) -> Vec<KnownMotion> {
        self.moving()
            .map(|(obstacle, motion)| {
                let shift = self.shift(obstacle, motion);
                let is_seen = match motion.sight() {
                    Sight::Always => true,
                    Sight::From(time) => self.now >= time,
                    Sight::Within(radius) => self.clearance(obstacle, shift, q) <= radius,
                };
                let course = match (is_seen, motion.course()) {
                    (false, _) => Course::Absent,
                    (true, Course::Chase { .. }) => Course::Unknown { seen: self.now, shift },
                    (true, course) => course.clone(),
                };
                KnownMotion { obstacle, motion: motion.on(course) }
            })
            .collect()
    }

    /// The obstacles that move, by their number.
    fn moving(&self) -> impl Iterator<Item = (usize, &ObstacleMotion)> {
        let obstacles = self.scene.obstacles().iter().enumerate();
        obstacles.filter_map(|(i, obstacle)| Some((i, obstacle.motion.as_ref()?)))
    }

    fn shift(&self, obstacle: usize, motion: &ObstacleMotion) -> Vector {
        match motion.course() {
            Course::Chase { .. } => self.chased[obstacle],
            course => course.shift_at(self.now),
        }
    }

    fn center(&self, obstacle: usize) -> Point {
        let vertices = self.scene.obstacles()[obstacle].shape.vertices();
        let sum = vertices.iter().fold(Vector::new(0.0, 0.0), |sum, v| sum + (*v - Point::new(0.0, 0.0)));
        Point::new(0.0, 0.0) + sum * (1.0 / vertices.len() as f64)
    }

    /// Between the arm at `q` and an obstacle shifted by so much (m).
    fn clearance(&self, obstacle: usize, shift: Vector, q: &[f64]) -> f64 {
        let arm = self.scene.arm();
        let shifted = self.scene.obstacles()[obstacle].shape.shifted(shift);
        let distances = arm.link_segments(q).map(|link| shifted.distance_to_segment(link));
        distances.map(|distance| distance - arm.half_width()).fold(f64::INFINITY, f64::min)
    }
}
