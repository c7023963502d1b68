//! Certified paths over the grid that are worth being made into motions: D*'s, and those that a swarm draws over its cost-to-go.

use super::off_grid::{Search, over_joints};
use super::shortlist::shortlist;
use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::grid::Grid;
use crate::path::JointPath;
use crate::planning::{
    Candidate, Effort, Found, Objective, PathToFollow, Pick, PlanError, Problem, Stage, least_cost,
};
use crate::roadmap::PostureGraph;
use crate::search::{Dstar, Graph, Until};
use crate::swarm::{GuidedSwarmSettings, Terrain, draw_paths};

/// How many paths are followed and how closely; where a proof that there is none is tried.
pub(super) struct Settings {
    /// How many of the drawn paths are made into motions: what a path promises and what its motion costs differ.
    shortlist: usize,
    /// How far a motion may stray from a path over the grid before the verifier is asked, in grid steps: about its zigzag.
    pub(super) tolerance: f64,
    /// How far inside the obstacles walls stand (rad), one after the other, where the grid connects nothing: until there is a path off
    /// the grid, or a proof that there is none.
    distances: [f64; 5],
}

pub(super) const SETTINGS: Settings =
    Settings { shortlist: 8, tolerance: 1.0, distances: [3e-3, 1e-3, 1e-4, 1e-5, 1e-6] };

/// Costs that differ by less than this share are the same: sums of the same steps in another order.
const SAME_COST: f64 = 1e-9;

/// Which paths over the grid are candidates.
#[derive(Debug, Clone, Copy)]
pub(super) enum Choice<'a> {
    /// D*'s own.
    OwnOnly,
    /// Those, and the best that a swarm draws.
    Drawn(&'a GuidedSwarmSettings),
}

/// [`paths_over_grid`]; where there are none, a try to prove that there is no path at all.
///
/// # Errors
/// [`PlanError::NoPath`] where that is proved, [`PlanError::OutsideGrid`], else [`PlanError::NotFound`]; [`PlanError::Stopped`]
pub(super) fn over_grid(
    problem: &Problem<'_>,
    planner: &str,
    choice: Choice<'_>,
) -> Result<Found, PlanError> {
    let not_found = match paths_over_grid(problem, planner, choice) {
        Err(not_found @ PlanError::NotFound { .. }) => not_found,
        other => return other,
    };
    let scene = problem.two_link(planner)?;
    if let Some(outside) = outside_grid(problem, scene.grid()) {
        return Err(outside);
    }
    for distance in SETTINGS.distances {
        least_cost(problem, distance)?;
        // Where there is a path off the grid nothing can be proved against one.
        let search = Search::new(distance, None);
        let (ends, limits) = (&problem.endpoints, &problem.limits);
        match over_joints(scene, ends, Objective::Joint, limits, search, problem.monitor) {
            Ok(_) => break,
            Err(PlanError::NotFoundOverJoints { .. }) => {}
            Err(other) => return Err(other),
        }
    }
    Err(not_found)
}

/// The end of the task that no point of the grid is near, if there is one.
fn outside_grid(problem: &Problem<'_>, grid: &Grid) -> Option<PlanError> {
    let [starts, goals] = problem.endpoints.pairs();
    [("start", starts), ("goal", goals)].into_iter().find_map(|(end, places)| {
        let tips: Vec<Point> = places.iter().map(|q| problem.scene.arm().tip(q)).collect();
        let outside = tips.iter().all(|&tip| grid.corners(tip).next().is_none());
        let tip = *tips.first().filter(|_| outside)?;
        let [x, y] = [[grid.x(0), grid.x(grid.columns() - 1)], [grid.y(0), grid.y(grid.rows() - 1)]];
        Some(PlanError::OutsideGrid { end, tip, x, y })
    })
}

/// D*'s own paths over places and postures, and of those that a swarm draws, if one shall, the ones that promise most.
///
/// # Errors
/// [`PlanError::NotFound`], [`PlanError::Stopped`]
pub(super) fn paths_over_grid(
    problem: &Problem<'_>,
    planner: &str,
    choice: Choice<'_>,
) -> Result<Found, PlanError> {
    let scene = problem.two_link(planner)?;
    let Problem { endpoints: ends, settings, limits, monitor, .. } = problem;
    let not_found = || PlanError::NotFound { step: scene.grid().step() };
    monitor.stage(Stage::FreeSpace);
    let space = FreeSpace::of_until(scene, &|| monitor.keep_going()).ok_or(PlanError::Stopped)?;

    monitor.stage(Stage::CostToGo);
    let mut graph = PostureGraph::new(scene, &space, !ends.keep_posture);
    let [starts, goals] = ends.pairs();
    let goals: Vec<usize> = goals.into_iter().map(|q| graph.insert(q)).collect();
    let starts: Vec<usize> = starts.into_iter().map(|q| graph.insert(q)).collect();
    let mut field = Dstar::new(graph.len());
    for &goal in &goals {
        field.insert_goal(goal, 0.0)?;
    }
    for &start in &starts {
        if !field.settle(&graph, Until::Settled(start), &|| monitor.keep_going()) {
            return Err(PlanError::Stopped);
        }
    }
    let least = starts.iter().map(|&start| field.cost_to_go(start)).fold(f64::INFINITY, f64::min);
    if least.is_infinite() {
        return Err(not_found());
    }

    monitor.stage(Stage::TipPath);
    let slack = settings.objective.slack();
    let worth_it = starts.iter().filter(|&&start| field.cost_to_go(start) <= least * (1.0 + slack));
    let mut own: Vec<(f64, Vec<usize>)> = Vec::new();
    let mut drawn: Vec<(f64, Vec<usize>)> = Vec::new();
    let mut effort = None;
    for &start in worth_it {
        own.push((field.cost_to_go(start), field.path(start).ok_or_else(not_found)?));
        if let Choice::Drawn(swarm) = choice {
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
            effort.get_or_insert_with(Effort::default).evaluations += swarm.candidates;
            drawn.extend(paths.costs.into_iter().zip(paths.paths));
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
    // D*'s own paths stay in the running whatever they promise, so that the swarm's choice is hardly ever worse.
    let mut chosen = joined(own)?;
    chosen.extend(shortlist(scene.scene(), limits, settings.objective, joined(drawn)?, SETTINGS.shortlist));
    let candidate = |(tip_travel, path)| {
        let tip_travel = Some(tip_travel);
        Candidate::certified(PathToFollow { path, tip_travel, tolerance: SETTINGS.tolerance })
    };
    let candidates = chosen.into_iter().map(candidate).collect();
    Ok(Found { candidates, pick: Pick::Best, chosen_from: paths, effort })
}
