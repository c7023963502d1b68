/// What a search by evaluations took.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Effort {
    /// How many candidates were judged.
    pub evaluations: usize,
    /// Evaluations made, and the cost of the best feasible candidate by then, each time that fell.
    pub convergence: Vec<(usize, f64)>,
}
