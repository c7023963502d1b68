use std::cell::RefCell;

use super::clearance_cache::{CachedClearance, Obstacles};
use crate::arm::{JointLimits, Posture, TwoLink};
use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::grid::Grid;
use crate::scene::TwoLinkScene;

/// Rounding in the count of turns: a range of exactly one turn has one branch, not two.
const TURN_ROUNDING: f64 = 1e-9;

/// Most that a joint turns in one step (rad): at half a revolution rounding would say which way round.
const MOST_TURN: f64 = std::f64::consts::PI - 1e-6;

/// For how many nodes there is room at first.
const LEAST_ROOM: usize = 64;

/// The free configurations over the grid, laid out by solution branch, one per posture, and more where a joint with limits can
/// turn more than once round. What is asked of a node is worked out once and kept; a node never asked for costs
/// four bytes.
pub(crate) struct BranchGrid<'a> {
    scene: TwoLinkScene<'a>,
    space: &'a FreeSpace,
    /// How near to the edge of the reach is near (m).
    edge_band: f64,
    per_posture: usize,
    cells: usize,
    /// From a cell that is not at the grid's edge to its neighbours.
    steps_around: Option<[isize; 8]>,
    pub(super) obstacles: Obstacles<'a>,
    cache: NodeCache,
}

/// What was found out about nodes; it may outlive the graph where obstacles move.
#[derive(Default)]
pub(crate) struct NodeCache {
    /// Where in `records` each node's is, plus 1; 0 for a node never asked for.
    places: RefCell<Vec<u32>>,
    records: RefCell<Vec<CachedNode>>,
}

/// What is known of a free node; small, for a fine grid has millions of them.
#[derive(Clone, Copy)]
pub(crate) struct CachedNode {
    pub(crate) q: [f64; 2],
    pub(super) nearest: CachedClearance,
    /// Whether the tip is near full stretch or fold.
    pub(crate) is_near_edge: bool,
    /// Whether obstacles moved near by: all but `q` has to be worked out again, if the node is free at all.
    is_due: bool,
    /// The edges from here, a bit each: examined, and certified.
    known: u32,
    certified: u32,
}

/// An edge from a node, by where it leads.
#[derive(Clone, Copy)]
pub(crate) struct Edge(u32);

impl Edge {
    /// To the neighbour in `direction` on the same branch.
    pub(crate) fn along(direction: usize) -> Self {
        Self(direction as u32)
    }

    /// To the other branch, where there are two: over the neighbour in `direction`, or over the same cell.
    pub(crate) fn across(direction: Option<usize>) -> Self {
        Self(direction.map_or(16, |direction| 8 + direction as u32))
    }

    /// The same edge from its other end: directions go once round, so the way back is four further.
    fn reverse(self) -> Self {
        if self.0 == 16 { self } else { Self((self.0 & 8) | ((self.0 + 4) & 7)) }
    }
}

impl CachedNode {
    /// Whether `edge` is certified; `None` if nobody looked yet.
    pub(crate) fn is_certified(&self, edge: Edge) -> Option<bool> {
        (self.known >> edge.0 & 1 == 1).then_some(self.certified >> edge.0 & 1 == 1)
    }

    fn forget(&mut self) {
        self.is_due = true;
    }

    fn keep(&mut self, edge: Edge, certified: bool) {
        self.known |= 1 << edge.0;
        self.certified |= u32::from(certified) << edge.0;
    }
}

impl<'a> BranchGrid<'a> {
    /// The branches over the map of `scene`, with what is known of them already: of the same arm and grid, and told by
    /// [`forget`](Self::forget) where obstacles moved.
    pub(crate) fn new(
        scene: TwoLinkScene<'a>,
        space: &'a FreeSpace,
        edge_band: f64,
        cache: NodeCache,
    ) -> Self {
        let per_posture: usize = scene.arm().joints().iter().map(|joint| turns(&joint.limits)).product();
        let cells = scene.grid().len();
        Self {
            scene,
            space,
            edge_band,
            per_posture,
            cells,
            steps_around: steps_around(scene.grid()),
            obstacles: Obstacles::of(scene),
            cache: cache.of_len(2 * per_posture * cells),
        }
    }

