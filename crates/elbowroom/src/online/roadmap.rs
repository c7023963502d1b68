use thiserror::Error;

use super::placed::{AWAY, still};
use crate::free_space::{ChangedCells, FreeSpace};
use crate::geometry::Shape;
use crate::path::{JointPath, straight_move_is_free};
use crate::planners::DstarPlanner;
use crate::planning::{Endpoints, PlanError, Planner, Unwatched};
use crate::roadmap::{DynamicGraph, Goal, NodeCache};
use crate::scene::{Obstacle, Scene, SceneProblem, Task};
use crate::search::{Dstar, Graph, Progress, Until};

/// Expansions of D* between two samples at how far the search has to go.
const EXPANSIONS_PER_LOOK: usize = 64;

/// Beyond this number of nodes near something that moved, as a share of those ever examined, a new field costs less than
/// the old one repaired: measured on grids of 101 x 101 points.
const WORTH_REPAIRING: f64 = 0.8;

/// The ways to one task's goals over places and postures, kept up to date while obstacles move: the map of each posture,
/// what is known of the free configurations and the certified joint motions between them, and D*'s cost-to-go.
///
/// Where obstacles move, the maps are filled again only where something came or went, only what is near there is
/// forgotten, and the cost-to-go is repaired, unless most of what it holds may be otherwise. Memory grows with
/// the part of the grid that was ever searched, not with the number of updates: see [`Kept`].
///
/// The arm itself may be anywhere: [`path_from`](Self::path_from) joins it to the nodes around.
pub struct Roadmap {
    scene: Scene,
    space: FreeSpace,
    cache: NodeCache,
    goals: Vec<Goal>,
    may_change_posture: bool,
    /// Whether some goal can be left, or entered, at all.
    is_goal_open: bool,
    field: Dstar,
    upkeep: Upkeep,
}

/// What becomes of the cost-to-go when obstacles move; the answers are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Upkeep {
    /// What costs less, going by measurements.
    #[default]
    Cheaper,
    /// It is repaired.
    Repair,
    /// It is begun anew.
    Anew,
}

/// What an update of the obstacles changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Updated {
    /// Cells that are in another state now, of both postures together.
    pub cells: usize,
    /// Nodes of the graph near which something moved, where the cost-to-go was repaired; `None` where it was begun anew.
    pub repaired: Option<usize>,
}

/// What a roadmap keeps, in entries: it grows with the part of the grid that was ever searched, and is bounded by the grid, however
/// long obstacles move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Kept {
    /// Nodes of the graph: places in each posture, and goals. Maps, costs-to-go and numbers have up to 24 bytes for each.
    pub nodes: usize,
    /// Nodes for which there is room in what is known of configurations and edges, 48 bytes each: no more than `nodes`.
    pub known: usize,
    /// Nodes for which there is room on D*'s open list, 16 bytes each: no more than `nodes`.
    pub open: usize,
    /// Entries in the buckets of a field that is begun anew, 4 bytes each, while that goes on: a few for each node on the front.
    pub in_buckets: usize,
}

/// A way to the goal.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// From the configuration asked about to the goal, by certified straight joint motions.
    pub path: JointPath,
    /// Its tip travel over the grid (m).
    pub cost: f64,
}

/// Why there is no way to the goal for now.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoRoute {
    /// No free point of the grid can be reached by a straight joint motion from where the arm is.
    #[error("no free grid point can be reached by a straight joint motion from where the arm is")]
    Start,
    /// Every goal is blocked.
    #[error("every goal is blocked for now")]
    Goal,
    /// The search found no way over this grid.
    #[error("the grid has no path to a goal for now")]
    NotFound,
    /// The caller said no.
    #[error("stopped by the caller")]
    Stopped,
}

