use super::branch_grid::{CachedNode, NodeCache};
use super::posture_graph::{LEAST_COST, PostureGraph, SINGULAR_BAND};
use crate::arm::Posture;
use crate::free_space::{FreeSpace, ShortWays, cells_near_moved};
use crate::geometry::Point;
use crate::path::JointPath;
use crate::scene::{Obstacle, TwoLinkScene};
use crate::search::{Dstar, Graph};

/// A [`PostureGraph`] whose obstacles move: what is known of it is handed on from scene to scene, and edges that are
/// blocked now are visited too, as D* asks.
///
/// Its places are the goals; they are no neighbours of each other, for no way leads on from a goal.
pub(crate) struct DynamicGraph<'a> {
    graph: PostureGraph<'a>,
    goals: &'a [Goal],
}

/// A goal configuration, free or not, and the nodes around it.
pub(crate) struct Goal {
    pub(crate) q: [f64; 2],
    tip: Point,
    joined: Vec<Join>,
}

/// An edge from a goal.
struct Join {
    node: usize,
    to: [f64; 2],
    cost: f64,
    is_certified: bool,
}

impl Join {
    fn cost_now(&self) -> f64 {
        if self.is_certified { self.cost } else { f64::INFINITY }
    }
}

impl<'a> DynamicGraph<'a> {
    /// The graph over the map of `scene`; `cache` and `goals` are those of another of the same arm and grid, told by
    /// [`obstacles_moved`](Self::obstacles_moved) of every change since.
    pub(crate) fn new(
        scene: TwoLinkScene<'a>,
        space: &'a FreeSpace,
        may_change_posture: bool,
        (cache, goals): (NodeCache, &'a [Goal]),
    ) -> Self {
        Self { graph: PostureGraph::with(scene, space, may_change_posture, cache), goals }
    }

    /// What is known by now.
    pub(crate) fn into_cache(self) -> NodeCache {
        self.graph.branches.into_cache()
    }

    /// The nodes of the goals.
    pub(crate) fn goal_nodes(&self) -> impl Iterator<Item = usize> + use<> {
        let cells = self.graph.branches.len();
        cells..cells + self.goals.len()
    }

    /// `configurations` as goals of this graph, whose edges are examined now.
    pub(crate) fn goals_at(&self, configurations: &[[f64; 2]]) -> Vec<Goal> {
        let graph = &self.graph;
        let goal = |&q: &[f64; 2]| {
            let tip = graph.scene.arm().tip(&q);
            let around = graph.scene.grid().corners(tip).flat_map(|cell| graph.branches.over(cell));
            let joined = around.filter_map(|node| {
                let to = graph.branches.stand(node)?;
                let cost = graph.cost(tip, graph.tip(node), &q, &to);
                Some(Join { node, to, cost, is_certified: false })
            });
            let mut goal = Goal { q, tip, joined: joined.collect() };
            goal.look_again(graph);
            goal
        };
        configurations.iter().map(goal).collect()
    }

    /// Looks again at the edges of `goals`, which are those of this graph.
    pub(crate) fn look_again_at(&self, goals: &mut [Goal]) {
        goals.iter_mut().for_each(|goal| goal.look_again(&self.graph));
    }

    /// Forgets what may be otherwise since the obstacles were where they were `before`; the nodes it was forgotten of, or
    /// `None` if it was forgotten of all, for there are more than `most`.
    pub(crate) fn forget_near(&self, before: &[Obstacle], most: usize) -> Option<Vec<usize>> {
        let forgotten = self.near_moved(before, most);
        match &forgotten {
            Some(nodes) => nodes.iter().for_each(|&node| self.graph.branches.forget(node)),
            None => self.graph.branches.forget_all(),
        }
        forgotten
    }

    fn near_moved(&self, before: &[Obstacle], most: usize) -> Option<Vec<usize>> {
        let PostureGraph { scene, branches, .. } = &self.graph;
        let step = scene.grid().step();
        // Diagonals, and a hair for rounding.
        let ways = ShortWays { length: 1.4143 * step, band: 1.01 * SINGULAR_BAND * step };
        let mut near = Vec::new();
        for posture in Posture::ALL {
            for cell in cells_near_moved(*scene, before, posture, ways, most.saturating_sub(near.len()))? {
                near.extend(branches.over(cell).filter(|&node| branches.posture(node) == posture));
            }
        }
        Some(near)
    }

    /// Tells `field` of all edges of `nodes` that may make a difference to it, and of those of the goals.
    ///
    /// An edge that no way leads along, and that could not shorten one, is examined when the search asks.
    pub(crate) fn tell(&self, field: &mut Dstar, nodes: &[usize]) {
        for (node, goal) in self.goal_nodes().zip(self.goals) {
            goal.joined.iter().for_each(|join| field.step_changed(node, join.node, join.cost_now()));
        }
        for &node in nodes {
            if let Some(next) = field.next(node)
                && next < self.graph.branches.len()
                && self.edge(node, next).is_none()
            {
                field.step_changed(node, next, f64::INFINITY);
            }
            if self.graph.branches.is_free(node) {
                self.tell_of_shortcuts(field, node);
            }
        }
    }

    /// Tells of edges that would shorten a way if they were certified.
    fn tell_of_shortcuts(&self, field: &mut Dstar, node: usize) {
        let PostureGraph { scene, branches, .. } = &self.graph;
        let (_, cell) = branches.branch_and_cell(node);
        let mut shortcut = |other: usize, least: f64| {
            let (here, there) = (field.cost_to_go(node), field.cost_to_go(other));
            if (here + least < there || there + least < here)
                && field.next(node) != Some(other)
                && field.next(other) != Some(node)
                && branches.is_free(other)
            {
                field.step_changed(node, other, least);
            }
        };
        let crosses = self.crosses(node);
        for (direction, neighbour) in branches.around(cell).into_iter().enumerate() {
            let Some(neighbour) = neighbour else { continue };
            // The other four are those of the neighbours, which the same obstacle is near to.
            if direction < 4 {
                shortcut(node - cell + neighbour, scene.grid().neighbour_distance(direction));
            }
            if crosses {
                let across = branches.over(neighbour).filter(|&other| self.is_across(node, other));
                across.for_each(|other| shortcut(other, scene.grid().neighbour_distance(direction)));
            }
        }
        if crosses {
            let across = branches.over(cell).filter(|&other| self.is_across(node, other));
            across.for_each(|other| shortcut(other, LEAST_COST * scene.grid().step()));
        }
    }

    /// The edges from `q` to nodes around it, those of goals near by among them: those that are certified, with their
    /// costs.
    pub(crate) fn around(&self, q: &[f64; 2]) -> Vec<(usize, f64)> {
        let PostureGraph { scene, branches, .. } = &self.graph;
        let tip = scene.arm().tip(q);
        let mut joined = Vec::new();
        for node in scene.grid().corners(tip).flat_map(|cell| branches.over(cell)) {
            if let Some(to) = branches.configuration(node)
                && self.graph.is_certified(q, &to)
            {
                joined.push((node, self.graph.cost(tip, self.graph.tip(node), q, &to)));
            }
        }
        for (node, goal) in self.goal_nodes().zip(self.goals) {
            if goal.tip.distance(tip) <= 2.0 * scene.grid().step() && self.graph.is_certified(&goal.q, q) {
                joined.push((node, self.graph.cost(goal.tip, tip, &goal.q, q)));
            }
        }
        joined
    }

    /// The configurations from `q` along `nodes`, joined by certified straight joint motions.
    pub(crate) fn joint_path(&self, q: &[f64; 2], nodes: &[usize]) -> Option<JointPath> {
        let mut configurations = vec![*q];
        for &node in nodes {
            configurations.push(match node.checked_sub(self.graph.branches.len()) {
                Some(goal) => self.goals.get(goal)?.q,
                None => self.graph.branches.configuration(node)?,
            });
        }
        self.graph.turns_through(&configurations)
    }

    /// The cost of the edge between two nodes that are neighbours, neither of them a goal's, if it is certified.
    fn edge(&self, node: usize, other: usize) -> Option<f64> {
        let PostureGraph { scene, branches, .. } = &self.graph;
        let (place, from) = branches.look(node)?;
        let ((_, cell), (_, there)) = (branches.branch_and_cell(node), branches.branch_and_cell(other));
        let direction = branches.around(cell).iter().position(|&around| around == Some(there));
        match direction {
            Some(direction) if branches.same_branch(node, other) => self
                .graph
                .branch_edge(node, (place, &from), other, direction)
                .then(|| scene.grid().neighbour_distance(direction)),
            _ => self.graph.across(node, (place, &from), other, direction),
        }
    }

    /// Whether `node` may have edges to other branches at all, whatever the obstacles.
    fn crosses(&self, node: usize) -> bool {
        let PostureGraph { branches, may_change_posture, .. } = &self.graph;
        branches.several_per_posture() || (*may_change_posture && branches.is_near_edge(node))
    }

    /// Whether there may be an edge to `other`, on another branch, from a node near it that crosses.
    fn is_across(&self, node: usize, other: usize) -> bool {
        let PostureGraph { branches, .. } = &self.graph;
        !branches.same_branch(node, other) && (branches.same_posture(node, other) || self.crosses(other))
    }

    fn visit_across(
        &self,
        node: usize,
        look: Option<&(usize, CachedNode)>,
        (cell, direction): (usize, Option<usize>),
        visit: &mut impl FnMut(usize, f64),
    ) {
        for other in self.graph.branches.over(cell).filter(|&other| self.is_across(node, other)) {
            let cost =
                look.and_then(|(place, from)| self.graph.across(node, (*place, from), other, direction));
            visit(other, cost.unwrap_or(f64::INFINITY));
        }
    }
}

impl Goal {
    /// Whether the arm can turn there, or away, from anywhere for now.
    pub(crate) fn is_open(&self) -> bool {
        self.joined.iter().any(|join| join.is_certified)
    }

