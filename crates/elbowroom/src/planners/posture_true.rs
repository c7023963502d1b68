//! Planning on places and postures: what comes out is a motion that the verifier has proved to be safe.

use super::choose::shortlist;
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
use crate::trajectory::SpeedLimits;
use crate::verify::Trajectory;

/// Expansions of D* between two looks at the monitor: a few milliseconds.
const EXPANSIONS_PER_LOOK: usize = 1_000;

/// By how much a tip path may be longer than the shortest and still be chosen for what the arm pays, as a share.
pub const NEARLY_EQUAL: f64 = 0.01;

/// How many of the drawn paths are made into motions: what a path promises and what its motion costs differ.
const SHORTLIST: usize = 8;

/// Costs that differ by less than this share are the same: sums of the same steps in another order.
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
        Some(q) => Found { candidates: vec![(0.0, JointPath(vec![q]))], paths: 1 },
        None => shortest(scene, &problem, settings, &limits, monitor)?,
    };

    monitor.stage(Stage::Trajectory);
    let stated = stated_limits(&scene.arm);
    let mut best: Option<Plan> = None;
    let mut refused = PlanError::Stopped;
    for (path_cost, joint_path) in found.candidates {
        let smoothed = match smooth(scene, &joint_path, &limits, &stated, settings.pace, monitor) {
            Ok(smoothed) => smoothed,
            Err(SmoothError::Stopped) => return Err(PlanError::Stopped),
            Err(error) => {
                refused = in_terms_of(settings.pace, error);
                continue;
            }
        };
        let cost = cost(scene, settings.objective, &smoothed.trajectory);
        let clearance = |trajectory: &Trajectory| {
            trajectory.verdict().least_clearance.map_or(f64::INFINITY, |least| least.distance)
        };
        let better = best.as_ref().is_none_or(|known| {
            let slack = SAME_COST * known.cost;
            cost < known.cost - slack
                || (cost <= known.cost + slack
                    && clearance(&smoothed.trajectory) > clearance(&known.trajectory))
        });
        if better {
            best = Some(Plan {
                cost,
                path_cost,
                paths_to_choose_from: found.paths,
                tip_path: joint_path.tips(&scene.arm),
                joint_path,
                vias: smoothed.vias,
                stops: smoothed.stops,
                trajectory: smoothed.trajectory,
                assumed_limits: assumed_limits.clone(),
            });
        }
    }
    best.ok_or(refused)
}

/// What `trajectory` costs in terms of `objective`.
fn cost(scene: &Scene, objective: Objective, trajectory: &Trajectory) -> f64 {
    let motion = trajectory.motion();
    match objective {
        Objective::Tip => motion.tip_length(&scene.arm),
        Objective::Joint => motion.joint_length(),
        Objective::Time => motion.duration(),
    }
}

fn in_terms_of(pace: Pace, error: SmoothError) -> PlanError {
    match (error, pace) {
        (SmoothError::TooFast { fastest }, Pace::Duration(duration)) => {
            PlanError::TooFast { duration, fastest }
        }
        (SmoothError::Motion(error), _) => error.into(),
        (SmoothError::Refused(verdict), _) => PlanError::Refused(verdict),
        (SmoothError::Stopped | SmoothError::TooFast { .. }, _) => PlanError::Stopped,
    }
}

/// Certified paths with their tip travel (m), and how many they were chosen from.
struct Found {
    candidates: Vec<(f64, JointPath)>,
    paths: usize,
}

fn shortest(
    scene: &Scene,
    problem: &Problem,
    settings: &PlanSettings,
    limits: &[SpeedLimits; 2],
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
    let mut own: Vec<(f64, Vec<usize>)> = Vec::new();
    let mut drawn: Vec<(f64, Vec<usize>)> = Vec::new();
    for &start in worth_it {
        own.push((field.cost_to_go(start), field.path(start).ok_or_else(not_found)?));
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
    drawn.retain(|(cost, nodes)| {
        *cost <= least * (1.0 + slack.max(SAME_COST)) && own.iter().all(|(_, known)| known != nodes)
    });
    let paths = own.len() + drawn.len();
    let joined = |paths: Vec<(f64, Vec<usize>)>| {
        let joined = paths.into_iter().map(|(cost, nodes)| Some((cost, graph.joint_path(&nodes)?)));
        joined.collect::<Option<Vec<(f64, JointPath)>>>().ok_or_else(not_found)
    };
    // D*'s own paths stay in the running whatever they promise, so that the swarm's choice is never worse.
    let mut candidates = joined(own)?;
    candidates.extend(shortlist(scene, limits, settings.objective, joined(drawn)?, SHORTLIST));
    Ok(Found { candidates, paths })
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
