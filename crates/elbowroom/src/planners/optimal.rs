//! Paths that leave the grid of the tip: searched over the joints, or over the tip for tip travel, then pulled taut.

use super::joint_grid::JointGrid;
use super::problem::Problem;
use super::pull::{Plane, Pull};
use super::settings::Objective;
use super::sheets::direct;
use super::{Monitor, PlanError, Stage};
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::scene::Scene;
use crate::search::{Dstar, Graph, Progress, Until};
use crate::trajectory::SpeedLimits;

/// Distances between angles that are tried, coarsest first (rad).
const STEPS: [f64; 4] = [0.035, 0.0175, 0.009, 0.0045];

/// How many of the steps from the first that finds a way are taken.
const STEPS_WITH_A_PATH: usize = 2;

/// Clearance that taut lines keep where they can (m): room for the motion to be smooth in; and none.
const MARGINS: [f64; 3] = [1e-3, 1e-4, 0.0];

/// Longest turn of a straight line of the tip, in grid steps.
const TIP_TURN: f64 = 0.5;

/// Expansions of D* between two looks at the monitor: a few milliseconds.
const EXPANSIONS_PER_LOOK: usize = 1_000;

/// Taut paths over the joints, by objective: joint travel, or time with each joint at its greatest speed.
pub(crate) fn over_joints(
    scene: &Scene,
    problem: &Problem,
    objective: Objective,
    limits: &[SpeedLimits; 2],
    monitor: &impl Monitor,
) -> Result<Vec<JointPath>, PlanError> {
    let weights = match objective {
        Objective::Tip | Objective::Joint => [1.0; 2],
        Objective::Time => limits.map(|limit| 1.0 / limit.velocity),
    };
    let mut found = Vec::new();
    let mut steps_with_a_path = 0;
    let mut finest = f64::INFINITY;
    for step in STEPS {
        monitor.stage(Stage::CostToGo);
        let Some(mut graph) = JointGrid::new(scene, step, weights, problem.may_flip) else { break };
        finest = step;
        if let Some(path) = shortest(scene, problem, &mut graph, monitor)? {
            monitor.stage(Stage::JointPath);
            found.extend(taut(scene, &path, Plane::Joints(weights), monitor)?);
            steps_with_a_path += 1;
        }
        if steps_with_a_path == STEPS_WITH_A_PATH {
            break;
        }
    }
    if found.is_empty() {
        return Err(PlanError::NotFoundOverJoints { step: finest });
    }
    Ok(found)
}

/// `path`, a certified one, pulled taut in the plane of the tip.
pub(crate) fn over_tips(
    scene: &Scene,
    path: &JointPath,
    monitor: &impl Monitor,
) -> Result<Vec<JointPath>, PlanError> {
    monitor.stage(Stage::JointPath);
    taut(scene, path, Plane::Tip(TIP_TURN * scene.grid.step()), monitor)
}

fn taut(
    scene: &Scene,
    path: &JointPath,
    plane: Plane,
    monitor: &impl Monitor,
) -> Result<Vec<JointPath>, PlanError> {
    let pulled = MARGINS.map(|margin| {
        let pull = Pull { scene, plane, margin };
        pull.taut(path, &|| monitor.keep_going()).ok_or(PlanError::Stopped)
    });
    let mut found: Vec<JointPath> = Vec::new();
    for path in pulled {
        let path = path?;
        if !found.contains(&path) {
            found.push(path);
        }
    }
    Ok(found)
}

/// The shortest way over the grid of joint angles, or `None` if it does not connect starts and goals.
fn shortest(
    scene: &Scene,
    problem: &Problem,
    graph: &mut JointGrid<'_>,
    monitor: &impl Monitor,
) -> Result<Option<JointPath>, PlanError> {
    let goals: Vec<usize> = problem.goals.iter().map(|q| graph.insert(*q)).collect();
    let starts: Vec<usize> = problem.starts.iter().map(|q| graph.insert(*q)).collect();
    let mut field = Dstar::new(graph.len());
    for &goal in &goals {
        field.insert_goal(goal, 0.0)?;
    }
    for &start in &starts {
        while field.expand(graph, Until::Settled(start), EXPANSIONS_PER_LOOK) == Progress::Paused {
            if !monitor.keep_going() {
                return Err(PlanError::Stopped);
            }
        }
    }
    let best = starts.into_iter().min_by(|&a, &b| field.cost_to_go(a).total_cmp(&field.cost_to_go(b)));
    let Some(nodes) = best.and_then(|start| field.path(start)) else { return Ok(None) };
    let mut places: Vec<Configuration<2>> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let to = graph.configuration(node);
        let next = places.last().map_or(Some(to), |from| direct(&scene.arm, from, &to));
        places.extend(next);
    }
    Ok(Some(JointPath(places)))
}