    fn look_again(&mut self, graph: &PostureGraph) {
        for join in &mut self.joined {
            join.is_certified = graph.branches.is_free(join.node) && graph.is_certified(&self.q, &join.to);
        }
    }
}

impl Graph for DynamicGraph<'_> {
    fn len(&self) -> usize {
        self.graph.branches.len() + self.goals.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        let PostureGraph { scene, branches, .. } = &self.graph;
        if let Some(goal) = node.checked_sub(branches.len()) {
            self.goals[goal].joined.iter().for_each(|join| visit(join.node, join.cost_now()));
            return;
        }
        let look = branches.look(node);
        let (_, cell) = branches.branch_and_cell(node);
        let crosses = match &look {
            Some((_, from)) => branches.several_per_posture() || self.graph.may_change_posture_at(from),
            None => self.crosses(node),
        };
        if crosses {
            self.visit_across(node, look.as_ref(), (cell, None), &mut visit);
        }
        for (direction, neighbour) in branches.around(cell).into_iter().enumerate() {
            let Some(neighbour) = neighbour else { continue };
            let other = node - cell + neighbour;
            let is_certified = look
                .as_ref()
                .is_some_and(|(place, from)| self.graph.branch_edge(node, (*place, from), other, direction));
            visit(
                other,
                if is_certified { scene.grid().neighbour_distance(direction) } else { f64::INFINITY },
            );
            if crosses {
                self.visit_across(node, look.as_ref(), (neighbour, Some(direction)), &mut visit);
            }
        }
        for (goal_node, goal) in self.goal_nodes().zip(self.goals) {
            let joined = goal.joined.iter().filter(|join| join.node == node);
            joined.for_each(|join| visit(goal_node, join.cost_now()));
        }
    }

    fn usual_step(&self) -> Option<f64> {
        Some(self.graph.scene.grid().step())
    }
}
