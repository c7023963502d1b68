//! Planning on places and postures: what comes out is a motion that the verifier has proved to be safe.

use super::choose::cheapest;
use super::limits::{motion_limits, stated_limits};
use super::posture_graph::PostureGraph;
use super::problem::Problem;
use super::settings::{Method, Objective, Pace, PlanSettings};
use super::smooth::{SmoothError, smooth};
use super::{Monitor, Plan, PlanError, Stage};

use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::path::JointPath;
use crate::scene::{Scene, Task};
use crate::search::{Dstar, Graph, Progress, Until};
use crate::swarm::{GuidedSwarmSettings, Terrain, draw_paths};

/// Expansions of D* between two looks at the monitor: a few milliseconds.
const EXPANSIONS_PER_LOOK: usize = 1_000;

/// By how much a tip path may be longer than the shortest and still be chosen for what the arm pays, as a share.
pub const NEARLY_EQUAL: f64 = 0.01;

/// Path costs that differ by less than this share are the same: sums of the same steps in another order.
const SAME_COST: f64 = 1e-9;

/// Plans `task`: a path over (place, posture) whose every step is certified free, and a motion along it that the
/// verifier accepts.
///
/// # Errors
/// [`PlanError`]; a missing path is [`PlanError::NotFound`], not proved here.
pub fn plan(
    scene: &Scene,
    task: &Task,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    check(settings)?;
    let problem = Problem::new(scene, task)?;
    let (limits, assumed_limits) = motion_limits(&scene.arm);

    let found = match problem.already_there() {
        Some(q) => Found { cost: 0.0, path: JointPath(vec![q]), paths: 1 },
        None => shortest(scene, &problem, settings, &limits, monitor)?,
    };

    monitor.stage(Stage::Trajectory);
    let stated = stated_limits(&scene.arm);
    let smoothed = smooth(scene, &found.path, &limits, &stated, settings.pace, monitor).map_err(|error| {
        match (error, settings.pace) {
            (SmoothError::TooFast { fastest }, Pace::Duration(duration)) => {
                PlanError::TooFast { duration, fastest }
            }
            (SmoothError::Motion(error), _) => error.into(),
            (SmoothError::Refused(verdict), _) => PlanError::Refused(verdict),
            (SmoothError::Stopped | SmoothError::TooFast { .. }, _) => PlanError::Stopped,
        }
    })?;
    let cost = match settings.objective {
        Objective::Tip => smoothed.trajectory.motion().tip_length(&scene.arm),
        Objective::Joint => smoothed.trajectory.motion().joint_length(),
        Objective::Time => smoothed.trajectory.motion().duration(),
    };
    Ok(Plan {
        cost,
        path_cost: found.cost,
        paths_to_choose_from: found.paths,
        tip_path: found.path.tips(&scene.arm),
        joint_path: found.path,
        vias: smoothed.vias,
        stops: smoothed.stops,
        trajectory: smoothed.trajectory,
        assumed_limits,
    })
}

/// A certified path, its tip travel (m), and how many it was chosen from.
struct Found {
    cost: f64,
    path: JointPath,
    paths: usize,
}

fn shortest(
    scene: &Scene,
    problem: &Problem,
    settings: &PlanSettings,
    limits: &[crate::trajectory::SpeedLimits; 2],
    monitor: &impl Monitor,
) -> Result<Found, PlanError> {
    let not_found = || PlanError::NotFound { step: scene.grid.step() };
    monitor.stage(Stage::FreeSpace);
    let space = FreeSpace::of_until(scene, &|| monitor.keep_going()).ok_or(PlanError::Stopped)?;

    monitor.stage(Stage::CostToGo);
    let mut graph = PostureGraph::new(scene, &space, problem.may_flip);
    let goals: Vec<usize> = problem.goals.iter().map(|q| graph.insert(*q)).collect();
    let starts: Vec<usize> = problem.starts.iter().map(|q| graph.insert(*q)).collect();
    let mut field = Dstar::new(graph.len());
    for &goal in &goals {
        field.insert_goal(goal, 0.0)?;
    }
    for &start in &starts {
        while field.expand(&graph, Until::Settled(start), EXPANSIONS_PER_LOOK) == Progress::Paused {
            if !monitor.keep_going() {
                return Err(PlanError::Stopped);
            }
        }
    }
    let least = starts.iter().map(|&start| field.cost_to_go(start)).fold(f64::INFINITY, f64::min);
    if least.is_infinite() {
        return Err(not_found());
    }

    monitor.stage(Stage::TipPath);
    let slack = match settings.objective {
        Objective::Tip => 0.0,
        Objective::Joint | Objective::Time => NEARLY_EQUAL,
    };
    let worth_it = starts.iter().filter(|&&start| field.cost_to_go(start) <= least * (1.0 + slack));
    let mut drawn: Vec<(f64, Vec<usize>)> = Vec::new();
    for &start in worth_it {
        // The swarm starts from what D* knows: where it cannot do better it does no worse.
        drawn.push((field.cost_to_go(start), field.path(start).ok_or_else(not_found)?));
        match &settings.method {
            Method::Dstar => {}
            Method::DstarPso(swarm) => {
                let swarm = GuidedSwarmSettings { keep_within: swarm.keep_within.max(slack), ..*swarm };
                let goal_tips: Vec<Point> = goals.iter().map(|&goal| graph.tip(goal)).collect();
                let terrain = Terrain {
                    graph: &graph,
                    cost_to_go: &|node| field.cost_to_go(node),
                    distance: &|node| {
                        let tip = graph.tip(node);
                        goal_tips.iter().map(|goal| goal.distance(tip)).fold(f64::INFINITY, f64::min)
                    },
                    is_goal: &|node| goals.contains(&node),
                };
                let paths = draw_paths(&terrain, start, &swarm, settings.seed, &|| monitor.keep_going());
                let paths = paths.ok_or(PlanError::Stopped)?;
                drawn.extend(paths.costs.into_iter().zip(paths.paths));
            }
        }
    }

    monitor.stage(Stage::JointPath);
    drawn.retain(|(cost, _)| *cost <= least * (1.0 + slack.max(SAME_COST)));
    let paths = drawn.len();
    let candidates = drawn
        .into_iter()
        .map(|(cost, nodes)| Some((cost, graph.joint_path(&nodes)?)))
        .collect::<Option<Vec<(f64, JointPath)>>>()
        .ok_or_else(not_found)?;
    let (cost, path) = cheapest(scene, limits, settings.objective, candidates).ok_or_else(not_found)?;
    Ok(Found { cost, path, paths })
}

fn check(settings: &PlanSettings) -> Result<(), PlanError> {
    if let Method::DstarPso(swarm) = &settings.method {
        swarm.check()?;
    }
    match settings.pace {
        Pace::Duration(duration) if !(duration.is_finite() && duration > 0.0) => {
            Err(PlanError::Duration { duration })
        }
        _ => Ok(()),
    }
}