    /// What is known by now.
    pub(crate) fn into_cache(self) -> NodeCache {
        self.cache
    }

    /// Forgets what obstacles that moved near `node` may have changed.
    pub(crate) fn forget(&self, node: usize) {
        let place = self.cache.places.borrow()[node] as usize;
        if let Some(place) = place.checked_sub(1) {
            self.cache.records.borrow_mut()[place].forget();
        }
    }

    /// [`forget`](Self::forget), for all nodes.
    pub(crate) fn forget_all(&self) {
        self.cache.records.borrow_mut().iter_mut().for_each(CachedNode::forget);
    }

    /// How many nodes there are: every branch has one over every cell, free or not.
    pub(crate) fn len(&self) -> usize {
        2 * self.per_posture * self.cells
    }

    /// Whether there is more than one branch of a posture.
    pub(crate) fn several_per_posture(&self) -> bool {
        self.per_posture > 1
    }

    /// The branch that `node` lies on, and the cell under it.
    pub(crate) fn branch_and_cell(&self, node: usize) -> (usize, usize) {
        // Mostly there are two branches, and a division is slow.
        if node < self.cells {
            (0, node)
        } else if node < 2 * self.cells {
            (1, node - self.cells)
        } else {
            (node / self.cells, node % self.cells)
        }
    }

    /// The nodes over `cell`, one per branch.
    pub(crate) fn over(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        (cell..self.len()).step_by(self.cells)
    }

    /// Whether two nodes lie on one branch.
    pub(crate) fn same_branch(&self, a: usize, b: usize) -> bool {
        self.branch_and_cell(a).0 == self.branch_and_cell(b).0
    }

    /// Whether two nodes have one posture, whatever their turns.
    pub(crate) fn same_posture(&self, a: usize, b: usize) -> bool {
        let nodes = self.cells * self.per_posture;
        (a < nodes) == (b < nodes)
    }

    /// The posture of `node`.
    pub(crate) fn posture(&self, node: usize) -> Posture {
        Posture::ALL[usize::from(node >= self.cells * self.per_posture)]
    }

    /// The cells around `cell`, by their direction; `None` past the edge of the grid.
    pub(crate) fn around(&self, cell: usize) -> [Option<usize>; 8] {
        let grid = self.scene.grid();
        let (column, row) = grid.column_row(cell);
        let inside = (1..grid.columns() - 1).contains(&column) && (1..grid.rows() - 1).contains(&row);
        match &self.steps_around {
            Some(steps) if inside => steps.map(|step| cell.checked_add_signed(step)),
            _ => std::array::from_fn(|direction| grid.neighbour(cell, direction)),
        }
    }

    /// The configuration at `node` if it is free.
    pub(crate) fn configuration(&self, node: usize) -> Option<[f64; 2]> {
        self.look(node).map(|(_, record)| record.q)
    }

    /// Keeps whether the edge from the record at `from` to the one at `to` is certified.
    pub(crate) fn keep_edge(&self, from: usize, edge: Edge, to: usize, certified: bool) {
        let mut records = self.cache.records.borrow_mut();
        records[from].keep(edge, certified);
        records[to].keep(edge.reverse(), certified);
    }

    /// What is known of `node`, and where that is kept; `None` if the node is not free.
    pub(crate) fn look(&self, node: usize) -> Option<(usize, CachedNode)> {
        let place = self.cache.places.borrow()[node] as usize;
        let Some(place) = place.checked_sub(1) else {
            if !self.is_free(node) {
                return None;
            }
            let record = self.work_out(node, self.stand(node)?);
            return Some((self.cache.keep(node, record), record));
        };
        let record = self.cache.records.borrow()[place];
        if !record.is_due {
            return Some((place, record));
        }
        if !self.is_free(node) {
            return None;
        }
        let record = self.work_out(node, record.q);
        self.cache.records.borrow_mut()[place] = record;
        Some((place, record))
    }

    /// Whether the tip may stand under `node` in its posture.
    pub(crate) fn is_free(&self, node: usize) -> bool {
        self.space.map(self.posture(node)).is_free(self.branch_and_cell(node).1)
    }

