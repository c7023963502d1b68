use std::f64::consts::{PI, TAU};

use thiserror::Error;

use super::blocked::Blocked;
use crate::arm::{Configuration, JointLimits, TwoLinkArm};
use crate::geometry::Point;
use crate::scene::Scene;
use crate::surface::{Measure, Surface, SurfacePlace, TautPath, taut_path};

/// Rounding that an angle may have gone through on its way to a place (rad).
const ANGLE_ROUNDING: f64 = 1e-9;

/// Rounding that a place of the tip may have gone through, as a share of the greatest coordinate.
const TIP_ROUNDING: f64 = 1e-12;

/// Share of a bound that is given away for the rounding of sums.
const SUM_ROUNDING: f64 = 1e-9;

/// The claim that a surface over both joints, x the first and y the second (rad), leaves open all that is free and
/// can be reached.
#[derive(Debug, Clone, Copy)]
pub struct OpenJoints<'a> {
    /// The cells and their walls.
    pub surface: &'a Surface,
    /// Where each start is.
    pub starts: &'a [(Configuration<2>, SurfacePlace)],
    /// Where each goal is.
    pub goals: &'a [(Configuration<2>, SurfacePlace)],
    /// Whether the posture must not change: walls may stand at full stretch and fold.
    pub keeps_posture: bool,
    /// Clearance that is asked for (m): what comes nearer counts as blocked.
    pub margin: f64,
}

/// What is known of every motion from a start to a goal.
#[derive(Debug, Clone, PartialEq)]
pub enum Reachability {
    /// None exists: walls part all starts from all goals.
    Parted,
    /// None costs less than this.
    AtLeast {
        /// In terms of the measure.
        cost: f64,
        /// The cheapest path over what the claim leaves open, which may not be free.
        path: TautPath,
    },
}

/// Why a claim proves nothing.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BoundError {
    /// A wall stands where the arm may be able to pass.
    #[error("the wall from {from:?} to {to:?} rad is not proved to be blocked")]
    Wall {
        /// Where it begins (rad).
        from: [f64; 2],
        /// Where it ends (rad).
        to: [f64; 2],
    },
    /// A wall stands where the tip may be able to pass.
    #[error("the wall from {from:?} to {to:?} m is not proved to be blocked")]
    TipWall {
        /// Where it begins (m).
        from: [f64; 2],
        /// Where it ends (m).
        to: [f64; 2],
    },
    /// A start or goal is not where it is said to be.
    #[error("{q:?} rad is not at the place it is given")]
    Place {
        /// The configuration (rad).
        q: [f64; 2],
    },
    /// `keep_going` said no.
    #[error("stopped before the bound was proved")]
    Stopped,
}

/// A lower bound of the cost of every motion from any of the starts to any of the goals, or the proof that there is
/// none: every wall that can be reached is shown to be blocked, and the shortest way among them is exact.
///
/// The walls may come from anywhere; a motion that is clear by more than the margin passes none of them, so that it
/// is a path on the surface.
///
/// # Errors
/// [`BoundError`]
pub fn bound_over_joints(
    scene: &Scene,
    claim: &OpenJoints<'_>,
    measure: Measure,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Reachability, BoundError> {
    for (q, place) in claim.starts.iter().chain(claim.goals) {
        if !stands_at(scene, q, place, claim.surface) {
            return Err(BoundError::Place { q: q.0 });
        }
    }
    let surface = claim.surface;
    let reached = surface.reached_from(claim.starts.iter().map(|(_, place)| place.cell));
    let blocked = Blocked::new(scene, claim.margin);
    let stands = |from: Point, to: Point| {
        at_stop(scene, from, to)
            || (claim.keeps_posture && is_in_line(from) && is_in_line(to) && from.y == to.y)
            || blocked.all_along(&Configuration([from.x, from.y]), &Configuration([to.x, to.y]))
    };
    if let Some([from, to]) = first_gap(surface, &|cell| reached[cell], &stands, keep_going)? {
        return Err(BoundError::Wall { from: [from.x, from.y], to: [to.x, to.y] });
    }
    let places =
        |ends: &[(Configuration<2>, SurfacePlace)]| ends.iter().map(|(_, place)| *place).collect::<Vec<_>>();
    let (starts, goals) = (places(claim.starts), places(claim.goals));
    if goals.iter().all(|goal| !reached[goal.cell]) {
        return Ok(Reachability::Parted);
    }
    let images = images(scene, surface, &goals);
    let path =
        taut_path(surface, &starts, &goals, measure, &images, keep_going).ok_or(BoundError::Stopped)?;
    Ok(Reachability::AtLeast { cost: path.cost * (1.0 - SUM_ROUNDING), path })
}

/// The claim that a surface over the world's plane (m) leaves open every place that the tip can be at.
#[derive(Debug, Clone, Copy)]
pub struct OpenTips<'a> {
    /// The cells and their walls.
    pub surface: &'a Surface,
    /// Where each start is.
    pub starts: &'a [(Configuration<2>, SurfacePlace)],
    /// Where each goal is.
    pub goals: &'a [(Configuration<2>, SurfacePlace)],
    /// Clearance that is asked for (m): what comes nearer counts as blocked.
    pub margin: f64,
}

