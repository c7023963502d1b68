//! Which of many paths are worth being made into motions.

use crate::arm::Configuration;
use crate::path::{JointPath, link_clearances, simplify};
use crate::planning::Objective;
use crate::scene::Scene;
use crate::trajectory::SpeedLimits;

/// Paths whose estimated cost differs by no more than about this share are the same to the objective: clearance decides.
const SAME_COST: f64 = 1e-9;

/// The `most` paths of least estimated cost, cheapest first; among equal ones those with more clearance, then earlier ones.
pub(crate) fn shortlist(
    scene: &Scene,
    limits: &[SpeedLimits],
    objective: Objective,
    paths: Vec<(f64, JointPath)>,
    most: usize,
) -> Vec<(f64, JointPath)> {
    let estimated_cost = |tip_cost: f64, path: &JointPath| {
        let corners = || corners(scene, path);
        objective.estimate(limits, || tip_cost, || JointPath(corners()).length(), corners)
    };
    let mut estimated: Vec<(f64, f64, (f64, JointPath))> = paths
        .into_iter()
        .map(|(tip_cost, path)| (estimated_cost(tip_cost, &path), clearance(scene, &path), (tip_cost, path)))
        .collect();
    let least = estimated.iter().map(|(estimate, ..)| *estimate).fold(f64::INFINITY, f64::min);
    // Steps of rounding's size, so that sums of the same steps in another order are the same estimate.
    let step = |estimate: f64| (estimate / (SAME_COST * least.max(f64::MIN_POSITIVE))).round();
    estimated.sort_by(|a, b| step(a.0).total_cmp(&step(b.0)).then(b.1.total_cmp(&a.1)));
    estimated.into_iter().map(|(_, _, path)| path).take(most).collect()
}

/// The path without the grid's zigzag, which no motion through it keeps.
fn corners(scene: &Scene, path: &JointPath) -> Vec<Configuration> {
    simplify(scene.arm(), &path.0, scene.grid().step()).into_iter().map(|i| path.0[i].clone()).collect()
}

/// Least clearance at the places of `path` (m).
fn clearance(scene: &Scene, path: &JointPath) -> f64 {
    path.0.iter().flat_map(|q| link_clearances(scene, q)).fold(f64::INFINITY, f64::min)
}
