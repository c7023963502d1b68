//! Obstacles that move, come and go, seeded: by hairs, by cells and by leaps, onto the base, out of reach, against a link.

use std::f64::consts::{PI, TAU};

use elbowroom::geometry::{Point, Vector};
use elbowroom::scene::{Obstacle, Scene};

use crate::worlds::Numbers;
use crate::{build, judge};

fn shifted(obstacle: &Obstacle, by: Vector) -> Obstacle {
    Obstacle { shape: obstacle.shape.shifted(by), ..obstacle.clone() }
}

fn middle(obstacle: &Obstacle) -> Point {
    obstacle.shape.vertices()[0]
}

/// A disc that touches, or nearly, a link of the arm standing somewhere.
fn against_a_link(numbers: &mut Numbers, scene: &Scene) -> Obstacle {
    let q = [numbers.within(-PI, PI), numbers.within(-2.5, 2.5)];
    let [base, elbow, tip] = judge::skeleton(scene, q);
    let (a, b) = if numbers.below(2) == 0 { (base, elbow) } else { (elbow, tip) };
    let along = numbers.within(0.0, 1.0);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    let radius = numbers.within(0.001, 0.05);
    let hair = [0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6][numbers.below(7) as usize];
    let off = (radius + scene.arm().half_width() + hair) / length;
    let center = Point::new(a[0] + along * dx - off * dy, a[1] + along * dy + off * dx);
    build::circle(center.x, center.y, radius)
}

/// The obstacles of `scene` after one random update.
pub(crate) fn update(numbers: &mut Numbers, scene: &Scene) -> Vec<Obstacle> {
    let mut obstacles = scene.obstacles().to_vec();
    let reach: f64 = scene.arm().lengths().iter().sum();
    for _ in 0..numbers.below(4) {
        let count = obstacles.len() as u64;
        if count == 0 {
            obstacles.push(against_a_link(numbers, scene));
            continue;
        }
        let index = numbers.below(count) as usize;
        let way = match numbers.below(10) {
            0 => 1e-9,
            1 => 1e-3 * scene.grid().step(),
            2..6 => scene.grid().step(),
            _ => numbers.within(0.0, reach),
        };
        let by = Vector::polar(way, numbers.within(0.0, TAU));
        let to = |place: Point| place - middle(&obstacles[index]);
        let by = match numbers.below(12) {
            0 => to(scene.arm().base()),
            1 => to(Point::new(3.0 * reach, 0.0)),
            2 => to(Point::new(numbers.within(-reach, reach), numbers.within(-reach, reach))),
            _ => by,
        };
        match numbers.below(14) {
            0 => obstacles.push(against_a_link(numbers, scene)),
            1 if count < 9 => {
                let twin = obstacles[index].clone();
                obstacles.push(twin);
            }
            2 => drop(obstacles.remove(index)),
            3 => obstacles[index] = against_a_link(numbers, scene),
            _ => obstacles[index] = shifted(&obstacles[index], by),
        }
    }
    obstacles
}