impl Roadmap {
    /// The ways to the goals of `task`, one of `scene` or any other; goals that are blocked may come free later.
    ///
    /// # Errors
    /// [`PlanError::Start`] and [`PlanError::Goal`] where the arm could not stand if there were no obstacles,
    /// [`PlanError::GoalPosture`]; [`PlanError::OtherArm`] for more links than two, [`PlanError::Moving`] for an obstacle
    /// that moves by itself.
    pub fn new(scene: Scene, task: &Task) -> Result<Self, PlanError> {
        let two_link =
            scene.two_link().map_err(|error| PlanError::not_two_link(DstarPlanner.name(), error))?;
        let ends = Endpoints::new(&still(&scene, |_, _| Some(AWAY)), task, 0, &Unwatched)?;
        let ([_, goals], may_change_posture) = (ends.pairs(), !ends.keep_posture);
        let space = FreeSpace::of(two_link);
        let graph = DynamicGraph::new(two_link, &space, may_change_posture, (NodeCache::default(), &[]));
        let goals = graph.goals_at(&goals);
        let cache = graph.into_cache();
        let graph = DynamicGraph::new(two_link, &space, may_change_posture, (cache, &goals));
        let mut field = Dstar::new(graph.len());
        for goal in graph.goal_nodes() {
            field.insert_goal(goal, 0.0)?;
        }
        let cache = graph.into_cache();
        let is_goal_open = goals.iter().any(Goal::is_open);
        Ok(Self {
            scene,
            space,
            cache,
            goals,
            may_change_posture,
            is_goal_open,
            field,
            upkeep: Upkeep::default(),
        })
    }

    /// The same, with another upkeep.
    #[must_use]
    pub fn with_upkeep(self, upkeep: Upkeep) -> Self {
        Self { upkeep, ..self }
    }

    /// The scene, with its obstacles as they are now.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The maps as they are now.
    pub fn space(&self) -> &FreeSpace {
        &self.space
    }

    /// The goal configurations (rad), blocked or not.
    pub fn goals(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.goals.iter().map(|goal| &goal.q)
    }

    /// Tells where all obstacles are now; a motion of theirs does not count.
    ///
    /// They are told apart by their number: better to leave one that may come back in the list, far away, than to take
    /// it out.
    ///
    /// # Errors
    /// [`SceneProblem`] where no scene has such obstacles; all is as it was then.
    pub fn move_obstacles(&mut self, obstacles: Vec<Obstacle>) -> Result<Updated, SceneProblem> {
        let obstacles = obstacles.into_iter().map(|obstacle| Obstacle { motion: None, ..obstacle }).collect();
        let scene = self.scene.with_obstacles(obstacles)?;
        let before = std::mem::replace(&mut self.scene, scene);
        Ok(self.obstacles_moved(before.obstacles()))
    }

    /// The same for the obstacles that are there, put elsewhere as static ones.
    pub(super) fn place_obstacles(&mut self, mut obstacles: Vec<Obstacle>) -> Updated {
        let places = self.scene.obstacles_mut().iter_mut().zip(&mut obstacles);
        places.for_each(|(before, now)| std::mem::swap(before, now));
        self.obstacles_moved(&obstacles)
    }

    fn obstacles_moved(&mut self, before: &[Obstacle]) -> Updated {
        if shapes(before).eq(shapes(self.scene.obstacles())) {
            return Updated { cells: 0, repaired: Some(0) };
        }
        let changed = match self.scene.two_link() {
            Ok(scene) => self.space.refill(before, scene),
            Err(_) => ChangedCells::default(),
        };
        let most = match self.upkeep {
            Upkeep::Cheaper => (WORTH_REPAIRING * self.cache.count() as f64) as usize,
            Upkeep::Repair => usize::MAX,
            Upkeep::Anew => 0,
        };
        let nodes = self.with_graph(|graph, _| graph.forget_near(before, most)).flatten();
        let was_open = self.is_goal_open;
        self.look_at_goals();
        // Without a goal there is nothing to repair: every way would be raised, one by one.
        let may_repair = self.upkeep == Upkeep::Repair || was_open == self.is_goal_open;
        let repaired = nodes.filter(|_| may_repair);
        match &repaired {
            Some(nodes) => {
                self.with_graph(|graph, field| graph.tell(field, nodes));
            }
            None => self.field.begin_again(),
        }
        Updated { cells: changed.iter().map(Vec::len).sum(), repaired: repaired.map(|nodes| nodes.len()) }
    }

