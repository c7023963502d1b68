use std::f64::consts::{PI, TAU};

use thiserror::Error;

use super::blocked::Blocked;
use crate::arm::JointLimits;
use crate::geometry::{Point, Vector};
use crate::mesh::{Geodesic, Measure, MeshPoint, NavigationMesh, geodesic};
use crate::scene::TwoLinkScene;

/// Rounding that an angle may have gone through on its way to a place (rad).
pub(super) const ANGLE_ROUNDING: f64 = 1e-9;

/// Share of a bound that is given away for the rounding of sums.
pub(super) const SUM_ROUNDING: f64 = 1e-9;

/// The claim that a mesh over both joints, x the first and y the second (rad), leaves open all that is free and
/// can be reached.
#[derive(Debug, Clone, Copy)]
pub struct OpenJoints<'a> {
    /// The cells and their walls.
    pub mesh: &'a NavigationMesh,
    /// Where each start is.
    pub starts: &'a [([f64; 2], MeshPoint)],
    /// The goals; where they are on the mesh is found out.
    pub goals: &'a [[f64; 2]],
    /// Whether the posture must not change: walls may stand at full stretch and fold.
    pub keeps_posture: bool,
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
        path: Geodesic,
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
    /// A seam joins places that are not the same to the arm.
    #[error("side {side} of cell {cell} is connected to another place")]
    Seam {
        /// Which cell.
        cell: usize,
        /// Which of its sides.
        side: usize,
    },
    /// The walls leave a way that the search for the shortest did not find.
    #[error("the shortest path over the mesh was lost in rounding")]
    Lost,
    /// `keep_going` said no.
    #[error("stopped before the bound was proved")]
    Stopped,
}

