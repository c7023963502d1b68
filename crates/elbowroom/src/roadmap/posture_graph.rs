use super::branch_grid::{BranchGrid, CachedNode, Edge, NodeCache, direct};
use super::step_cost::StepCost;
use crate::arm::{Posture, joint_distance, lerp_pair};
use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::path::joint_path;
use crate::path::{JointPath, motion_bounds_of_two, straight_move_clears, straight_move_is_free};
use crate::scene::TwoLinkScene;
use crate::search::Graph;

/// How near to full stretch or fold a posture may be changed, in grid steps of tip travel: wide enough
/// that every direction has a grid point there.
pub(super) const SINGULAR_BAND: f64 = 2.0;

/// Least cost of an edge, as a share of the grid step in metres: the search needs costs that do not vanish in a sum.
pub(super) const LEAST_COST: f64 = 1e-9;

/// A turn of at least this much (rad) that is not free is tried again in halves: near full stretch and fold a
/// small step of the tip swings the elbow wide.
const WIDE_TURN: f64 = 0.05;

/// How often a turn is halved.
const MOST_HALVINGS: u32 = 3;

/// Where the arm can be, and from where it can turn straight to where: nodes are free configurations over
/// grid points, in both postures, and the exact start and goal configurations; edges are certified sweeps.
///
/// Along a branch a node has its eight neighbours. Near full stretch and fold it also has those of the other
/// branches: the straight joint motion passes through the line of links there, which is where a posture can change.
/// Edges are certified when first asked for, and the answer is kept.
pub(crate) struct PostureGraph<'a> {
    pub(super) scene: TwoLinkScene<'a>,
    pub(super) branches: BranchGrid<'a>,
    pub(super) may_change_posture: bool,
    step_cost: StepCost,
    places: Vec<PlaceNode>,
}

/// A configuration that is not over a grid point: a start or a goal.
struct PlaceNode {
    q: [f64; 2],
    tip: Point,
    joined: Vec<(usize, f64)>,
}

impl<'a> PostureGraph<'a> {
    /// The graph over the map of `scene`; the posture never changes unless `may_change_posture`.
    pub(crate) fn new(
        scene: TwoLinkScene<'a>,
        space: &'a FreeSpace,
        may_change_posture: bool,
        step_cost: StepCost,
    ) -> Self {
        Self { step_cost, ..Self::with(scene, space, may_change_posture, NodeCache::default()) }
    }

    /// That of tip travel, with what is known already.
    pub(super) fn with(
        scene: TwoLinkScene<'a>,
        space: &'a FreeSpace,
        may_change_posture: bool,
        cache: NodeCache,
    ) -> Self {
        let branches = BranchGrid::new(scene, space, SINGULAR_BAND * scene.grid().step(), cache);
        Self { scene, branches, may_change_posture, step_cost: StepCost::Tip, places: Vec::new() }
    }

    /// A node for `q`, a free configuration, joined to the nodes over the corners of the grid's square
    /// around its tip and to the places already there, as far as the straight joint motions are certified.
    pub(crate) fn insert(&mut self, q: [f64; 2]) -> usize {
        let node = self.len();
        let tip = self.scene.arm().tip(&q);
        let mut joined = Vec::new();
        for cell in self.scene.grid().corners(tip) {
            for other in self.branches.over(cell) {
                if let Some(to) = self.branches.configuration(other)
                    && self.is_certified(&q, &to)
                {
                    joined.push((other, self.cost(tip, self.scene.grid().point(cell), &q, &to)));
                }
            }
        }
        let reach = 2.0 * self.scene.grid().step();
        let cells = self.branches.len();
        for i in 0..self.places.len() {
            let place = &self.places[i];
            if place.tip.distance(tip) <= reach && self.is_certified(&place.q, &q) {
                let cost = self.cost(place.tip, tip, &place.q, &q);
                joined.push((cells + i, cost));
                self.places[i].joined.push((node, cost));
            }
        }
        self.places.push(PlaceNode { q, tip, joined });
        node
    }

    /// The configuration at `node`, which must be free.
    pub(crate) fn configuration(&self, node: usize) -> Option<[f64; 2]> {
        match node.checked_sub(self.branches.len()) {
            None => self.branches.configuration(node),
            Some(i) => Some(self.places[i].q),
        }
    }

    /// Where the tip is at `node`.
    pub(crate) fn tip(&self, node: usize) -> Point {
        match node.checked_sub(self.branches.len()) {
            None => self.scene.grid().point(self.branches.branch_and_cell(node).1),
            Some(i) => self.places[i].tip,
        }
    }

    /// The configurations along `nodes`, joined by certified straight joint motions, the turns of continuous joints
    /// counted; `None` when two nodes are no neighbours.
    pub(crate) fn joint_path(&self, nodes: &[usize]) -> Option<JointPath> {
        let places = nodes.iter().map(|&node| self.configuration(node)).collect::<Option<Vec<_>>>()?;
        self.turns_through(&places)
    }

