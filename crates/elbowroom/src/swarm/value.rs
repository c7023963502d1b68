//! What a swarm minimises: a number, or a number under constraints.

/// The value of an objective.
pub trait Value: Copy {
    /// No value is worse.
    const WORST: Self;

    /// Whether it is better than `other`; what is not a number is never better.
    fn is_better(self, other: Self) -> bool;
}

impl Value for f64 {
    const WORST: Self = Self::INFINITY;

    #[inline]
    fn is_better(self, other: Self) -> bool {
        self < other
    }
}

/// A cost under constraints: any feasible candidate beats any that is not, feasible ones go by their cost, the others
/// by how much they violate the constraints. What is not a number counts as infinite.
///
/// # Reference
/// Deb, *An efficient constraint handling method for genetic algorithms*, CMAME 186(2-4), 2000.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fitness {
    /// By how much the constraints are violated; 0 or less when they are kept.
    pub violation: f64,
    /// What is minimised among feasible candidates.
    pub cost: f64,
}

impl Fitness {
    /// Whether the constraints are kept.
    pub fn is_feasible(self) -> bool {
        self.violation <= 0.0
    }
}

impl Value for Fitness {
    const WORST: Self = Self { violation: f64::INFINITY, cost: f64::INFINITY };

    fn is_better(self, other: Self) -> bool {
        match (self.is_feasible(), other.is_feasible()) {
            (true, true) => self.cost < other.cost || (other.cost.is_nan() && self.cost < f64::INFINITY),
            (true, false) => true,
            (false, true) => false,
            (false, false) => {
                self.violation < other.violation
                    || (other.violation.is_nan() && self.violation < f64::INFINITY)
            }
        }
    }
}
