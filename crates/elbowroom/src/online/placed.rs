//! Obstacles that move, put somewhere as static ones.

use crate::geometry::Vector;
use crate::scene::{Obstacle, Scene};

/// The shift (m) of an obstacle that is not there: farther than any arm reaches.
pub(super) const AWAY: Vector = Vector::new(1e7, 1e7);

/// The obstacles of `scene`, each asked about with its number, as static ones: shifted by so much (m), or where the scene has
/// them.
pub(super) fn placed(scene: &Scene, shift: impl Fn(usize, &Obstacle) -> Option<Vector>) -> Vec<Obstacle> {
    let place = |(i, obstacle): (usize, &Obstacle)| {
        let shape = match shift(i, obstacle) {
            Some(shift) => obstacle.shape.shifted(shift),
            None => obstacle.shape.clone(),
        };
        Obstacle { name: obstacle.name.clone(), shape, motion: None }
    };
    scene.obstacles().iter().enumerate().map(place).collect()
}

/// `scene` with its obstacles so [`placed`].
pub(super) fn still(scene: &Scene, shift: impl Fn(usize, &Obstacle) -> Option<Vector>) -> Scene {
    let mut still = scene.clone();
    let places = still.obstacles_mut().iter_mut().zip(placed(scene, shift));
    places.for_each(|(obstacle, placed)| *obstacle = placed);
    still
}
