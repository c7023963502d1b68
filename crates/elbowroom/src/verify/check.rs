use super::continuity;
use super::ends;
use super::foreign::{self, Leniency};
use super::limits;
use super::posture_changes::posture_changes;
use super::rows::Rows;
use super::sweep::Passage;
use super::{Verdict, VerifySettings, Violation};
use crate::scene::Scene;
use crate::trajectory::Motion;

/// Judges whether the scene's arm can run `motion` safely: clear of all obstacles, and of itself where the arm
/// asks for it, by more than the margin, within joint and motion limits, with position, velocity and acceleration that do
/// not jump.
///
/// Obstacles that move are examined in space and time, over the whole time of the motion, by their courses; one whose
/// course is unknown may be anywhere that its maximum speed allows.
///
/// Start and end need not be at rest unless the settings ask for it. Joint limits are closed: what rounding alone can put
/// beyond them is allowed, 1e-12 rad and some last places of the polynomial's terms; motion limits a share of 1e-12.
///
/// # Reference
/// Schwarzer, Saha and Latombe, *Adaptive dynamic collision checking*, IEEE T-RO 21(3), 2005, for the bisection
/// with motion bounds; Farouki, *The Bernstein polynomial basis: a centennial retrospective*, CAGD 29(6), 2012,
/// for the bounds of the polynomials.
pub fn verify(scene: &Scene, motion: &Motion, settings: &VerifySettings) -> Verdict {
    verify_until(scene, motion, settings, &|| true)
}

/// [`verify`] that ends early with [`Violation::Stopped`] when `keep_going` says no; asked for every piece and
/// pair before the first configuration and again after every 64.
pub fn verify_until(
    scene: &Scene,
    motion: &Motion,
    settings: &VerifySettings,
    keep_going: &dyn Fn() -> bool,
) -> Verdict {
    judge(scene, motion, None, settings, keep_going)
}

/// [`verify_until`] for a motion that interpolates [`Rows`]: motion limits are judged with what their digits and their spacing
/// tell of the motion they are from, and all else as ever.
///
/// A limit is broken where every motion through the rows, as far as they are rounded, exceeds it; or where the curve between
/// them does by more than rounding, unless the rows are samples ([`SAMPLED`](super::SAMPLED)) and the curve is a guess. What a curve
/// of samples does beyond a limit, and what is less certain than a share of [`SMALL`](super::SMALL) of its limit, is
/// [`Verdict::unjudged`]; what passed for rounding or tolerance is [`Verdict::allowed`].
///
/// # Reference
/// De Boor, *A practical guide to splines*, for the mean value theorem of divided differences.
pub fn verify_rows(
    scene: &Scene,
    motion: &Motion,
    rows: &Rows,
    settings: &VerifySettings,
    keep_going: &dyn Fn() -> bool,
) -> Verdict {
    judge(scene, motion, Some(rows), settings, keep_going)
}

fn judge(
    scene: &Scene,
    motion: &Motion,
    rows: Option<&Rows>,
    settings: &VerifySettings,
    keep_going: &dyn Fn() -> bool,
) -> Verdict {
    let mut violations = Vec::new();
    let joints = scene.arm().joints();
    if motion.joints() != joints.len() {
        let (found, joints, time) = (motion.joints(), joints.len(), motion.start());
        violations.push(Violation::OtherArm { found, joints, time });
        return Verdict {
            violations,
            least_clearance: None,
            joint_margins: Vec::new(),
            motion_margins: Vec::new(),
            posture_changes: Vec::new(),
            unjudged: Vec::new(),
            allowed: Vec::new(),
        };
    }
    let pieces = limits::workable_pieces(motion, &mut violations);
    let passed_jumps = continuity::check(motion.pieces(), joints, settings.continuous, &mut violations);
    ends::check(motion, joints, settings.ends, &mut violations);
    let report = |(j, joint)| limits::check(joint, j, pieces.iter().copied(), &mut violations);
    let reports: Vec<limits::JointReport> = joints.iter().enumerate().map(report).collect();
    // Pieces that arithmetic cannot work with are left out, and what is left makes no rows.
    let whole = pieces.len() == motion.pieces().len();
    let leniency = rows
        .filter(|_| whole)
        .map_or_else(Leniency::default, |rows| foreign::judge(rows, joints, &pieces, &mut violations));
    let passage = Passage { scene, pieces: &pieces, passed_jumps: &passed_jumps };
    let least_clearance = passage.check(settings, keep_going, &mut violations);
    violations.sort_by(|a, b| a.time().total_cmp(&b.time()));
    Verdict {
        violations,
        least_clearance,
        joint_margins: reports.iter().map(|report| report.stops).collect(),
        motion_margins: reports.iter().map(|report| report.motion).collect(),
        posture_changes: posture_changes(&pieces),
        unjudged: leniency.unjudged,
        allowed: leniency.allowed,
    }
}

/// When the first of the violations begins that [`verify`] would report (s), infinite where there is none; the time
/// of any of them, which costs less, if `any_will_do`.
///
/// How deep contacts are and how near the arm comes to what it does not touch costs the most of a verdict, and is not
/// worked out. Where the budget of evaluations runs out, this may decide what a verdict does not.
pub(crate) fn clear_until(
    scene: &Scene,
    motion: &Motion,
    settings: &VerifySettings,
    any_will_do: bool,
) -> f64 {
    let joints = scene.arm().joints();
    if motion.joints() != joints.len() {
        return motion.start();
    }
    let mut violations = Vec::new();
    let pieces = limits::workable_pieces(motion, &mut violations);
    let passed_jumps = continuity::check(motion.pieces(), joints, settings.continuous, &mut violations);
    ends::check(motion, joints, settings.ends, &mut violations);
    for (j, joint) in joints.iter().enumerate() {
        limits::check(joint, j, pieces.iter().copied(), &mut violations);
    }
    let first = violations.iter().map(Violation::time).fold(f64::INFINITY, f64::min);
    if any_will_do && first < f64::INFINITY {
        return first;
    }
    let passage = Passage { scene, pieces: &pieces, passed_jumps: &passed_jumps };
    passage.clear_until(settings, first, any_will_do)
}
