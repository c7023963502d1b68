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

/// A neighbour with a way to the goal.
#[derive(Clone, Copy)]
pub(super) struct Successor {
    pub(super) spot: u32,
    /// Of the step there (m).
    pub(super) cost: f64,
    /// Its cost-to-go (m).
    pub(super) position: f64,
    /// From it straight to the goal (m).
    pub(super) distance: f64,
}

/// Each node that a walk came near is a spot; what can be reached from it is asked of the terrain once.
pub(super) struct Views<'t, 'a, G> {
    terrain: &'t Terrain<'a, G>,
    /// The spot of each node, plus 1; 0 for a node that nobody came near.
    spots_of: Vec<u32>,
    spots: Vec<Spot>,
    successors: Vec<Successor>,
    unvisited: Vec<Successor>,
    walker: u32,
}

struct Spot {
    node: usize,
    is_goal: bool,
    position: f64,
    distance: f64,
    /// Where its successors begin and end, once somebody stood here.
    view: Option<(u32, u32)>,
    /// Who came here last.
    walker: u32,
}

impl<'t, 'a, G: Graph> Views<'t, 'a, G> {
    pub(super) fn new(terrain: &'t Terrain<'a, G>) -> Self {
        Self {
            terrain,
            spots_of: vec![0; terrain.graph.len()],
            spots: Vec::new(),
            successors: Vec::new(),
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
            self.successors.clear();
        }
        self.walker += 1;
        let spot = self.spot(start);
        self.visit(spot);
        spot
    }

    pub(super) fn visit(&mut self, spot: usize) {
        self.spots[spot].walker = self.walker;
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
            Some(view) => view,
            None => self.look_around(spot),
        };
        self.unvisited.clear();
        for successor in &self.successors[from as usize..to as usize] {
            if self.spots[successor.spot as usize].walker != self.walker {
                self.unvisited.push(*successor);
            }
        }
        &self.unvisited
    }

    fn look_around(&mut self, spot: usize) -> (u32, u32) {
        let from = self.successors.len() as u32;
        let terrain = self.terrain;
        terrain.graph.neighbours(self.spots[spot].node, |node, cost| {
            if cost.is_finite() {
                let neighbour = self.spot(node);
                let Spot { position, distance, .. } = self.spots[neighbour];
                if position.is_finite() {
                    self.successors.push(Successor { spot: neighbour as u32, cost, position, distance });
                }
            }
        });
        let view = (from, self.successors.len() as u32);
        self.spots[spot].view = Some(view);
        view
    }

    fn spot(&mut self, node: usize) -> usize {
        if let Some(spot) = self.spots_of[node].checked_sub(1) {
            return spot as usize;
        }
        let terrain = self.terrain;
        self.spots.push(Spot {
            node,
            is_goal: (terrain.is_goal)(node),
            position: (terrain.cost_to_go)(node),
            distance: (terrain.distance)(node),
            view: None,
            walker: 0,
        });
        self.spots_of[node] = self.spots.len() as u32;
        self.spots.len() - 1
    }
}