/// A lower bound of the tip travel (m) of every motion from any of the starts to any of the goals: every wall is shown
/// to lie in an obstacle, out of reach, or nearer to the base than the second joint lets the tip come.
///
/// # Errors
/// [`BoundError`]
pub fn bound_over_tips(
    scene: &Scene,
    claim: &OpenTips<'_>,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Reachability, BoundError> {
    let arm = &scene.arm;
    let (surface, [_, reach]) = (claim.surface, arm.reach());
    let size = arm.base().x.abs() + arm.base().y.abs() + reach;
    for (q, place) in claim.starts.iter().chain(claim.goals) {
        let near = place.point.distance(arm.tip(q)) <= TIP_ROUNDING * size;
        if !(near && place.cell < surface.len() && surface.holds(place.cell, place.point)) {
            return Err(BoundError::Place { q: q.0 });
        }
    }
    let blocked = Blocked::new(scene, claim.margin);
    let hole = innermost_reach(arm) - TIP_ROUNDING * size;
    let in_hole = |p: Point| p.distance(arm.base()) <= hole;
    let out_of_reach = |a: Point, b: Point| {
        let beyond = |a: f64, b: f64| (a >= reach && b >= reach) || (a <= -reach && b <= -reach);
        let (a, b) = (a - arm.base(), b - arm.base());
        beyond(a.x, b.x) || beyond(a.y, b.y)
    };
    let stands = |from: Point, to: Point| {
        // A disc holds the line between two of its places.
        out_of_reach(from, to) || (in_hole(from) && in_hole(to)) || blocked.tip_all_along(from, to, 0)
    };
    if let Some([from, to]) = first_gap(surface, &|_| true, &stands, keep_going)? {
        return Err(BoundError::TipWall { from: [from.x, from.y], to: [to.x, to.y] });
    }
    let places =
        |ends: &[(Configuration<2>, SurfacePlace)]| ends.iter().map(|(_, place)| *place).collect::<Vec<_>>();
    let (starts, goals) = (places(claim.starts), places(claim.goals));
    let images: Vec<Point> = goals.iter().map(|goal| goal.point).collect();
    match taut_path(surface, &starts, &goals, Measure::Euclidean, &images, keep_going) {
        Some(path) => {
            // Places are as near to the tips as rounding lets them be.
            let cost = path.cost * (1.0 - SUM_ROUNDING) - 2.0 * TIP_ROUNDING * size;
            Ok(Reachability::AtLeast { cost: cost.max(0.0), path })
        }
        None if keep_going() => Ok(Reachability::Parted),
        None => Err(BoundError::Stopped),
    }
}

