//! Which of several paths the arm pays least for.

use super::settings::Objective;
use crate::arm::Configuration;
use crate::path::{JointPath, link_clearances, simplify};
use crate::scene::Scene;
use crate::trajectory::{SpeedLimits, fastest_durations, vias_at};

/// Paths whose price differs by less than this share are the same to the objective: clearance decides.
const SAME_PRICE: f64 = 1e-9;

/// The path of least price; among equal ones that with the most clearance, then the first.
pub(crate) fn cheapest(
    scene: &Scene,
    limits: &[SpeedLimits; 2],
    objective: Objective,
    paths: Vec<(f64, JointPath)>,
) -> Option<(f64, JointPath)> {
    let mut best: Option<(f64, f64, f64, JointPath)> = None;
    for (tip_cost, path) in paths {
        let price = match objective {
            Objective::Tip => tip_cost,
            Objective::Joint => JointPath(corners(scene, &path)).length(),
            Objective::Time => fastest_durations(&vias_at(&corners(scene, &path)), limits).iter().sum(),
        };
        let better = |known: f64, known_clearance: f64| {
            let slack = SAME_PRICE * known;
            price < known - slack || (price <= known + slack && clearance(scene, &path) > known_clearance)
        };
        if best.as_ref().is_none_or(|&(known, known_clearance, ..)| better(known, known_clearance)) {
            best = Some((price, clearance(scene, &path), tip_cost, path));
        }
    }
    best.map(|(_, _, tip_cost, path)| (tip_cost, path))
}

/// The path without the grid's zigzag, which no motion through it keeps.
fn corners(scene: &Scene, path: &JointPath) -> Vec<Configuration<2>> {
    simplify(&scene.arm, path, scene.grid.step()).into_iter().map(|i| path.0[i]).collect()
}

/// Least clearance at the places of `path` (m).
fn clearance(scene: &Scene, path: &JointPath) -> f64 {
    path.0.iter().flat_map(|q| link_clearances(scene, q)).fold(f64::INFINITY, f64::min)
}
