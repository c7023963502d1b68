use thiserror::Error;

use super::Effort;
use crate::arm::Configuration;
use crate::path::{JointPath, straight_move_is_free};
use crate::scene::Scene;
use crate::trajectory::Motion;

/// How far a motion may stray from a path before the verifier is asked, in grid steps, where the planner does not say.
const TOLERANCE: f64 = 0.1;

/// A path whose straight moves from configuration to configuration are all proved to be free.
#[derive(Debug, Clone, PartialEq)]
pub struct CertifiedPath(JointPath);

/// A path that is not free, or not proved to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("the straight move from place {from} of the path, counted from 0, to the next is not certified free")]
pub struct Uncertified {
    /// Index of the configuration it begins at.
    pub from: usize,
}

impl CertifiedPath {
    /// `path`, if every straight move of it is free in `scene`: continuous joints turn by the plain difference.
    ///
    /// # Errors
    /// [`Uncertified`] names the first move that is not, 0 also for a path without configurations or of another arm.
    pub fn new(scene: &Scene, path: JointPath) -> Result<Self, Uncertified> {
        let links = scene.arm().links();
        let ours = |q: &Configuration| q.len() == links && scene.arm().within_limits(q);
        if path.0.is_empty() || !path.0.iter().all(ours) {
            return Err(Uncertified { from: path.0.iter().position(|q| !ours(q)).unwrap_or(0) });
        }
        let alone = [path.0[0].clone(), path.0[0].clone()];
        let places = if path.0.len() == 1 { &alone[..] } else { &path.0 };
        match places.windows(2).position(|pair| !straight_move_is_free(scene, &pair[0], &pair[1])) {
            Some(from) => Err(Uncertified { from }),
            None => Ok(Self(path)),
        }
    }

    /// A path whose moves were certified as it was found.
    pub(crate) fn as_found(path: JointPath) -> Self {
        Self(path)
    }

    /// Its configurations.
    pub fn path(&self) -> &JointPath {
        &self.0
    }
}

/// What a planner proposes to be made into a plan.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Candidate {
    /// A path that a smooth motion is to be led along.
    #[non_exhaustive]
    Path {
        /// Free, by proof.
        path: CertifiedPath,
        /// Its tip travel as the planner counts it (m).
        tip_travel: f64,
        /// How far the motion may stray from it before the verifier is asked, in grid steps.
        tolerance: f64,
        /// Whether a motion that stops at the path's corners may be taken where it costs clearly less.
        may_stop: bool,
    },
    /// A motion to be judged as it is.
    Motion(Motion),
}

impl Candidate {
    /// A motion is to be led closely along `path`, by `scene`'s arm.
    pub fn along(scene: &Scene, path: CertifiedPath) -> Self {
        Self::Path { tip_travel: path.0.tip_travel(scene.arm()), path, tolerance: TOLERANCE, may_stop: false }
    }
}

/// Which of several candidates becomes the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pick {
    /// The first that is accepted.
    First,
    /// Of all that are accepted the one that costs least, among equals the one with more clearance.
    Best,
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// In the order in which they are tried.
    pub candidates: Vec<Candidate>,
    /// Which of them becomes the plan.
    pub pick: Pick,
    /// How many different ones they were chosen from.
    pub chosen_from: usize,
    /// What the search took, if it counts.
    pub effort: Option<Effort>,
}

impl Found {
    /// These candidates.
    pub fn new(candidates: Vec<Candidate>, pick: Pick) -> Self {
        Self { chosen_from: candidates.len(), candidates, pick, effort: None }
    }

    /// With what the search took.
    #[must_use]
    pub fn with_effort(self, effort: Effort) -> Self {
        Self { effort: Some(effort), ..self }
    }
}
