//! Whether a motion is safe: a proof or a reason why not.
//!
//! The verifier looks at the polynomials themselves, never at samples of them. Its geometry is its own, so
//! that a mistake in what the planners use cannot pass here. Between the pieces' ends every statement holds
//! for the exact polynomials: bounds carry an allowance for the rounding of their arithmetic, and what cannot
//! be told apart in it is refused.

mod bernstein;
mod blocked;
mod bound;
mod bound_tips;
mod clearance;
mod continuity;
mod limits;
mod moving;
mod pairs;
mod peak;
mod posture_changes;
mod sweep;
mod trajectory;
mod verdict;

use crate::arm::Arm;
use crate::scene::{Mover, Scene};
use crate::trajectory::Motion;
use sweep::Passage;

pub(crate) use bound::images;
pub use bound::{BoundError, OpenJoints, Reachability, bound_over_joints};
pub(crate) use bound_tips::innermost_reach;
pub use bound_tips::{OpenTips, bound_over_tips};
pub use continuity::JUMP_ROUNDING;
pub use posture_changes::MOST_POSTURE_CHANGES;
pub use trajectory::Trajectory;
pub use verdict::{
    Against, Clearance, JointMargin, MotionMargin, MotionMargins, Quantity, Rate, Verdict, Violation,
};

/// Clearance that a safe motion has more of, whatever the margin (m).
pub const FLOOR: f64 = 1e-9;

/// What to ask of a motion, and how much work to put in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerifySettings {
    /// Clearance that a safe motion has more of (m); below [`FLOOR`] it counts as [`FLOOR`].
    pub margin: f64,
    /// Configurations looked at per piece and pair of a link and what it must not touch before the pair is left undecided; half of them
    /// may go into the accuracy of the least clearance.
    pub evaluations: u32,
    /// What must not jump where pieces meet, all before it included. Jumps beyond it count only against joints with
    /// a limit on the next rate.
    pub continuous: Quantity,
}

impl Default for VerifySettings {
    /// No margin. A link that moves by 1 m and stays within 0.1 mm of an obstacle all along is still decided.
    fn default() -> Self {
        Self { margin: 0.0, evaluations: 1 << 17, continuous: Quantity::Acceleration }
    }
}

/// Judges whether the scene's arm can run `motion` safely: clear of all obstacles, and of itself where the arm
/// asks for it, by more than the margin, within joint and motion limits, with position, velocity and acceleration that do not jump.
///
/// Start and end need not be at rest. Joint limits are closed and allowed 1e-12 rad of rounding, motion limits
/// a share of 1e-12.
///
/// # Reference
/// Schwarzer, Saha and Latombe, *Adaptive dynamic collision checking*, IEEE T-RO 21(3), 2005, for the bisection
/// with motion bounds; Farouki, *The Bernstein polynomial basis: a centennial retrospective*, CAGD 29(6), 2012,
/// for the bounds of the polynomials.
pub fn verify<A: Arm>(scene: &Scene<A>, motion: &Motion, settings: &VerifySettings) -> Verdict {
    verify_until(scene, motion, settings, &|| true)
}

/// [`verify`] that ends early with [`Violation::Stopped`] when `keep_going` says no; asked for every piece and
/// pair before the first configuration and again after every 64.
pub fn verify_until<A: Arm>(
    scene: &Scene<A>,
    motion: &Motion,
    settings: &VerifySettings,
    keep_going: &dyn Fn() -> bool,
) -> Verdict {
    verify_among(scene, &[], motion, settings, keep_going)
}

/// [`verify_until`] with obstacles that move: in space and time, over the whole time of the motion, by their courses;
/// one whose course is unknown may be anywhere that its greatest speed allows. Only the first of several movers of one
/// obstacle counts.
pub fn verify_among<A: Arm>(
    scene: &Scene<A>,
    movers: &[Mover],
    motion: &Motion,
    settings: &VerifySettings,
    keep_going: &dyn Fn() -> bool,
) -> Verdict {
    let mut violations = Vec::new();
    let joints = scene.arm.joints();
    if motion.joints() != joints.len() {
        let (found, joints, time) = (motion.joints(), joints.len(), motion.start());
        violations.push(Violation::OtherArm { found, joints, time });
        return Verdict {
            violations,
            least_clearance: None,
            joint_margins: Vec::new(),
            motion_margins: Vec::new(),
            posture_changes: Vec::new(),
        };
    }
    let pieces = limits::workable_pieces(motion, &mut violations);
    let passed_jumps = continuity::check(motion.pieces(), joints, settings.continuous, &mut violations);
    let report = |(j, joint)| limits::check(joint, j, pieces.iter().copied(), &mut violations);
    let reports: Vec<limits::JointReport> = joints.iter().enumerate().map(report).collect();
    let passage = Passage { scene, movers, pieces: &pieces, passed_jumps: &passed_jumps };
    let least_clearance = passage.check(settings, keep_going, &mut violations);
    violations.sort_by(|a, b| a.time().total_cmp(&b.time()));
    Verdict {
        violations,
        least_clearance,
        joint_margins: reports.iter().map(|report| report.stops).collect(),
        motion_margins: reports.iter().map(|report| report.motion).collect(),
        posture_changes: posture_changes::posture_changes(&pieces),
    }
}

/// When the first of the violations begins that [`verify_among`] would report (s), infinite where there is none; the time
/// of any of them, which costs less, if `any_will_do`.
///
/// How deep contacts are and how near the arm comes to what it does not touch costs the most of a verdict, and is not
/// worked out. Where the budget of evaluations runs out, this may decide what a verdict does not.
pub(crate) fn clear_until<A: Arm>(
    scene: &Scene<A>,
    movers: &[Mover],
    motion: &Motion,
    settings: &VerifySettings,
    any_will_do: bool,
) -> f64 {
    let joints = scene.arm.joints();
    if motion.joints() != joints.len() {
        return motion.start();
    }
    let mut violations = Vec::new();
    let pieces = limits::workable_pieces(motion, &mut violations);
    let passed_jumps = continuity::check(motion.pieces(), joints, settings.continuous, &mut violations);
    for (j, joint) in joints.iter().enumerate() {
        limits::check(joint, j, pieces.iter().copied(), &mut violations);
    }
    let first = violations.iter().map(Violation::time).fold(f64::INFINITY, f64::min);
    if any_will_do && first < f64::INFINITY {
        return first;
    }
    let passage = Passage { scene, movers, pieces: &pieces, passed_jumps: &passed_jumps };
    passage.clear_until(settings, first, any_will_do)
}
