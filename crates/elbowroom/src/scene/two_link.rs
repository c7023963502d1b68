use thiserror::Error;

use super::{Obstacle, Scene};
use crate::arm::TwoLink;
use crate::grid::Grid;

/// A scene whose arm has two links, among static obstacles, with the closed forms of that arm: what maps, slices
/// and searches over both postures take. [`Scene::two_link`] makes it.
#[derive(Debug, Clone, Copy)]
pub struct TwoLinkScene<'a> {
    scene: &'a Scene,
    arm: TwoLink,
}

/// Why a scene is not one for closed forms.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TwoLinkError {
    /// The arm has more links than two.
    #[error("it is for arms of 2 links; this one has {found}")]
    Links {
        /// How many it has.
        found: usize,
    },
    /// An obstacle moves.
    #[error("only for static obstacles; {} moves", super::obstacle_in_words(*obstacle, name.as_deref()))]
    Moving {
        /// Its number, from 0.
        obstacle: usize,
        /// Its name, if it has one.
        name: Option<String>,
    },
}

impl Scene {
    /// The scene with the closed forms of its arm, for what needs them.
    ///
    /// # Errors
    /// [`TwoLinkError`] unless the arm has two links and all obstacles are static.
    pub fn two_link(&self) -> Result<TwoLinkScene<'_>, TwoLinkError> {
        if let Some(obstacle) = self.first_moving() {
            let name = self.obstacles()[obstacle].name.clone();
            return Err(TwoLinkError::Moving { obstacle, name });
        }
        match self.arm().two_link() {
            Some(arm) => Ok(TwoLinkScene { scene: self, arm }),
            None => Err(TwoLinkError::Links { found: self.arm().links() }),
        }
    }
}

impl<'a> TwoLinkScene<'a> {
    /// The arm's closed forms.
    pub fn arm(&self) -> &TwoLink {
        &self.arm
    }

    /// Where the free-space maps have their points.
    pub fn grid(&self) -> &'a Grid {
        self.scene.grid()
    }

    /// What the arm must not touch.
    pub fn obstacles(&self) -> &'a [Obstacle] {
        self.scene.obstacles()
    }

    /// The scene itself.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }
}
