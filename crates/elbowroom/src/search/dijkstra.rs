use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::goal::goal_cost;
use super::{GoalError, Graph};

/// The cost-to-go of every node: the least cost of a way to any of `goals`, infinite where there is none.
///
/// Each goal is a node and the cost of ending there; of two goals at one node the cheaper counts. One run from
/// scratch, kept plain: it judges [`Dstar`](super::Dstar), whose field equals this one to the last bit.
///
/// # Errors
/// [`GoalError`] for a goal that is no node of the graph, or whose cost is negative, infinite or NaN.
///
/// # Reference
/// Dijkstra, "A note on two problems in connexion with graphs", *Numerische Mathematik* 1 (1959).
pub fn dijkstra<G: Graph>(graph: &G, goals: &[(usize, f64)]) -> Result<Vec<f64>, GoalError> {
    let mut field = vec![f64::INFINITY; graph.len()];
    let mut queue = BinaryHeap::new();
    for &(node, cost) in goals {
        let cost = goal_cost(node, cost, field.len())?;
        if cost < field[node] {
            field[node] = cost;
            queue.push(Reverse((cost.to_bits(), node)));
        }
    }
    // Costs are never negative, so their bits sort as they do.
    while let Some(Reverse((bits, node))) = queue.pop() {
        let from_here = f64::from_bits(bits);
        if from_here > field[node] {
            continue;
        }
        graph.neighbours(node, |neighbour, step| {
            let through = from_here + step;
            if through < field[neighbour] {
                field[neighbour] = through;
                queue.push(Reverse((through.to_bits(), neighbour)));
            }
        });
    }
    Ok(field)
}
