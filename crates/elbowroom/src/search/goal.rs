use thiserror::Error;

/// Why a node cannot be a goal.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum GoalError {
    /// The graph has no such node.
    #[error("goal is node {node}, but there are only {len} nodes")]
    Node {
        /// What was asked.
        node: usize,
        /// How many nodes there are.
        len: usize,
    },
    /// The cost of ending there is negative, infinite or not a number.
    #[error("goal at node {node} costs {cost}, it must be finite and not negative")]
    Cost {
        /// Where the goal is.
        node: usize,
        /// What was asked.
        cost: f64,
    },
}

/// The cost of ending at `node`, if it may be a goal among `len` nodes; never -0.
pub(super) fn goal_cost(node: usize, cost: f64, len: usize) -> Result<f64, GoalError> {
    if node >= len {
        return Err(GoalError::Node { node, len });
    }
    if !(cost.is_finite() && cost >= 0.0) {
        return Err(GoalError::Cost { node, cost });
    }
    Ok(cost + 0.0)
}