/// The first wall of the cells that matter that does not stand, looked for on all cores where the pool is compiled in.
fn first_gap(
    surface: &Surface,
    matters: &(dyn Fn(usize) -> bool + Sync),
    stands: &(dyn Fn(Point, Point) -> bool + Sync),
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Option<[Point; 2]>, BoundError> {
    let gap_of = |cell: usize| {
        if !matters(cell) {
            return None;
        }
        if !keep_going() {
            return Some(Err(BoundError::Stopped));
        }
        let sides = surface.sides(cell);
        let walls = (0..sides.len()).filter(|&i| sides[i].across.is_none());
        let mut lines = walls.map(|i| [sides[i].from, sides[(i + 1) % sides.len()].from]);
        lines.find(|[from, to]| !stands(*from, *to)).map(Ok)
    };
    #[cfg(feature = "parallel")]
    let found = {
        use rayon::prelude::*;
        (0..surface.len()).into_par_iter().find_map_first(gap_of)
    };
    #[cfg(not(feature = "parallel"))]
    let found = (0..surface.len()).find_map(gap_of);
    found.transpose()
}

/// How near to the base the tip can come (m), by the links and where the second joint may be.
pub(crate) fn innermost_reach(arm: &TwoLinkArm) -> f64 {
    let ([l1, l2], [nearest, _]) = (arm.lengths(), arm.reach());
    match arm.joints()[1].limits {
        JointLimits::Continuous => nearest,
        JointLimits::Range { min, max } => {
            // Folded where the angle is an odd number of half turns.
            let folds = ((min - PI) / TAU).ceil() * TAU + PI <= max;
            let cos = libm::cos(min).min(libm::cos(max));
            if folds { nearest } else { (l1 * l1 + l2 * l2 + 2.0 * l1 * l2 * cos).max(0.0).sqrt() }
        }
    }
}

/// Whether `place` holds `q`, whole turns of continuous joints aside.
fn stands_at(scene: &Scene, q: &Configuration<2>, place: &SurfacePlace, surface: &Surface) -> bool {
    let at = [place.point.x, place.point.y];
    let same = (0..2).all(|j| {
        let apart = at[j] - q.0[j];
        let turns = match scene.arm.joints()[j].limits {
            JointLimits::Continuous => TAU * (apart / TAU).round(),
            JointLimits::Range { .. } => 0.0,
        };
        (apart - turns).abs() <= ANGLE_ROUNDING
    });
    same && place.cell < surface.len() && surface.holds(place.cell, place.point)
}

/// Whether the line from `from` to `to` lies at or beyond a stop of a joint.
fn at_stop(scene: &Scene, from: Point, to: Point) -> bool {
    let beyond = |limits: &JointLimits, a: f64, b: f64| match *limits {
        JointLimits::Continuous => false,
        JointLimits::Range { min, max } => (a <= min && b <= min) || (a >= max && b >= max),
    };
    let [first, second] = scene.arm.joints();
    beyond(&first.limits, from.x, to.x) || beyond(&second.limits, from.y, to.y)
}

fn is_in_line(point: Point) -> bool {
    (point.y - PI * (point.y / PI).round()).abs() <= 1e-12
}

/// The goals in every turn of continuous joints that can be next to a cell.
pub(crate) fn images(scene: &Scene, surface: &Surface, goals: &[SurfacePlace]) -> Vec<Point> {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for side in (0..surface.len()).flat_map(|cell| surface.sides(cell)) {
        for (j, v) in [side.from.x, side.from.y].into_iter().enumerate() {
            low[j] = low[j].min(v);
            high[j] = high[j].max(v);
        }
    }
    let turns = |j: usize, at: f64| match scene.arm.joints()[j].limits {
        JointLimits::Continuous => {
            let (first, last) = ((low[j] - PI - at) / TAU, (high[j] + PI - at) / TAU);
            first.floor() as i64..=last.ceil() as i64
        }
        JointLimits::Range { .. } => 0..=0,
    };
    let mut images = Vec::new();
    for goal in goals {
        for i in turns(0, goal.point.x) {
            for j in turns(1, goal.point.y) {
                images.push(Point::new(goal.point.x + TAU * i as f64, goal.point.y + TAU * j as f64));
            }
        }
    }
    images
}
