//! A certified path made cheaper: straight joint motions in place of detours.

use super::local_planner::LocalPlanner;
use super::settings::SETTINGS;
use crate::arm::{Arm, Configuration, joint_distance};
use crate::path::{JointPath, simplify};
use crate::planning::{Exhausted, Objective, motion_limits};

/// What `path` promises to cost in terms of `objective`.
pub(in crate::planners) fn estimated_cost(
    arm: &Arm,
    objective: Objective,
    path: &JointPath,
    grid_step: f64,
) -> f64 {
    let corners = || {
        let kept = simplify(arm, &path.0, SETTINGS.tolerance * grid_step);
        kept.into_iter().map(|i| path.0[i].clone()).collect()
    };
    objective.estimate(&motion_limits(arm).0, || path.tip_travel(arm), || path.length(), corners)
}

/// `path` with straight joint motions, certified, in place of stretches that weigh more; it ends early where the budget does.
///
/// # Errors
/// [`Exhausted::Failed`]
pub(in crate::planners) fn shortened(
    local: &mut LocalPlanner<'_>,
    mut path: Vec<Configuration>,
    objective: Objective,
) -> Result<JointPath, Exhausted> {
    let arm = local.scene.arm();
    let mut idle = 0;
    for _ in 0..SETTINGS.shortcuts {
        if path.len() < 2 || idle == SETTINGS.shortcut_patience {
            break;
        }
        idle += 1;
        let (a, b) = (local.unit(), local.unit());
        let (first, last) = (place(&path, a.min(b)), place(&path, a.max(b)));
        if first.0 == last.0 {
            continue;
        }
        let mut stretch = vec![first.1.clone()];
        stretch.extend(path[first.0 + 1..=last.0].iter().cloned());
        stretch.push(last.1.clone());
        let ends = [first.1.clone(), last.1.clone()];
        if objective.weight(arm, &ends) >= objective.weight(arm, &stretch) * (1.0 - 1e-6) {
            continue;
        }
        match local.connects(&first.1, &last.1) {
            Ok(true) => {
                path.splice(first.0 + 1..=last.0, ends);
                path.dedup();
                idle = 0;
            }
            Ok(false) => {}
            Err(Exhausted::Spent) => break,
            Err(halt) => return Err(halt),
        }
    }
    Ok(JointPath(path))
}

/// The place at `share` of the way along `path`, and the index of the one it lies after.
fn place(path: &[Configuration], share: f64) -> (usize, Configuration) {
    let lengths: Vec<f64> = path.windows(2).map(|pair| joint_distance(&pair[0], &pair[1])).collect();
    let mut left = share * lengths.iter().sum::<f64>();
    for (i, length) in lengths.iter().enumerate() {
        if left < *length {
            let fraction = left / length;
            return (i, path[i].lerp(&path[i + 1], fraction));
        }
        left -= length;
    }
    let before = path.len().saturating_sub(2);
    (before, path[path.len() - 1].clone())
}