/// A lower bound of the cost of every motion from any of the starts to any of the goals, or the proof that there is
/// none: every wall that can be reached is shown to be blocked, and the shortest way among them is exact.
///
/// The walls may come from anywhere; a motion that touches nothing passes none of them, so that it
/// is a path on the mesh.
///
/// # Errors
/// [`BoundError`]
pub fn bound_over_joints(
    scene: TwoLinkScene<'_>,
    claim: &OpenJoints<'_>,
    measure: Measure,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Reachability, BoundError> {
    let Some(open) = proved_open(scene, claim, keep_going)? else { return Ok(Reachability::Parted) };
    cheapest(claim.mesh, &open, measure, keep_going)
}

/// A claim that was borne out: where its motions begin and may end.
pub(super) struct Open {
    pub(super) starts: Vec<MeshPoint>,
    pub(super) goals: Vec<MeshPoint>,
    images: Vec<Point>,
}

/// Looks at all that `claim` says; `None` where walls part all starts from all goals.
pub(super) fn proved_open(
    scene: TwoLinkScene<'_>,
    claim: &OpenJoints<'_>,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Open>, BoundError> {
    for (q, place) in claim.starts {
        if !stands_at(scene, q, place, claim.mesh) {
            return Err(BoundError::Place { q: *q });
        }
    }
    let mesh = claim.mesh;
    check_seams(mesh, |j, way| match scene.arm().joints()[j].limits {
        JointLimits::Continuous => (way - TAU * (way / TAU).round()).abs() <= ANGLE_ROUNDING,
        JointLimits::Range { .. } => way == 0.0,
    })?;
    let reached = mesh.reached_from(claim.starts.iter().map(|(_, place)| place.cell));
    let blocked = Blocked::new(scene);
    let stands = |from: Point, to: Point| {
        at_stop(scene, from, to)
            || (claim.keeps_posture && is_in_line(from) && is_in_line(to) && from.y == to.y)
            || blocked.all_along(&[from.x, from.y], &[to.x, to.y])
    };
    if let Some([from, to]) = first_gap(mesh, &|cell| reached[cell], &stands, keep_going)? {
        return Err(BoundError::Wall { from: [from.x, from.y], to: [to.x, to.y] });
    }
    let angles: Vec<Point> = claim.goals.iter().map(|q| Point::new(q[0], q[1])).collect();
    let images = images(scene, mesh, &angles);
    let goals = places_of(mesh, &reached, &images);
    if goals.is_empty() {
        return Ok(None);
    }
    let starts = claim.starts.iter().map(|(_, place)| *place).collect();
    Ok(Some(Open { starts, goals, images }))
}

/// The cheapest path over what is open.
pub(super) fn cheapest(
    mesh: &NavigationMesh,
    open: &Open,
    measure: Measure,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Reachability, BoundError> {
    let Some(path) = geodesic(mesh, &open.starts, &open.goals, measure, &open.images, keep_going) else {
        return Err(if keep_going() { BoundError::Lost } else { BoundError::Stopped });
    };
    let rounding = 2.0 * measure.of(Vector::new(ANGLE_ROUNDING, ANGLE_ROUNDING));
    let cost = (path.cost * (1.0 - SUM_ROUNDING) - rounding).max(0.0);
    Ok(Reachability::AtLeast { cost, path })
}

/// Whether every plane goes on beyond its seams as the arm does: moved by what `is_same` allows of each coordinate.
pub(super) fn check_seams(
    mesh: &NavigationMesh,
    is_same: impl Fn(usize, f64) -> bool,
) -> Result<(), BoundError> {
    for cell in 0..mesh.len() {
        for (side, across) in mesh.sides(cell).iter().enumerate().filter_map(|(i, s)| Some((i, s.across?))) {
            let sound = is_same(0, across.shift.x) && is_same(1, across.shift.y);
            if !sound {
                return Err(BoundError::Seam { cell, side });
            }
        }
    }
    Ok(())
}

/// Every place of cells that matter where one of `points` is: a motion may end in any of them.
pub(super) fn places_of(mesh: &NavigationMesh, matters: &[bool], points: &[Point]) -> Vec<MeshPoint> {
    let mut places = Vec::new();
    for cell in (0..mesh.len()).filter(|&cell| matters[cell]) {
        let sides = mesh.sides(cell);
        let span = |of: fn(&Point) -> f64| {
            let ends = sides.iter().map(|side| of(&side.from));
            ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        };
        let ([x0, x1], [y0, y1]) = (span(|p| p.x), span(|p| p.y));
        let near = |p: &&Point| {
            (x0 - ANGLE_ROUNDING..=x1 + ANGLE_ROUNDING).contains(&p.x)
                && (y0 - ANGLE_ROUNDING..=y1 + ANGLE_ROUNDING).contains(&p.y)
        };
        let held = points.iter().filter(near).filter(|p| mesh.holds(cell, **p));
        places.extend(held.map(|&point| MeshPoint { cell, point }));
    }
    places
}

/// The first wall of the cells that matter that does not stand, sought on all cores where the pool is compiled in.
pub(super) fn first_gap(
    mesh: &NavigationMesh,
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
        let sides = mesh.sides(cell);
        let walls = (0..sides.len()).filter(|&i| sides[i].across.is_none());
        let mut lines = walls.map(|i| [sides[i].from, sides[(i + 1) % sides.len()].from]);
        lines.find(|[from, to]| !stands(*from, *to)).map(Ok)
    };
    #[cfg(feature = "parallel")]
    let found = {
        use rayon::prelude::*;
        (0..mesh.len()).into_par_iter().find_map_first(gap_of)
    };
    #[cfg(not(feature = "parallel"))]
    let found = (0..mesh.len()).find_map(gap_of);
    found.transpose()
}

/// Whether `place` holds `q`, whole revolutions of continuous joints aside.
fn stands_at(scene: TwoLinkScene<'_>, q: &[f64; 2], place: &MeshPoint, mesh: &NavigationMesh) -> bool {
    let at = [place.point.x, place.point.y];
    let same = (0..2).all(|j| {
        let apart = at[j] - q[j];
        let turns = match scene.arm().joints()[j].limits {
            JointLimits::Continuous => TAU * (apart / TAU).round(),
            JointLimits::Range { .. } => 0.0,
        };
        (apart - turns).abs() <= ANGLE_ROUNDING
    });
    same && place.cell < mesh.len() && mesh.holds(place.cell, place.point)
}

/// Whether the line from `from` to `to` lies at or beyond a stop of a joint.
fn at_stop(scene: TwoLinkScene<'_>, from: Point, to: Point) -> bool {
    let beyond = |limits: &JointLimits, a: f64, b: f64| match *limits {
        JointLimits::Continuous => false,
        JointLimits::Range { min, max } => (a <= min && b <= min) || (a >= max && b >= max),
    };
    let [first, second] = scene.arm().joints();
    beyond(&first.limits, from.x, to.x) || beyond(&second.limits, from.y, to.y)
}

fn is_in_line(point: Point) -> bool {
    (point.y - PI * (point.y / PI).round()).abs() <= 1e-12
}

/// The goals in every turn of continuous joints that can be next to a cell.
pub(crate) fn images(scene: TwoLinkScene<'_>, mesh: &NavigationMesh, goals: &[Point]) -> Vec<Point> {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for side in (0..mesh.len()).flat_map(|cell| mesh.sides(cell)) {
        for (j, v) in [side.from.x, side.from.y].into_iter().enumerate() {
            low[j] = low[j].min(v);
            high[j] = high[j].max(v);
        }
    }
    let turns = |j: usize, at: f64| match scene.arm().joints()[j].limits {
        JointLimits::Continuous => {
            let (first, last) = ((low[j] - PI - at) / TAU, (high[j] + PI - at) / TAU);
            first.floor() as i64..=last.ceil() as i64
        }
        JointLimits::Range { .. } => 0..=0,
    };
    let mut images = Vec::new();
    for goal in goals {
        for i in turns(0, goal.x) {
            for j in turns(1, goal.y) {
                images.push(Point::new(goal.x + TAU * i as f64, goal.y + TAU * j as f64));
            }
        }
    }
    images
}
