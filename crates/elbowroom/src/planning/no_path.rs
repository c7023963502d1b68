use thiserror::Error;

/// The proof that no motion does a task: what can be reached from the start lies within cells whose walls are
/// forbidden all along, and no goal lies there.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("no path: proved, obstacles and joint limits separate start and goal in configuration space")]
pub struct NoPath {
    /// Corners of convex cells that hold all configurations that can be reached (rad), each counter-clockwise.
    pub reachable: Vec<Vec<[f64; 2]>>,
    /// The configurations it may start from (rad).
    pub starts: Vec<[f64; 2]>,
    /// Those that would do as a goal (rad).
    pub goals: Vec<[f64; 2]>,
}
