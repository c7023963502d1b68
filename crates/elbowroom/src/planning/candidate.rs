use super::Effort;
use crate::arm::{Arm, Configuration};
use crate::path::{JointPath, straight_move_is_free};
use crate::scene::Scene;
use crate::trajectory::Motion;

/// How far a motion may stray from a path before the verifier is asked, in grid steps, where the planner does not say.
const TOLERANCE: f64 = 0.1;

/// What a planner proposes to be made into a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate(pub(super) Proposed);

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Proposed {
    /// A path whose straight moves are certified free, or have to be.
    Path { path: PathToFollow, is_certified: bool },
    Motion {
        motion: Motion,
        /// Whether it is to be made better, as one along a path is.
        is_draft: bool,
    },
}

/// A path that a smooth motion is to be led along.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PathToFollow {
    pub(crate) path: JointPath,
    /// Its tip travel as the planner counts it (m); `None` for that of its straight moves.
    pub(crate) tip_travel: Option<f64>,
    /// How far the motion may stray from it before the verifier is asked, in grid steps.
    pub(crate) tolerance: f64,
}

impl Candidate {
    /// A motion is to be led closely along `path`, whose straight moves have to be free; a continuous joint turns by the plain
    /// difference.
    pub fn along(path: JointPath) -> Self {
        Self(Proposed::Path { path: PathToFollow::closely(path), is_certified: false })
    }

    /// This motion, as it is.
    pub fn motion(motion: Motion) -> Self {
        Self(Proposed::Motion { motion, is_draft: false })
    }

    /// This motion, to be made better where motions are.
    pub(crate) fn draft(motion: Motion) -> Self {
        Self(Proposed::Motion { motion, is_draft: true })
    }

    /// A path whose moves were certified as it was found: planners of this crate alone are taken at their word.
    pub(crate) fn certified(path: PathToFollow) -> Self {
        Self(Proposed::Path { path, is_certified: true })
    }

    /// The path, if it is one.
    pub(crate) fn into_path(self) -> Option<JointPath> {
        match self.0 {
            Proposed::Path { path, .. } => Some(path.path),
            Proposed::Motion { .. } => None,
        }
    }
}

impl PathToFollow {
    /// To be followed closely.
    pub(crate) fn closely(path: JointPath) -> Self {
        Self { path, tip_travel: None, tolerance: TOLERANCE }
    }

    /// Its tip travel (m).
    pub(super) fn tip_travel(&self, arm: &Arm) -> f64 {
        self.tip_travel.unwrap_or_else(|| self.path.tip_travel(arm))
    }

    /// The index of the configuration from which the straight move to the next is not certified free, or that is none of the
    /// arm's; 0 also for a path without configurations.
    pub(super) fn first_uncertified(&self, scene: &Scene) -> Option<usize> {
        let places = &self.path.0;
        let ours = |q: &Configuration| q.len() == scene.arm().links() && scene.arm().within_limits(q);
        let (Some(first), None) = (places.first(), places.iter().position(|q| !ours(q))) else {
            return Some(places.iter().position(|q| !ours(q)).unwrap_or(0));
        };
        if !straight_move_is_free(scene, first, first) {
            return Some(0);
        }
        places.windows(2).position(|pair| !straight_move_is_free(scene, &pair[0], &pair[1]))
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
