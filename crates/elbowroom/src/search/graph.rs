/// Nodes and what the steps between them cost.
///
/// Costs are symmetric, greater than 0, never NaN, and large enough not to vanish when added to a cost-to-go.
/// Whether two nodes are neighbours never changes, and no node is a neighbour twice over or of itself; only costs
/// change. An edge that is blocked now is still visited, with cost `f64::INFINITY`, for D* has to raise through it.
///
/// Costs may be worked out when first asked for, behind interior mutability; the answer may change only where
/// [`Dstar::changed`](super::Dstar::changed) is told.
pub trait Graph {
    /// How many nodes there are; a node is a number below this.
    fn len(&self) -> usize;

    /// Whether there are no nodes at all.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Calls `visit` with each neighbour of `node` and the cost of the step between them, always in the same order.
    fn neighbours(&self, node: usize, visit: impl FnMut(usize, f64));

    /// A cost that few steps are below, where one is known: with it a first search needs no comparison heap. It changes
    /// nothing but the time taken, whatever it is.
    fn usual_step(&self) -> Option<f64> {
        None
    }
}