    /// The same for configurations that have certified joint motions from each to the next.
    pub(super) fn turns_through(&self, configurations: &[[f64; 2]]) -> Option<JointPath> {
        let mut places: Vec<[f64; 2]> = Vec::with_capacity(configurations.len());
        for &to in configurations {
            if let Some(from) = places.last().copied() {
                let mut between = Vec::new();
                // Rounding may refuse in this direction what was certified in the other; the verifier decides.
                if !self.connect(&from, &to, MOST_HALVINGS, &mut between) {
                    between.clear();
                }
                // Turns are counted from place to place: what lies between was certified so.
                let mut last = from;
                for next in between.iter().chain([&to]) {
                    last = direct(self.scene.arm(), &last, next)?;
                    places.push(last);
                }
            } else {
                places.push(to);
            }
        }
        Some(joint_path(&places))
    }

    pub(super) fn is_certified(&self, from: &[f64; 2], to: &[f64; 2]) -> bool {
        self.may_turn(from, to) && self.connect(from, to, MOST_HALVINGS, &mut Vec::new())
    }

    /// Whether the posture is kept, or may be changed.
    fn may_turn(&self, from: &[f64; 2], to: &[f64; 2]) -> bool {
        let changes = matches!((Posture::of(from), Posture::of(to)), (Some(a), Some(b)) if a != b);
        self.may_change_posture || !changes
    }

    /// Whether the arm can turn from `from` to `to`: straight or, where that would swing wide, by way of
    /// configurations `between` that put the tip on the straight line.
    fn connect(&self, from: &[f64; 2], to: &[f64; 2], halvings: u32, between: &mut Vec<[f64; 2]>) -> bool {
        let arm = self.scene.arm();
        let Some(to) = direct(arm, from, to) else { return false };
        straight_move_is_free(self.scene.scene(), from, &to)
            || self.connect_bent(from, &to, halvings, between)
    }

    /// [`connect`](Self::connect), where the straight joint motion to `to` is not free.
    fn connect_bent(
        &self,
        from: &[f64; 2],
        to: &[f64; 2],
        halvings: u32,
        between: &mut Vec<[f64; 2]>,
    ) -> bool {
        let arm = self.scene.arm();
        let posture = match (Posture::of(from), Posture::of(to)) {
            (Some(a), Some(b)) if a != b => return false,
            (Some(posture), _) | (None, Some(posture)) => posture,
            (None, None) => return false,
        };
        if halvings == 0 || joint_distance(from, to) < WIDE_TURN {
            return false;
        }
        let (a, b) = (arm.tip(from), arm.tip(to));
        let middle = a + (b - a) * 0.5;
        let on_line = arm.inverse(middle, posture).unwrap_or_default();
        let halfway = lerp_pair(from, to, 0.5);
        let nearest = on_line
            .iter()
            .filter_map(|q| direct(arm, from, q))
            .min_by(|p, q| joint_distance(p, &halfway).total_cmp(&joint_distance(q, &halfway)));
        let Some(middle) = nearest else { return false };
        if !self.connect(from, &middle, halvings - 1, between) {
            return false;
        }
        between.push(middle);
        self.connect(&middle, to, halvings - 1, between)
    }

    /// What an edge between two configurations costs, with the tip where it is there. More than 0, as the search asks.
    pub(super) fn cost(&self, a: Point, b: Point, qa: &[f64; 2], qb: &[f64; 2]) -> f64 {
        let cost = self.step_cost.between(self.scene.arm(), (a, qa), (b, qb));
        cost.max(LEAST_COST * self.scene.grid().step())
    }

    /// What any path between two nodes costs at least, whatever is in the way; none where one of them is not free.
    pub(crate) fn cost_at_least(&self, a: usize, b: usize) -> Option<f64> {
        let (qa, qb) = (self.configuration(a)?, self.configuration(b)?);
        Some(self.step_cost.at_least(self.scene.arm(), (self.tip(a), &qa), (self.tip(b), &qb)))
    }

    /// What the edge from `node` to its neighbour `other` on the branch costs.
    fn branch_cost(&self, (node, from): (usize, &CachedNode), other: usize, direction: usize) -> f64 {
        if self.step_cost == StepCost::Tip {
            return self.scene.grid().neighbour_distance(direction);
        }
        let Some((_, to)) = self.branches.look(other) else { return f64::INFINITY };
        let (a, b) = if node < other { (from.q, to.q) } else { (to.q, from.q) };
        self.cost(self.tip(node.min(other)), self.tip(node.max(other)), &a, &b)
    }