    /// The best way to a goal from `q`, which need not be over a grid point.
    ///
    /// # Errors
    /// [`NoRoute`]
    pub fn path_from(&mut self, q: &[f64; 2]) -> Result<Route, NoRoute> {
        self.path_from_until(q, &|| true)
    }

    /// [`path_from`](Self::path_from), unless `keep_going`, asked every few dozen expansions, says no: the next call goes
    /// on from there.
    ///
    /// # Errors
    /// [`NoRoute`]
    pub fn path_from_until(&mut self, q: &[f64; 2], keep_going: &dyn Fn() -> bool) -> Result<Route, NoRoute> {
        if self.goals().any(|goal| goal == q) && straight_move_is_free(&self.scene, q, q) {
            return Ok(Route { path: JointPath(vec![(*q).into()]), cost: 0.0 });
        }
        if !self.is_goal_open {
            return Err(NoRoute::Goal);
        }
        self.with_graph(|graph, field| {
            let around = graph.around(q);
            if around.is_empty() {
                return Err(NoRoute::Start);
            }
            let best = |field: &Dstar| {
                let costs = around.iter().map(|&(node, cost)| (field.cost_to_go(node) + cost, node));
                costs.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0))
            };
            let (cost, first) = loop {
                let found = best(field);
                // What lies farther than the best way so far cannot better it.
                let progress = field.expand(graph, Until::Within(found.0), EXPANSIONS_PER_LOOK);
                if progress == Progress::Done && best(field) == found {
                    break found;
                }
                if !keep_going() {
                    return Err(NoRoute::Stopped);
                }
            };
            let nodes = if cost < f64::INFINITY { field.path(first) } else { None };
            let path = nodes.and_then(|nodes| graph.joint_path(q, &nodes));
            path.map(|path| Route { path, cost }).ok_or(NoRoute::NotFound)
        })
        .unwrap_or(Err(NoRoute::NotFound))
    }

    /// The cost-to-go (m) over every cell, one branch after the other, elbow-up first, and of the goals after that;
    /// settled everywhere. A posture has one branch, or one for each turn that a joint with limits can be at.
    pub fn whole_field(&mut self) -> Vec<f64> {
        self.with_graph(|graph, field| {
            field.expand(graph, Until::WholeField, usize::MAX);
            field.field()
        })
        .unwrap_or_default()
    }

    /// How many nodes D* expanded since the field was begun.
    pub fn expansions(&self) -> usize {
        self.field.expansions()
    }

    /// What is kept now.
    pub fn kept(&self) -> Kept {
        let [open, in_buckets] = self.field.waiting();
        Kept { nodes: self.field.len(), known: self.cache.room(), open, in_buckets }
    }

    fn look_at_goals(&mut self) {
        let mut goals = std::mem::take(&mut self.goals);
        self.with_graph(|graph, _| graph.look_again_at(&mut goals));
        self.is_goal_open = goals.iter().any(Goal::is_open);
        self.goals = goals;
    }

    /// Does `work` with the graph of the scene as it is now, which has closed forms: [`new`](Self::new) has examined the arm,
    /// and no obstacle is let in with a motion.
    fn with_graph<T>(&mut self, work: impl FnOnce(&DynamicGraph, &mut Dstar) -> T) -> Option<T> {
        let scene = self.scene.two_link().ok()?;
        let cache = std::mem::take(&mut self.cache);
        let graph = DynamicGraph::new(scene, &self.space, self.may_change_posture, (cache, &self.goals));
        let found = work(&graph, &mut self.field);
        self.cache = graph.into_cache();
        Some(found)
    }
}

fn shapes(obstacles: &[Obstacle]) -> impl Iterator<Item = &Shape> {
    obstacles.iter().map(|obstacle| &obstacle.shape)
}
