use crate::arm::Configuration;
use crate::geometry::{Circle, Point, Vector};
use crate::path::clearances;
use crate::scene::{Course, Mover, Obstacle, Scene, Shape, Sight};

/// A scene in time: where its movers are, and what the arm knows of them.
#[derive(Debug, Clone)]
pub struct World {
    scene: Scene,
    movers: Vec<Mover>,
    /// Where those that chase are, as shifts from where the scene has them (m).
    chased: Vec<Vector>,
    now: f64,
}

impl World {
    /// The world of `scene` at time 0, with these of its obstacles moving.
    pub fn new(scene: Scene, movers: Vec<Mover>) -> Self {
        let chased = vec![Vector::new(0.0, 0.0); movers.len()];
        Self { scene, movers, chased, now: 0.0 }
    }

    /// The scene, its obstacles where it has them.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What time it is (s).
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Time goes on to `now` (s) while the arm is at `q`: those that chase go after its tip.
    pub fn advance(&mut self, now: f64, q: &Configuration<2>) {
        let tip = self.scene.arm.tip(q);
        for i in 0..self.movers.len() {
            let Course::Chase { keep_off } = *self.movers[i].course() else { continue };
            let way = tip - (self.center(i) + self.chased[i]);
            let most = self.movers[i].greatest_speed() * (now - self.now);
            let step = way * (most / way.length().max(most).max(f64::MIN_POSITIVE));
            let shift = self.chased[i] + step;
            if self.clearance(i, shift, q) > keep_off {
                self.chased[i] = shift;
            }
        }
        self.now = now;
    }

    /// Where each mover is now, as a shift from where the scene has it (m).
    pub fn shifts(&self) -> Vec<Vector> {
        (0..self.movers.len()).map(|i| self.shift(i)).collect()
    }

    /// The obstacles where they are now.
    pub fn obstacles(&self) -> Vec<Obstacle> {
        let mut obstacles = self.scene.obstacles.clone();
        for (i, mover) in self.movers.iter().enumerate() {
            obstacles[mover.obstacle()].shape =
                shifted(&self.scene.obstacles[mover.obstacle()].shape, self.shift(i));
        }
        obstacles
    }

    /// The movers as the arm, which is at `q`, knows them now: their course, that they may go anywhere, or that there is
    /// nothing.
    pub fn seen_from(&self, q: &Configuration<2>) -> Vec<Mover> {
        (0..self.movers.len())
            .map(|i| {
                let mover = &self.movers[i];
                let is_seen = match mover.sight() {
                    Sight::Always => true,
                    Sight::From(time) => self.now >= time,
                    Sight::Within(radius) => self.clearance(i, self.shift(i), q) <= radius,
                };
                let course = match (is_seen, mover.course()) {
                    (false, _) => Course::Absent,
                    (true, Course::Chase { .. }) => Course::Unknown { seen: self.now, shift: self.shift(i) },
                    (true, course) => course.clone(),
                };
                mover.on(course)
            })
            .collect()
    }

    fn shift(&self, i: usize) -> Vector {
        match self.movers[i].course() {
            Course::Chase { .. } => self.chased[i],
            course => course.shift_at(self.now),
        }
    }

    fn center(&self, i: usize) -> Point {
        match &self.scene.obstacles[self.movers[i].obstacle()].shape {
            Shape::Circle(circle) => circle.center,
            Shape::Polygon(polygon) => {
                let vertices = polygon.vertices();
                let sum =
                    vertices.iter().fold(Vector::new(0.0, 0.0), |sum, v| sum + (*v - Point::new(0.0, 0.0)));
                Point::new(0.0, 0.0) + sum * (1.0 / vertices.len() as f64)
            }
        }
    }

    /// Between the arm at `q` and a mover shifted by so much (m).
    fn clearance(&self, i: usize, shift: Vector, q: &Configuration<2>) -> f64 {
        let obstacle = &self.scene.obstacles[self.movers[i].obstacle()];
        let alone = Scene {
            arm: self.scene.arm,
            grid: self.scene.grid,
            obstacles: vec![Obstacle { name: None, shape: shifted(&obstacle.shape, shift) }],
            tasks: Vec::new(),
        };
        clearances(&alone, &q.0).into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// `shape` moved by so much (m).
pub(super) fn shifted(shape: &Shape, by: Vector) -> Shape {
    match shape {
        Shape::Circle(circle) => Shape::Circle(Circle { center: circle.center + by, ..*circle }),
        Shape::Polygon(polygon) => Shape::Polygon(polygon.shifted(by)),
    }
}