    /// Whether the tip is near full stretch or fold at `node`.
    pub(crate) fn is_near_edge(&self, node: usize) -> bool {
        let tip = self.scene.grid().point(self.branch_and_cell(node).1);
        to_edge(self.scene.arm(), tip) <= self.edge_band
    }

    /// The configuration at `node`, whatever the obstacles, if the arm can stand there.
    pub(crate) fn stand(&self, node: usize) -> Option<[f64; 2]> {
        let (branch, cell) = self.branch_and_cell(node);
        let q = self.scene.arm().inverse_unlimited(self.scene.grid().point(cell), self.posture(node)).ok()?;
        let [first, second] = self.scene.arm().joints().map(|joint| joint.limits);
        let (mut firsts, mut seconds) = (first.places(q[0]), second.places(q[1]));
        let (turn, each) = (branch % self.per_posture, seconds.len().max(1));
        Some([firsts.nth(turn / each)?, seconds.nth(turn % each)?])
    }

    fn work_out(&self, node: usize, q: [f64; 2]) -> CachedNode {
        let nearest = self.obstacles.nearest_to(&q);
        let is_near_edge = self.is_near_edge(node);
        CachedNode { q, nearest, is_near_edge, is_due: false, known: 0, certified: 0 }
    }
}

impl NodeCache {
    /// Of how many nodes something is known.
    pub(crate) fn count(&self) -> usize {
        self.records.borrow().len()
    }

    /// For how many nodes there is room: twice as many as were ever looked at, and never more than there are.
    pub(crate) fn room(&self) -> usize {
        self.records.borrow().capacity()
    }

    /// Keeps the first `record` of `node`; where.
    fn keep(&self, node: usize, record: CachedNode) -> usize {
        let (mut places, mut records) = (self.places.borrow_mut(), self.records.borrow_mut());
        let known = records.len();
        if known == records.capacity() {
            records.reserve_exact(known.max(LEAST_ROOM).min(places.len() - known));
        }
        records.push(record);
        places[node] = records.len() as u32;
        known
    }

    /// With room for `len` nodes, if there is none yet.
    fn of_len(self, len: usize) -> Self {
        if self.places.borrow().len() == len {
            return self;
        }
        Self { places: RefCell::new(vec![0; len]), records: RefCell::new(Vec::new()) }
    }
}

/// From a cell to its neighbours, where the grid has a cell with all eight.
fn steps_around(grid: &Grid) -> Option<[isize; 8]> {
    if grid.columns() < 3 || grid.rows() < 3 {
        return None;
    }
    let inner = grid.cell(1, 1);
    let mut steps = [0; 8];
    for (direction, step) in steps.iter_mut().enumerate() {
        *step = grid.neighbour(inner, direction)? as isize - inner as isize;
    }
    Some(steps)
}

/// From `tip` to the nearer edge of the reach (m).
pub(crate) fn to_edge(arm: &TwoLink, tip: Point) -> f64 {
    let [nearest, farthest] = arm.reach();
    let distance = tip.distance(arm.base());
    (farthest - distance).min(distance - nearest).max(0.0)
}

/// How many branches a joint needs for one direction of its link.
fn turns(limits: &JointLimits) -> usize {
    match *limits {
        JointLimits::Continuous => 1,
        JointLimits::Range { min, max } => {
            (((max - min) / std::f64::consts::TAU - TURN_ROUNDING).ceil() as usize).max(1)
        }
    }
}

/// The configuration that `to` is when the joints turn there from `from` directly: a continuous joint the
/// short way, with its turns counted; one with limits by the plain difference. `None` when a joint would
/// turn by half a revolution or more, which no single step of a path needs.
pub(crate) fn direct(arm: &TwoLink, from: &[f64; 2], to: &[f64; 2]) -> Option<[f64; 2]> {
    let steps = arm.difference(from, to);
    let short = steps[0].abs() <= MOST_TURN && steps[1].abs() <= MOST_TURN;
    short.then(|| [from[0] + steps[0], from[1] + steps[1]])
}
