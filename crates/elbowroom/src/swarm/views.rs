//! What walks over a cost-to-go see from each node, kept for the walks that come by later.

use crate::search::Graph;

/// Nodes after which all that is kept is dropped before the next walk: some tens of megabytes.
const MOST_SPOTS: usize = 1 << 17;

/// What the swarm sees of the place it walks through. None of it may change while paths are drawn.
pub struct Terrain<'a, G> {
    /// Neighbours and step costs.
    pub graph: &'a G,
    /// Exact cost-to-go of a node (m); infinite where there is no way.
    pub cost_to_go: &'a dyn Fn(usize) -> f64,
    /// Straight distance from a node to the goal (m).
    pub distance: &'a dyn Fn(usize) -> f64,
    /// Whether a node is the goal.
    pub is_goal: &'a dyn Fn(usize) -> bool,
}

/// A neighbour that the walk may go on to.
#[derive(Clone, Copy)]
pub(super) struct Successor {
    pub(super) spot: usize,
    /// Of the step there (m).
    pub(super) cost: f64,
    /// Its cost-to-go (m).
    pub(super) position: f64,
    /// From it straight to the goal (m).
    pub(super) distance: f64,
}

/// Each node that a walk came near is a spot; what can be reached from it is asked of the terrain once. What every step
/// looks at lies close together.
pub(super) struct Views<'t, 'a, G> {
    terrain: &'t Terrain<'a, G>,
    /// The spot of each node, plus 1; 0 for a node that nobody came near.
    spots_of: Vec<u32>,
    spots: Vec<Spot>,
    /// Cost-to-go and straight distance to the goal of each spot (m).
    heights: Vec<[f64; 2]>,
    /// Who came to each spot last.
    walkers: Vec<u32>,
    /// Neighbours with a way to the goal, of one spot after the other, and what the steps there cost (m).
    neighbours: Vec<u32>,
    costs: Vec<f64>,
    unvisited: Vec<Successor>,
    walker: u32,
}

struct Spot {
    node: usize,
    is_goal: bool,
    /// Where its neighbours begin and end, once somebody stood here.
    view: Option<(u32, u32)>,
}

impl<'t, 'a, G: Graph> Views<'t, 'a, G> {
    pub(super) fn new(terrain: &'t Terrain<'a, G>) -> Self {
        Self {
            terrain,
            spots_of: vec![0; terrain.graph.len()],
            spots: Vec::new(),
            heights: Vec::new(),
            walkers: Vec::new(),
            neighbours: Vec::new(),
            costs: Vec::new(),
            unvisited: Vec::new(),
            walker: 0,
        }
    }

    /// A new walk from `start`, which has visited nothing else; spots of the walk before are no longer valid.
    pub(super) fn begin(&mut self, start: usize) -> usize {
        if self.spots.len() > MOST_SPOTS {
            for spot in self.spots.drain(..) {
                self.spots_of[spot.node] = 0;
            }
            self.heights.clear();
            self.walkers.clear();
            self.neighbours.clear();
            self.costs.clear();
        }
        self.walker += 1;
        let spot = self.spot(start);
        self.visit(spot);
        spot
    }

    pub(super) fn visit(&mut self, spot: usize) {
        self.walkers[spot] = self.walker;
    }

    pub(super) fn node(&self, spot: usize) -> usize {
        self.spots[spot].node
    }

    pub(super) fn is_goal(&self, spot: usize) -> bool {
        self.spots[spot].is_goal
    }

    /// Neighbours of `spot` with a way to the goal that this walk has not been to, in the graph's order.
    pub(super) fn unvisited(&mut self, spot: usize) -> &[Successor] {
        let (from, to) = match self.spots[spot].view {
            Some((from, to)) => (from as usize, to as usize),
            None => self.look_around(spot),
        };
        self.unvisited.clear();
        for (&spot, &cost) in self.neighbours[from..to].iter().zip(&self.costs[from..to]) {
            let spot = spot as usize;
            if self.walkers[spot] != self.walker {
                let [position, distance] = self.heights[spot];
                self.unvisited.push(Successor { spot, cost, position, distance });
            }
        }
        &self.unvisited
    }

    fn look_around(&mut self, spot: usize) -> (usize, usize) {
        let from = self.neighbours.len();
        let terrain = self.terrain;
        terrain.graph.neighbours(self.spots[spot].node, |node, cost| {
            if cost.is_finite() {
                let neighbour = self.spot(node);
                if self.heights[neighbour][0].is_finite() {
                    self.neighbours.push(neighbour as u32);
                    self.costs.push(cost);
                }
            }
        });
        let to = self.neighbours.len();
        self.spots[spot].view = Some((from as u32, to as u32));
        (from, to)
    }

    fn spot(&mut self, node: usize) -> usize {
        if let Some(spot) = self.spots_of[node].checked_sub(1) {
            return spot as usize;
        }
        let terrain = self.terrain;
        self.spots.push(Spot { node, is_goal: (terrain.is_goal)(node), view: None });
        self.heights.push([(terrain.cost_to_go)(node), (terrain.distance)(node)]);
        self.walkers.push(0);
        self.spots_of[node] = self.spots.len() as u32;
        self.spots.len() - 1
    }
}
