//! Certified paths that are worth being made into motions: those of the grid, by D* and the swarm, and those that leave it.

use super::choose::shortlist;
use super::endpoints::Endpoints;
use super::optimal::{Search, over_joints, over_tips};
use super::posture_graph::PostureGraph;
use super::settings::{Objective, PlanSettings};
use super::{Effort, Monitor, PlanError, Stage};
use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::path::JointPath;
use crate::scene::TwoLinkScene;
use crate::search::{Dstar, Graph, Progress, Until};
use crate::swarm::{GuidedSwarmSettings, Terrain, draw_paths};
use crate::trajectory::SpeedLimits;

/// Expansions of D* between two looks at the monitor: a few milliseconds.
const EXPANSIONS_PER_LOOK: usize = 1_000;

/// By how much a tip path may be longer than the shortest and still be chosen for what the arm pays, as a share.
pub const NEARLY_EQUAL: f64 = 0.01;

/// How many of the drawn paths are made into motions: what a path promises and what its motion costs differ.
const SHORTLIST: usize = 8;

/// How far a motion may stray from a path over the grid before the verifier is asked, in grid steps: about its zigzag.
pub(crate) const GRID_TOLERANCE: f64 = 1.0;

/// The same for a taut path, which has no zigzag to lose.
const TAUT_TOLERANCE: f64 = 0.1;

/// Costs that differ by less than this share are the same: sums of the same steps in another order.
pub(crate) const SAME_COST: f64 = 1e-9;

/// Certified paths, how many they were chosen from, and what a search by evaluations took.
pub(crate) struct Found {
    pub(crate) candidates: Vec<Candidate>,
    pub(crate) paths: usize,
    pub(crate) effort: Option<Effort>,
}

/// A certified path to make a motion of.
#[derive(Clone)]
pub(crate) struct Candidate {
    pub(crate) path: JointPath,
    /// Its tip travel (m).
    pub(crate) tip_travel: f64,
    /// How far the motion may stray from it before the verifier is asked, in grid steps.
    pub(crate) tolerance: f64,
}

/// D*'s own paths over places and postures, and of those that a swarm draws, if one shall, the ones that promise most.
pub(crate) fn over_grid(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    swarm: Option<&GuidedSwarmSettings>,
    settings: &PlanSettings,
    limits: &[SpeedLimits],
    monitor: &impl Monitor,
) -> Result<Found, PlanError> {
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
    let mut effort = None;
    for &start in worth_it {
        own.push((field.cost_to_go(start), field.path(start).ok_or_else(not_found)?));
        if let Some(swarm) = swarm {
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
    // D*'s own paths stay in the running whatever they promise, so that the swarm's choice is never worse.
    let mut chosen = joined(own)?;
    chosen.extend(shortlist(scene.scene(), limits, settings.objective, joined(drawn)?, SHORTLIST));
    let candidate = |(tip_travel, path)| Candidate { path, tip_travel, tolerance: GRID_TOLERANCE };
    Ok(Found { candidates: chosen.into_iter().map(candidate).collect(), paths, effort })
}

/// Paths that leave the grid: over the joints or, for tip travel, over the tip; for time what D* finds as well, which
/// may have fewer corners to slow down at.
pub(crate) fn off_grid(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    objective: Objective,
    limits: &[SpeedLimits],
    search: Search,
    monitor: &impl Monitor,
) -> Result<Found, PlanError> {
    let on_grid = || {
        let settings = PlanSettings { objective, ..PlanSettings::default() };
        match over_grid(scene, ends, None, &settings, limits, monitor) {
            Ok(found) => Ok(found.candidates),
            Err(PlanError::NotFound { .. }) => Ok(Vec::new()),
            Err(other) => Err(other),
        }
    };
    let over_joints = || -> Result<Vec<Candidate>, PlanError> {
        let paths = over_joints(scene, ends, objective, limits, search, monitor)?;
        Ok(paths.into_iter().map(|path| candidate(scene, path)).collect())
    };
    let candidates = match objective {
        Objective::Joint => over_joints()?,
        Objective::Time => {
            let mut candidates = on_grid()?;
            match over_joints() {
                // Corners cost time: they are kept to closely, and loosely.
                Ok(more) => candidates.extend(more.into_iter().flat_map(|candidate| {
                    [Candidate { tolerance: GRID_TOLERANCE, ..candidate.clone() }, candidate]
                })),
                Err(PlanError::NotFoundOverJoints { .. }) if !candidates.is_empty() => {}
                Err(other) => return Err(other),
            }
            candidates
        }
        Objective::Tip => {
            let mut rough = on_grid()?;
            if rough.is_empty() {
                rough = over_joints()?;
            }
            let mut candidates = Vec::new();
            for Candidate { path, .. } in &rough {
                let paths = over_tips(scene, path, monitor)?;
                candidates.extend(paths.into_iter().map(|path| candidate(scene, path)));
            }
            candidates
        }
    };
    let paths = candidates.len();
    Ok(Found { candidates, paths, effort: None })
}

fn candidate(scene: TwoLinkScene<'_>, path: JointPath) -> Candidate {
    Candidate { tip_travel: path.tip_travel(scene.scene().arm()), path, tolerance: TAUT_TOLERANCE }
}
