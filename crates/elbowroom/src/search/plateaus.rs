use std::collections::HashMap;

use super::{Dstar, Graph};

/// Nodes between two questions whether to go on.
const NODES_PER_LOOK: usize = 1 << 14;

/// What lies on a way that is worth going, though it is not the shortest. Costs are shares of the least.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateauSettings {
    /// By how much the way there and on may cost more than the least.
    pub within: f64,
    /// How far it has to be a shortest way on both sides of the node.
    pub stretch: f64,
    /// Share of that stretch by which another may be shorter: steps of a grid are uneven.
    pub drop: f64,
}

/// Nodes by way of which a locally shortest way leads from where `from_start` begins to where `to_goal` ends, in connected pieces between
/// the same ends, those with the cheapest way first, as in each piece; `least` is the cost of the shortest way of all. `None` where
/// `keep_going`, asked now and then, said no.
///
/// Along such a way both costs together stay the same, on a plateau, while the way to a node anywhere else and on from there has a bend
/// at it, and falls to either side. The wider an obstacle, the longer the plateau beside it.
///
/// # Reference
/// Alternative routes by plateaus and by way of single nodes: Abraham, Delling, Goldberg and Werneck, *Alternative routes in road
/// networks*, SEA 2010.
pub fn plateaus<G: Graph>(
    graph: &G,
    from_start: &Dstar,
    to_goal: &Dstar,
    least: f64,
    settings: &PlateauSettings,
    keep_going: &dyn Fn() -> bool,
) -> Option<Vec<Vec<usize>>> {
    let cost_by = |node: usize| from_start.cost_to_go(node) + to_goal.cost_to_go(node);
    let is_level = |from: usize, there: &Dstar, back: &Dstar| {
        let mut at = from;
        let mut walked = 0.0;
        while walked < settings.stretch * least
            && let Some(next) = there.next(at)
        {
            at = next;
            walked = there.cost_to_go(from) - there.cost_to_go(at);
        }
        back.cost_to_go(at) >= back.cost_to_go(from) + (1.0 - settings.drop) * walked
    };
    let is_on = |node: usize| {
        cost_by(node) <= (1.0 + settings.within) * least
            && is_level(node, to_goal, from_start)
            && is_level(node, from_start, to_goal)
    };
    let mut ends = [from_start, to_goal].map(Ends::of);
    let mut on = Vec::new();
    let mut between: HashMap<usize, [usize; 2]> = HashMap::new();
    for node in 0..graph.len() {
        if node.is_multiple_of(NODES_PER_LOOK) && !keep_going() {
            return None;
        }
        if is_on(node) {
            on.push(node);
            between.insert(node, ends.each_mut().map(|ends| ends.end_of(node)));
        }
    }
    let mut pieces: Vec<Vec<usize>> = Vec::new();
    for first in on {
        let Some(ends) = between.remove(&first) else { continue };
        let mut piece = vec![first];
        let mut seen = 0;
        while let Some(&node) = piece.get(seen) {
            seen += 1;
            graph.neighbours(node, |neighbour, cost| {
                if cost.is_finite() && between.get(&neighbour) == Some(&ends) {
                    between.remove(&neighbour);
                    piece.push(neighbour);
                }
            });
        }
        piece.sort_by(|&a, &b| cost_by(a).total_cmp(&cost_by(b)).then(a.cmp(&b)));
        pieces.push(piece);
    }
    pieces.sort_by(|a, b| cost_by(a[0]).total_cmp(&cost_by(b[0])));
    Some(pieces)
}

/// Where the ways from nodes end, each found once.
struct Ends<'a> {
    field: &'a Dstar,
    known: HashMap<usize, usize>,
}

impl<'a> Ends<'a> {
    fn of(field: &'a Dstar) -> Self {
        Self { field, known: HashMap::new() }
    }

    fn end_of(&mut self, node: usize) -> usize {
        let mut way = vec![node];
        let mut at = node;
        let end = loop {
            match (self.known.get(&at), self.field.next(at)) {
                (Some(&end), _) => break end,
                (None, None) => break at,
                (None, Some(next)) => at = next,
            }
            way.push(at);
        };
        for node in way {
            self.known.insert(node, end);
        }
        end
    }
}
