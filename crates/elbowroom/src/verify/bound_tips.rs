use std::f64::consts::{PI, TAU};

use super::blocked::Blocked;
use super::bound::{BoundError, Reachability, SUM_ROUNDING, check_seams, first_gap, places_of};
use crate::arm::{JointLimits, TwoLink};
use crate::geometry::Point;
use crate::mesh::{Measure, MeshPoint, NavigationMesh, geodesic};
use crate::scene::TwoLinkScene;

/// Rounding that a place of the tip may have gone through, as a share of the greatest coordinate.
const TIP_ROUNDING: f64 = 1e-12;

/// The claim that a mesh over the world's plane (m) leaves open every place that the tip can be at.
#[derive(Debug, Clone, Copy)]
pub struct OpenTips<'a> {
    /// The cells and their walls.
    pub mesh: &'a NavigationMesh,
    /// Where each start is.
    pub starts: &'a [([f64; 2], MeshPoint)],
    /// The goals; where they are on the mesh is found out.
    pub goals: &'a [[f64; 2]],
}

/// A lower bound of the tip travel (m) of every motion from any of the starts to any of the goals: every wall is shown
/// to lie in an obstacle, out of reach, or nearer to the base than the second joint lets the tip come.
///
/// # Errors
/// [`BoundError`]
pub fn bound_over_tips(
    scene: TwoLinkScene<'_>,
    claim: &OpenTips<'_>,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Reachability, BoundError> {
    let arm = scene.arm();
    let (mesh, [_, reach]) = (claim.mesh, arm.reach());
    let size = arm.base().x.abs() + arm.base().y.abs() + reach;
    check_seams(mesh, |_, way| way == 0.0)?;
    for (q, place) in claim.starts {
        let near = place.point.distance(arm.tip(q)) <= TIP_ROUNDING * size;
        if !(near && place.cell < mesh.len() && mesh.holds(place.cell, place.point)) {
            return Err(BoundError::Place { q: *q });
        }
    }
    let blocked = Blocked::new(scene);
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
    if let Some([from, to]) = first_gap(mesh, &|_| true, &stands, keep_going)? {
        return Err(BoundError::TipWall { from: [from.x, from.y], to: [to.x, to.y] });
    }
    let starts: Vec<MeshPoint> = claim.starts.iter().map(|(_, place)| *place).collect();
    let tips: Vec<Point> = claim.goals.iter().map(|q| arm.tip(q)).collect();
    let reached = mesh.reached_from(starts.iter().map(|start| start.cell));
    let goals = places_of(mesh, &reached, &tips);
    match geodesic(mesh, &starts, &goals, Measure::Euclidean, &tips, keep_going) {
        Some(path) => {
            // Places are as near to the tips as rounding lets them be.
            let cost = path.cost * (1.0 - SUM_ROUNDING) - 2.0 * TIP_ROUNDING * size;
            Ok(Reachability::AtLeast { cost: cost.max(0.0), path })
        }
        None if goals.is_empty() => Ok(Reachability::Parted),
        None if keep_going() => Err(BoundError::Lost),
        None => Err(BoundError::Stopped),
    }
}

/// How near to the base the tip can come (m), by the links and where the second joint may be.
pub(crate) fn innermost_reach(arm: &TwoLink) -> f64 {
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
