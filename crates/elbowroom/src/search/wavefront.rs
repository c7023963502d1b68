use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::goal::goal_cost;
use super::ring::Ring;
use super::{GoalError, Graph, dijkstra};

/// The cost-to-go of every node, that of [`dijkstra`] to the last bit, without a comparison heap where the graph tells
/// its [usual step](Graph::usual_step).
///
/// A node that is improved is queued again, so the field is right whatever the order of the queue: of all ways, summed
/// up from the goal, the one of least sum.
///
/// # Errors
/// [`GoalError`] for a goal that is no node of the graph, or whose cost is negative, infinite or NaN.
///
/// # Reference
/// Denardo and Fox, "Shortest-route methods: 1. Reaching, pruning, and buckets", *Operations Research* 27(1) (1979).
pub fn wavefront<G: Graph>(graph: &G, goals: &[(usize, f64)]) -> Result<Vec<f64>, GoalError> {
    let Some(mut ring) = graph.usual_step().and_then(Ring::new) else { return dijkstra(graph, goals) };
    let mut field = vec![f64::INFINITY; graph.len()];
    // Goals that wait for their turn, and steps that lead beyond the ring.
    let mut far = BinaryHeap::new();
    for &(node, cost) in goals {
        let cost = goal_cost(node, cost, field.len())?;
        if cost < field[node] {
            field[node] = cost;
            far.push(Reverse((cost.to_bits(), node)));
        }
    }
    loop {
        let first_far = far.peek().map(|Reverse((bits, _))| ring.bucket_of(f64::from_bits(*bits)));
        let Some(bucket) = [ring.first(), first_far].into_iter().flatten().min() else { return Ok(field) };
        ring.go_on_to(bucket);
        while let Some(&Reverse((bits, node))) = far.peek()
            && ring.bucket_of(f64::from_bits(bits)) == bucket
        {
            far.pop();
            // If it was improved within the bucket, this entry stands for that.
            if ring.bucket_of(field[node]) == bucket {
                ring.push(bucket, node);
            }
        }
        while let Some(node) = ring.pop() {
            let from_here = field[node];
            // Improved since, and queued where it belongs.
            if ring.bucket_of(from_here) != bucket {
                continue;
            }
            graph.neighbours(node, |neighbour, step| {
                let through = from_here + step;
                let known = &mut field[neighbour];
                if through < *known {
                    let before = ring.bucket_of(*known);
                    *known = through;
                    let to = ring.bucket_of(through);
                    let waits_there = to == before && to != bucket;
                    if !waits_there && !ring.push(to, neighbour) {
                        push_far(&mut far, neighbour, through);
                    }
                }
            });
        }
    }
}

/// Out of the way of the loop that hardly ever needs it.
#[cold]
fn push_far(far: &mut BinaryHeap<Reverse<(u64, usize)>>, node: usize, cost: f64) {
    far.push(Reverse((cost.to_bits(), node)));
}
