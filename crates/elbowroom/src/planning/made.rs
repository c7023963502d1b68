//! A motion that was accepted, on its way to a plan.

use super::{END_ROUNDING, Mismatch, Pace, Problem, mismatch};
use crate::arm::Configuration;
use crate::path::{JointPath, straight_move_is_free};
use crate::scene::Scene;
use crate::trajectory::Motion;
use crate::verify::Trajectory;

/// Looks at each piece of a motion for the path along it, at first and at the most.
const LOOKS: [usize; 2] = [24, 3072];

/// Places along a motion of many pieces, at first.
const PLACES: usize = 480;

/// A motion that the verifier accepts, and the path it goes along.
pub(super) struct Made {
    pub(super) trajectory: Trajectory,
    pub(super) joint_path: JointPath,
    pub(super) path_cost: f64,
    /// Places of the path that the motion is led through, by their index.
    pub(super) vias: Vec<usize>,
    /// Whether the motion is ours to shape: it is, where a path or a draft was proposed.
    pub(super) is_ours: bool,
}

/// How the motion fails to be what was asked for.
pub(super) fn mismatched(problem: &Problem<'_>, trajectory: &Trajectory) -> Option<Mismatch> {
    let (motion, changes) = (trajectory.motion(), &trajectory.verdict().posture_changes);
    let takes = motion.duration();
    match problem.settings.pace {
        // An arm that is there already takes no time.
        Pace::Duration(asked) if takes > 0.0 && (takes - asked).abs() > END_ROUNDING => {
            Some(Mismatch::Duration { takes, asked })
        }
        _ => mismatch(problem.scene, problem.task, motion, changes),
    }
}

/// A path along the motion, as dense as its straight moves need to be certified, and its places where pieces meet.
pub(super) fn followed(scene: &Scene, motion: &Motion) -> (JointPath, Vec<usize>) {
    let [mut count, most] = LOOKS;
    count = count.min(PLACES / motion.pieces().len()).max(1);
    loop {
        let places = motion.instants(count);
        let certified = places.windows(2).all(|pair| straight_move_is_free(scene, &pair[0], &pair[1]));
        if certified || count >= most {
            let vias = (0..=motion.pieces().len()).map(|i| i * count).collect();
            return (JointPath(places.into_iter().map(Configuration::from).collect()), vias);
        }
        count *= 2;
    }
}
