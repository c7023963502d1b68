use std::collections::BTreeMap;

use super::goal::goal_cost;
use super::nodes::Nodes;
use super::open_list::OpenList;
use super::ring::Ring;
use super::{GoalError, Graph};

/// Expansions between two questions whether to go on: a few milliseconds on the slowest of graphs.
const EXPANSIONS_PER_LOOK: usize = 100;

/// D*: the cost-to-go of the nodes of a graph, and the way there, repaired where costs change.
///
/// After [`expand`](Self::expand) is done with the whole field, cost-to-go equals that of
/// [`dijkstra`](super::dijkstra) to the last bit, whatever the changes before. Between
/// [`changed`](Self::changed) and that, back-pointers may be out of date.
///
/// Several goals are one: each is joined to a goal behind them all by an edge that costs what ending there costs,
/// so a goal that was raised falls back to its own cost.
///
/// Where the graph tells its [usual step](Graph::usual_step), the first wave from the goals needs no comparison heap; it
/// may close some nodes more than [`Until::Settled`] asks for. Memory is taken as the search spreads.
///
/// # Example
/// ```
/// use elbowroom::search::{Dstar, Graph, Progress, Until};
///
/// /// Nodes in a row, one apart, with a door between 1 and 2.
/// struct Row {
///     door: f64,
/// }
///
/// impl Graph for Row {
///     fn len(&self) -> usize {
///         4
///     }
///
///     fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
///         let step = |low: usize| if low == 1 { self.door } else { 1.0 };
///         if node > 0 {
///             visit(node - 1, step(node - 1));
///         }
///         if node < 3 {
///             visit(node + 1, step(node));
///         }
///     }
/// }
///
/// let mut row = Row { door: 1.0 };
/// let mut dstar = Dstar::new(row.len());
/// dstar.insert_goal(3, 0.0)?;
/// assert_eq!(dstar.expand(&row, Until::Settled(0), 1000), Progress::Done);
/// assert_eq!(dstar.path(0), Some(vec![0, 1, 2, 3]));
///
/// row.door = f64::INFINITY;
/// dstar.changed(&row, [1, 2]);
/// assert_eq!(dstar.expand(&row, Until::Settled(0), 1000), Progress::Done);
/// assert_eq!(dstar.cost_to_go(0), f64::INFINITY);
/// # Ok::<(), elbowroom::search::GoalError>(())
/// ```
///
/// # Reference
/// Stentz, "Optimal and efficient path planning for partially-known environments", *ICRA* (1994). Names of the
/// paper: `h` is the cost-to-go, `k` the key on the open list, `b` the back-pointer.
#[derive(Debug, Clone)]
pub struct Dstar {
    pub(super) nodes: Nodes,
    pub(super) open: OpenList,
    /// The queue of the first wave from the goals, while nothing but lowering is going on.
    pub(super) ring: Option<Ring>,
    goals: BTreeMap<usize, f64>,
    pub(super) expansions: usize,
}

/// What D* holds of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeState {
    /// Never reached: no way is known.
    New,
    /// On the open list: its cost-to-go is new, and its neighbours do not know of it yet.
    Open,
    /// Off the open list.
    Closed,
}

/// How far [`Dstar::expand`] goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// The cost-to-go of this node is final, and so is that of every node with no more.
    Settled(usize),
    /// The cost-to-go of every node that has no more than this is final.
    Within(f64),
    /// The cost-to-go of every node is final.
    WholeField,
}

/// Whether [`Dstar::expand`] reached its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Progress {
    /// It did.
    Done,
    /// The budget ran out first: the next call goes on from here.
    Paused,
}

impl Dstar {
    /// No goals yet, over a graph of `len` nodes: no way is known from any node.
    ///
    /// # Panics
    /// For `u32::MAX` nodes or more, which no memory holds.
    pub fn new(len: usize) -> Self {
        Self {
            nodes: Nodes::new(len),
            open: OpenList::new(len),
            ring: None,
            goals: BTreeMap::new(),
            expansions: 0,
        }
    }

    /// How many nodes the graph has.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether the graph has no nodes.
    pub fn is_empty(&self) -> bool {
        self.nodes.len() == 0
    }

    /// Makes `node` a goal, where ending costs `cost`; the latest cost given to a goal counts.
    ///
    /// # Errors
    /// [`GoalError`] if there is no such node, or the cost is negative, infinite or NaN.
    pub fn insert_goal(&mut self, node: usize, cost: f64) -> Result<(), GoalError> {
        let cost = goal_cost(node, cost, self.len())?;
        self.end_wave();
        let known = self.goals.insert(node, cost);
        // What expanding the goal behind all goals does to this one: raise it if its way ends here, lower it.
        let ends_here = known.is_some() && self.nodes.next(node).is_none();
        if cost < self.nodes.cost(node) || (ends_here && cost > self.nodes.cost(node)) {
            self.nodes.end_at(node);
            self.insert(node, cost);
        }
        Ok(())
    }

