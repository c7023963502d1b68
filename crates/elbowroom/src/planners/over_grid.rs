//! Certified paths over the grid that are worth being made into motions: D*'s, those by way of plateaus of its cost-to-go, which pass
//! obstacles on other sides or end otherwise, and those that a swarm draws over it.

use super::off_grid::{Search, over_joints};
use super::shortlist::shortlist;
use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::grid::Grid;
use crate::path::JointPath;
use crate::planning::{
    Candidate, Effort, Found, Monitor, Objective, PathToFollow, Pick, PlanError, Problem, Stage, least_cost,
};
use crate::roadmap::PostureGraph;
use crate::search::{Dstar, Graph, PlateauSettings, Until, plateaus};
use crate::swarm::{GuidedSwarmSettings, Terrain, draw_paths};

/// How many paths are followed and how closely; where a proof that there is none is tried.
pub(super) struct Settings {
    /// How many paths, no two of which can be pulled over to each other, are made into motions: what a path promises and what its motion
    /// costs differ.
    shortlist: usize,
    /// Paths lead by way of so many pieces of plateaus, and what is one.
    pieces: usize,
    /// By way of how many places of each.
    vias: usize,
    /// By how much paths that the swarm draws may cost more than the least, as a share.
    keep_within: f64,
    plateaus: PlateauSettings,
    /// How far a motion may stray from a path over the grid before the verifier is asked, in grid steps: about its zigzag.
    pub(super) tolerance: f64,
    /// How far inside the obstacles walls stand (rad), one after the other, where the grid connects nothing: until there is a path off
    /// the grid, or a proof that there is none.
    distances: [f64; 5],
}

pub(super) const SETTINGS: Settings = Settings {
    shortlist: 6,
    pieces: 8,
    vias: 6,
    keep_within: 0.01,
    plateaus: PlateauSettings { within: 1.0, stretch: 0.05, drop: 0.05 },
    tolerance: 1.0,
    distances: [3e-3, 1e-3, 1e-4, 1e-5, 1e-6],
};

/// Which paths over the grid are candidates.
#[derive(Debug, Clone, Copy)]
pub(super) enum Choice<'a> {
    /// D*'s own.
    OwnOnly,
    /// That, those by way of plateaus, and the best that a swarm draws.
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