    /// Whether the edge from `node`, kept at `place`, to its neighbour `other` on the branch is certified.
    pub(super) fn branch_edge(
        &self,
        node: usize,
        (place, from): (usize, &CachedNode),
        other: usize,
        direction: usize,
    ) -> bool {
        let edge = Edge::along(direction);
        from.is_certified(edge).unwrap_or_else(|| {
            let Some((there, to)) = self.branches.look(other) else { return false };
            // One order for both ways, so that rounding cannot make it matter who asks first.
            let (a, b) = if node < other { (from, &to) } else { (&to, from) };
            let certified = self.is_edge(a, b);
            self.branches.keep_edge(place, edge, there, certified);
            certified
        })
    }

    /// Whether the arm can turn between two nodes: what [`is_certified`](Self::is_certified) says, with what is known of
    /// the clearances at both ends.
    fn is_edge(&self, from: &CachedNode, to: &CachedNode) -> bool {
        let arm = self.scene.arm();
        let Some(end) = direct(arm, &from.q, &to.q) else { return false };
        let bounds = motion_bounds_of_two(arm.lengths(), &from.q, &end);
        if from.nearest.are_enough_with(&to.nearest, bounds) {
            return true;
        }
        let Some(mut suspects) = from.nearest.suspects(&to.nearest, bounds) else {
            return self.is_certified(&from.q, &to.q);
        };
        if !self.may_turn(&from.q, &to.q) {
            return false;
        }
        let (arm, obstacles) = (self.scene.scene().arm(), self.scene.obstacles());
        suspects.all(|index| straight_move_clears(arm, &obstacles[index], &from.q, &end))
            || self.connect_bent(&from.q, &end, MOST_HALVINGS, &mut Vec::new())
    }

    /// Edges from `node` to other branches, over its own cell or the neighbour in `direction`.
    fn visit_across(
        &self,
        node: usize,
        from: (usize, &CachedNode),
        (cell, direction): (usize, Option<usize>),
        visit: &mut impl FnMut(usize, f64),
    ) {
        for other in self.branches.over(cell) {
            if let Some(cost) = self.across(node, from, other, direction) {
                visit(other, cost);
            }
        }
    }

    /// The cost of the edge from `node` to `other` on another branch, if there is one and it is certified: to another turn
    /// of the same posture anywhere, to the other posture near full stretch and fold.
    pub(super) fn across(
        &self,
        node: usize,
        (place, from): (usize, &CachedNode),
        other: usize,
        direction: Option<usize>,
    ) -> Option<f64> {
        if self.branches.same_branch(node, other) {
            return None;
        }
        let (there, to) = self.branches.look(other)?;
        let may_change_posture = self.may_change_posture_at(from) && self.may_change_posture_at(&to);
        if !(may_change_posture || self.branches.same_posture(node, other)) {
            return None;
        }
        let (a, b) = if node < other { (from, &to) } else { (&to, from) };
        let look = || self.is_edge(a, b);
        let certified = if self.branches.several_per_posture() {
            look()
        } else {
            let edge = Edge::across(direction);
            from.is_certified(edge).unwrap_or_else(|| {
                let certified = look();
                self.branches.keep_edge(place, edge, there, certified);
                certified
            })
        };
        let [low, high] = [node.min(other), node.max(other)];
        certified.then(|| self.cost(self.tip(low), self.tip(high), &a.q, &b.q))
    }

    /// Whether the posture may be changed at a node.
    pub(super) fn may_change_posture_at(&self, record: &CachedNode) -> bool {
        self.may_change_posture && record.is_near_edge
    }
}

impl Graph for PostureGraph<'_> {
    fn len(&self) -> usize {
        self.branches.len() + self.places.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        if let Some(i) = node.checked_sub(self.branches.len()) {
            self.places[i].joined.iter().for_each(|&(other, cost)| visit(other, cost));
            return;
        }
        let Some((place, from)) = self.branches.look(node) else { return };
        let (_, cell) = self.branches.branch_and_cell(node);
        let branch = node - cell;
        // Both ends of a flip have to be near the edge of the reach.
        let crosses = self.branches.several_per_posture() || self.may_change_posture_at(&from);
        if crosses {
            self.visit_across(node, (place, &from), (cell, None), &mut visit);
        }
        for (direction, neighbour) in self.branches.around(cell).into_iter().enumerate() {
            let Some(neighbour) = neighbour else { continue };
            if self.branch_edge(node, (place, &from), branch + neighbour, direction) {
                let cost = self.branch_cost((node, &from), branch + neighbour, direction);
                visit(branch + neighbour, cost);
            }
            if crosses {
                self.visit_across(node, (place, &from), (neighbour, Some(direction)), &mut visit);
            }
        }
        for (i, place) in self.places.iter().enumerate() {
            for &(other, cost) in &place.joined {
                if other == node {
                    visit(self.branches.len() + i, cost);
                }
            }
        }
    }
}