    /// Forgets all ways, but not the goals: as after [`new`](Self::new), where more would have to be repaired than to be
    /// found again.
    pub fn begin_again(&mut self) {
        self.nodes.clear();
        self.open.clear();
        self.ring = None;
        self.expansions = 0;
        for (&node, &cost) in &self.goals {
            self.nodes.set_cost(node, cost);
            self.open.insert(node, cost);
        }
    }

    /// Expands nodes until `until` holds, asking `keep_going` every few milliseconds; whether it holds, or was told no.
    pub fn settle<G: Graph>(&mut self, graph: &G, until: Until, keep_going: &dyn Fn() -> bool) -> bool {
        while self.expand(graph, until, EXPANSIONS_PER_LOOK) == Progress::Paused {
            if !keep_going() {
                return false;
            }
        }
        true
    }

    /// Expands nodes until `until` holds or `budget` nodes are expanded.
    ///
    /// `graph` must be the one D* was told of so far, with as many nodes.
    pub fn expand<G: Graph>(&mut self, graph: &G, until: Until, budget: usize) -> Progress {
        debug_assert_eq!(graph.len(), self.len());
        self.begin_wave(graph);
        let mut left = budget;
        while !self.holds(until) {
            if left == 0 {
                return Progress::Paused;
            }
            left -=
                if self.ring.is_some() { self.expand_bucket(graph, left) } else { self.expand_one(graph) };
        }
        Progress::Done
    }

    /// Tells that edges of `nodes` cost something else now, in `graph` as it is from here on.
    ///
    /// Either end of a changed edge will do; for a cell blocked or freed, the cell. Nothing is repaired before
    /// [`expand`](Self::expand). Numbers that are no node are passed over.
    pub fn changed<G: Graph>(&mut self, graph: &G, nodes: impl IntoIterator<Item = usize>) {
        debug_assert_eq!(graph.len(), self.len());
        self.end_wave();
        for node in nodes.into_iter().filter(|&node| node < graph.len()) {
            // Both ends of every edge: a lowered cost spreads from the end that is nearer to the goal.
            self.reopen(node);
            graph.neighbours(node, |neighbour, _| self.reopen(neighbour));
        }
    }

    /// Tells that the step between `a` and `b` costs `cost` now, in either direction: what [`changed`](Self::changed) does,
    /// for one edge, but nothing is put on the list that it makes no difference to.
    ///
    /// A cost that is told too low does no harm where neither's [`next`](Self::next) is the other. A step that is no part
    /// of the ways known, and would not shorten them, need not be told at all. Numbers that are no node are passed over.
    pub fn step_changed(&mut self, a: usize, b: usize, cost: f64) {
        if a >= self.len() || b >= self.len() {
            return;
        }
        self.end_wave();
        for (node, other) in [(a, b), (b, a)] {
            let through = self.nodes.cost(other) + cost;
            if self.next(node) == Some(other) && through != self.nodes.cost(node) {
                self.insert(node, through);
            } else if through < self.nodes.cost(node) {
                self.reopen(other);
            }
        }
    }

    /// The cost of the best way known from `node` to a goal; infinite if none is known, or there is no such node.
    pub fn cost_to_go(&self, node: usize) -> f64 {
        if node < self.len() { self.nodes.cost(node) } else { f64::INFINITY }
    }

    /// The cost-to-go of every node.
    pub fn field(&self) -> Vec<f64> {
        self.nodes.costs().collect()
    }

    /// The back-pointer of `node`: the next one on its way, or `None` at the way's end and where no way is known.
    pub fn next(&self, node: usize) -> Option<usize> {
        if self.cost_to_go(node) < f64::INFINITY { self.nodes.next(node) } else { None }
    }

    /// The nodes from `node` to its goal, both included, along the back-pointers; `None` if no way is known.
    pub fn path(&self, node: usize) -> Option<Vec<usize>> {
        let mut path = Vec::new();
        let mut at = Some(node);
        while let Some(node) = at {
            // A way that was cut and not yet repaired may lead nowhere or, in the end, round and round.
            if self.cost_to_go(node) == f64::INFINITY || path.len() == self.len() {
                return None;
            }
            path.push(node);
            at = self.next(node);
        }
        Some(path)
    }

