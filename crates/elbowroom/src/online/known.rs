use thiserror::Error;

use crate::scene::{Course, ObstacleMotion, Scene};

/// What is known now of an obstacle of the scene that moves.
///
/// The course is where it will be: [`Course::Absent`] while nobody knows of it, [`Course::Unknown`] where it was seen but may
/// go anywhere. Since when the arm knows does not matter here.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownMotion {
    /// Which of the scene's obstacles, from 0.
    pub obstacle: usize,
    /// Its motion, as far as it is known.
    pub motion: ObstacleMotion,
}

/// Why what is said to be known cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum KnownError {
    /// The scene has no such obstacle, or it is static there.
    #[error("obstacles[{obstacle}] does not move in this scene")]
    StandsStill {
        /// Its number, from 0.
        obstacle: usize,
    },
    /// Two motions of one obstacle.
    #[error("obstacles[{obstacle}] is given two motions")]
    Twice {
        /// Its number, from 0.
        obstacle: usize,
    },
}

/// A scene whose obstacles move as is known now, which each update may know otherwise.
pub(super) struct KnownScene {
    moves: Vec<bool>,
    all: Scene,
    /// The same without the obstacles of unknown course; behind the times while there are none.
    certain: Scene,
    is_certain: bool,
}

impl KnownScene {
    /// The obstacles of `scene` that move are those that may be known to.
    pub(super) fn new(scene: Scene) -> Self {
        let moves = scene.obstacles().iter().map(|obstacle| obstacle.motion.is_some()).collect();
        Self { moves, certain: scene.clone(), all: scene, is_certain: true }
    }

    /// From now on the obstacles move as in `known`; those that are not in it stand where the scene has them.
    ///
    /// # Errors
    /// [`KnownError`]; what is known then counts for nothing until more is learned.
    pub(super) fn learn(&mut self, known: &[KnownMotion]) -> Result<(), KnownError> {
        if let Some(still) = known.iter().find(|known| self.moves.get(known.obstacle) != Some(&true)) {
            return Err(KnownError::StandsStill { obstacle: still.obstacle });
        }
        set_motions(&mut self.all, known, ObstacleMotion::clone)?;
        self.is_certain = known.iter().all(|known| !known.motion.course().is_unknown());
        if !self.is_certain {
            set_motions(&mut self.certain, known, |motion| match motion.course().is_unknown() {
                true => motion.on(Course::Absent),
                false => motion.clone(),
            })?;
        }
        Ok(())
    }

    /// With all that is known.
    pub(super) fn all(&self) -> &Scene {
        &self.all
    }

    /// Whether every course is known.
    pub(super) fn is_certain(&self) -> bool {
        self.is_certain
    }

    /// Without the obstacles of unknown course.
    pub(super) fn certain(&self) -> &Scene {
        if self.is_certain { &self.all } else { &self.certain }
    }
}

fn set_motions(
    scene: &mut Scene,
    known: &[KnownMotion],
    motion: impl Fn(&ObstacleMotion) -> ObstacleMotion,
) -> Result<(), KnownError> {
    let obstacles = scene.obstacles_mut();
    obstacles.iter_mut().for_each(|obstacle| obstacle.motion = None);
    for known in known {
        if obstacles[known.obstacle].motion.replace(motion(&known.motion)).is_some() {
            return Err(KnownError::Twice { obstacle: known.obstacle });
        }
    }
    Ok(())
}