/// D*'s own path over places and postures, with steps that cost what is asked for. If a swarm shall draw, also paths that cannot be pulled
/// over to it or each other, by way of plateaus; and where there are few, paths that the swarm draws over the cost-to-go.
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
    let step_cost = settings.objective.step_cost(limits);
    let mut graph = PostureGraph::new(scene, &space, !ends.keep_posture, step_cost);
    let [starts, goals] = ends.pairs();
    let goals: Vec<usize> = goals.into_iter().map(|q| graph.insert(q)).collect();
    let starts: Vec<usize> = starts.into_iter().map(|q| graph.insert(q)).collect();
    let to_goal = field(&graph, &goals, &starts, *monitor)?;
    let cheapest =
        starts.iter().copied().min_by(|&a, &b| to_goal.cost_to_go(a).total_cmp(&to_goal.cost_to_go(b)));
    let start = cheapest.filter(|&start| to_goal.cost_to_go(start).is_finite()).ok_or_else(not_found)?;
    let joined = |nodes: &[usize]| graph.joint_path(nodes).ok_or_else(not_found);
    let own = joined(&to_goal.path(start).ok_or_else(not_found)?)?;
    // What D* counts is tip travel where that is asked for.
    let own_travel = (settings.objective == Objective::Tip).then(|| to_goal.cost_to_go(start));
    let Choice::Drawn(swarm) = choice else {
        return Ok(Found::new(vec![followed(own, own_travel)], Pick::Best));
    };

    monitor.stage(Stage::TipPath);
    let from_start = field(&graph, &starts, &goals, *monitor)?;
    let keep_going = || monitor.keep_going();
    let others = alternatives(&graph, &from_start, &to_goal, to_goal.cost_to_go(start), &keep_going)
        .ok_or(PlanError::Stopped)?;
    let terrain = Terrain {
        graph: &graph,
        cost_to_go: &|node| to_goal.cost_to_go(node),
        distance: &|node| {
            let straight = goals.iter().filter_map(|&goal| graph.cost_at_least(node, goal));
            straight.fold(f64::INFINITY, f64::min)
        },
        is_goal: &|node| goals.contains(&node),
    };
    let swarm = GuidedSwarmSettings { keep_within: swarm.keep_within.max(SETTINGS.keep_within), ..*swarm };
    let drawn = draw_paths(&terrain, start, &swarm, settings.seed, &|| monitor.keep_going());
    let drawn = drawn.ok_or(PlanError::Stopped)?;

    monitor.stage(Stage::JointPath);
    let paths = 1 + others.len() + drawn.paths.len();
    let in_order = |mut paths: Vec<(f64, Vec<usize>)>, most: usize| {
        paths.sort_by(|a, b| a.0.total_cmp(&b.0));
        paths.iter().take(most).map(|(_, nodes)| joined(nodes)).collect::<Result<Vec<_>, _>>()
    };
    let others = in_order(others, usize::MAX)?;
    let evaluations = drawn.candidates;
    let drawn = in_order(drawn.costs.into_iter().zip(drawn.paths).collect(), SETTINGS.shortlist)?;
    // D*'s own path stays in the running whatever it promises, so that the choice is hardly ever worse.
    let chosen = shortlist(scene.scene(), own, others, drawn, SETTINGS.shortlist, &keep_going)
        .ok_or(PlanError::Stopped)?;
    let travels = std::iter::once(own_travel).chain(std::iter::repeat(None));
    let candidates = chosen.into_iter().zip(travels).map(|(path, travel)| followed(path, travel)).collect();
    let effort = Some(Effort { evaluations, ..Effort::default() });
    Ok(Found { candidates, pick: Pick::Best, chosen_from: paths, effort })
}

/// Paths from a start to a goal by way of plateaus of the cost-to-go, with what they cost; `None` where
/// `keep_going` said no.
fn alternatives(
    graph: &PostureGraph<'_>,
    from_start: &Dstar,
    to_goal: &Dstar,
    least: f64,
    keep_going: &dyn Fn() -> bool,
) -> Option<Vec<(f64, Vec<usize>)>> {
    let pieces = plateaus(graph, from_start, to_goal, least, &SETTINGS.plateaus, keep_going)?;
    let vias = pieces.iter().take(SETTINGS.pieces).flat_map(|piece| {
        let vias = SETTINGS.vias.min(piece.len());
        (0..vias).map(move |i| piece[i * piece.len() / vias])
    });
    let by = |via: usize| {
        let mut nodes = from_start.path(via)?;
        nodes.reverse();
        nodes.extend(to_goal.path(via)?.into_iter().skip(1));
        Some((from_start.cost_to_go(via) + to_goal.cost_to_go(via), nodes))
    };
    Some(vias.filter_map(by).collect())
}

/// The cost-to-go to the nearest of `goals`, as far as from the nearest of `starts`.
///
/// # Errors
/// [`PlanError::Stopped`]
fn field(
    graph: &PostureGraph<'_>,
    goals: &[usize],
    starts: &[usize],
    monitor: &dyn Monitor,
) -> Result<Dstar, PlanError> {
    let mut field = Dstar::new(graph.len());
    for &goal in goals {
        field.insert_goal(goal, 0.0)?;
    }
    for &start in starts {
        if !field.settle(graph, Until::Settled(start), &|| monitor.keep_going()) {
            return Err(PlanError::Stopped);
        }
    }
    Ok(field)
}

fn followed(path: JointPath, tip_travel: Option<f64>) -> Candidate {
    Candidate::certified(PathToFollow { path, tip_travel, tolerance: SETTINGS.tolerance })
}