    /// What is held of `node`; [`NodeState::New`] also if there is no such node.
    pub fn state(&self, node: usize) -> NodeState {
        if node >= self.len() || (!self.open.contains(node) && self.nodes.is_new(node)) {
            NodeState::New
        } else if self.open.contains(node) {
            NodeState::Open
        } else {
            NodeState::Closed
        }
    }

    /// How many nodes were expanded since the beginning.
    pub fn expansions(&self) -> usize {
        self.expansions
    }

    /// Whether nothing on the open list can change what `until` asks for.
    /// Entries for which there is room in the open list, never more than there are nodes; and those in the buckets of a first
    /// wave, where a node that fell from one bucket to another has several.
    pub fn waiting(&self) -> [usize; 2] {
        [self.open.room(), self.ring.as_ref().map_or(0, Ring::len)]
    }

    fn holds(&self, until: Until) -> bool {
        if let Some(ring) = &self.ring {
            return match (self.first_bucket(ring), until) {
                (None, _) => true,
                (Some(first), Until::Settled(node)) => first > ring.bucket_of(self.cost_to_go(node)),
                (Some(first), Until::Within(cost)) => first > ring.bucket_of(cost),
                (Some(_), Until::WholeField) => false,
            };
        }
        match (self.open.least_key(), until) {
            (None, _) => true,
            (Some(least), Until::Settled(node)) => least >= self.cost_to_go(node),
            (Some(least), Until::Within(cost)) => least >= cost,
            (Some(_), Until::WholeField) => false,
        }
    }

    /// PROCESS-STATE of the paper; how many nodes that expanded.
    fn expand_one<G: Graph>(&mut self, graph: &G) -> usize {
        let Some((node, key)) = self.open.pop() else { return 0 };
        self.expansions += 1;
        if key < self.nodes.cost(node) {
            self.fall_back(graph, node, key);
        }
        // Not `else`: a raised node that fell back to its key spreads it as a lowered one.
        if key < self.nodes.cost(node) {
            self.spread_raise(graph, node, key);
        } else {
            self.spread_lower(graph, node);
        }
        1
    }

    /// Leads raised `node` through a goal or a neighbour that is settled, where that is cheaper.
    fn fall_back<G: Graph>(&mut self, graph: &G, node: usize, key: f64) {
        let mut best = self.nodes.cost(node);
        if let Some(&goal) = self.goals.get(&node)
            && goal < best
        {
            best = goal;
            self.nodes.end_at(node);
        }
        graph.neighbours(node, |neighbour, step| {
            let onward = self.nodes.cost(neighbour);
            if onward <= key && onward + step < best {
                best = onward + step;
                self.nodes.set_next(node, neighbour);
            }
        });
        self.nodes.set_cost(node, best);
    }

    /// LOWER: hands the final cost of `node` on, to those it improves and to those whose way leads through it.
    fn spread_lower<G: Graph>(&mut self, graph: &G, node: usize) {
        let cost = self.nodes.cost(node);
        graph.neighbours(node, |neighbour, step| {
            let (known, through) = (self.nodes.cost(neighbour), cost + step);
            if through < known || (through > known && self.nodes.leads_to(neighbour, node)) {
                self.nodes.set_next(neighbour, node);
                self.insert(neighbour, through);
            }
        });
    }

    /// RAISE: hands the cost of `node`, which is not final, on to those whose way leads through it.
    ///
    /// Others it could improve have to wait until it comes back as a lowered node; those that could improve it
    /// are put on the list to do so.
    fn spread_raise<G: Graph>(&mut self, graph: &G, node: usize, key: f64) {
        let cost = self.nodes.cost(node);
        graph.neighbours(node, |neighbour, step| {
            let (known, through) = (self.nodes.cost(neighbour), cost + step);
            let leads_here = self.nodes.leads_to(neighbour, node);
            if (leads_here && through != known) || (through < known && self.nodes.is_new(neighbour)) {
                self.nodes.set_next(neighbour, node);
                self.insert(neighbour, through);
            } else if through < known {
                self.insert(node, cost);
            } else if !leads_here && known > key && known + step < cost && !self.open.contains(neighbour) {
                self.insert(neighbour, known);
            }
        });
    }

    /// INSERT of the paper: sets the cost of `node` and puts it on the open list.
    ///
    /// The key is the least cost since it got there. Without any way before and after there is nothing to hand on.
    fn insert(&mut self, node: usize, cost: f64) {
        let key = self.nodes.cost(node).min(cost);
        self.nodes.set_cost(node, cost);
        if key < f64::INFINITY {
            self.open.insert(node, key);
        }
    }

    /// MODIFY-COST of the paper, for one end of an edge whose cost is another now.
    fn reopen(&mut self, node: usize) {
        self.insert(node, self.nodes.cost(node));
    }
}
