use std::fmt;

use crate::units::{Told, Units};

/// The proof that no motion does a task: what can be reached from the start lies within cells whose walls are
/// forbidden all along, and no goal lies there.
#[derive(Debug, Clone, PartialEq)]
pub struct NoPath {
    /// Corners of convex cells that hold all configurations that can be reached (rad), each counter-clockwise.
    pub reachable: Vec<Vec<[f64; 2]>>,
    /// The configurations it may start from (rad).
    pub starts: Vec<[f64; 2]>,
    /// Those that would do as a goal (rad).
    pub goals: Vec<[f64; 2]>,
    /// The clearance that was to be kept (m): nearer than that counts as contact.
    pub clearance: f64,
}

impl std::error::Error for NoPath {}

impl fmt::Display for NoPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Units::SI))
    }
}

impl Told for NoPath {
    fn told(&self, units: Units) -> String {
        let kept = match self.clearance {
            0.0 => String::new(),
            clearance => format!(" with a clearance of {}", units.stated_length(clearance)),
        };
        format!(
            "no path{kept}: proved, obstacles and joint limits separate start and goal in configuration space"
        )
    }
}
