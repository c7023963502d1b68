/// The bits of an infinite cost, which are greater than those of any other.
const INFINITY: u64 = f64::INFINITY.to_bits();

/// The back-pointer of a node that has none.
const NONE: u32 = 0;

/// What D* holds of the nodes: cost-to-go and back-pointer.
///
/// A node never reached is all zeros, and memory that is all zeros is handed out by the system page by page, when first
/// touched: a search that ends early costs no time for the nodes it did not see.
#[derive(Debug, Clone)]
pub(super) struct Nodes {
    /// By how much the bits of the cost are below those of an infinite one.
    costs: Vec<u64>,
    /// The number of the next node, plus 1.
    pointers: Vec<u32>,
}

impl Nodes {
    /// `len` nodes that were never reached.
    ///
    /// # Panics
    /// For `u32::MAX` nodes or more, which no memory holds.
    pub(super) fn new(len: usize) -> Self {
        assert!(len < u32::MAX as usize, "{len} nodes are more than D* can number");
        Self { costs: vec![0; len], pointers: vec![NONE; len] }
    }

    /// As if none had ever been reached.
    pub(super) fn clear(&mut self) {
        self.costs.fill(0);
        self.pointers.fill(NONE);
    }

    pub(super) fn len(&self) -> usize {
        self.costs.len()
    }

    #[inline]
    pub(super) fn cost(&self, node: usize) -> f64 {
        f64::from_bits(INFINITY - self.costs[node])
    }

    /// `cost` must not be negative or -0.
    #[inline]
    pub(super) fn set_cost(&mut self, node: usize, cost: f64) {
        debug_assert!(cost >= 0.0 && cost.is_sign_positive());
        self.costs[node] = INFINITY - cost.to_bits();
    }

    pub(super) fn costs(&self) -> impl Iterator<Item = f64> {
        self.costs.iter().map(|below| f64::from_bits(INFINITY - below))
    }

    #[inline]
    pub(super) fn next(&self, node: usize) -> Option<usize> {
        (self.pointers[node] as usize).checked_sub(1)
    }

    #[inline]
    pub(super) fn set_next(&mut self, node: usize, next: usize) {
        self.pointers[node] = next as u32 + 1;
    }

    /// Makes `node` the end of its way.
    pub(super) fn end_at(&mut self, node: usize) {
        self.pointers[node] = NONE;
    }

    /// Whether the way from `node` leads to `next` first.
    #[inline]
    pub(super) fn leads_to(&self, node: usize, next: usize) -> bool {
        self.pointers[node] == next as u32 + 1
    }

    /// Whether `node` was never reached: to the comparisons, a closed node without a way.
    #[inline]
    pub(super) fn is_new(&self, node: usize) -> bool {
        self.pointers[node] == NONE && self.costs[node] == 0
    }
}
