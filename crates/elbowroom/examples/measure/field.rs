use elbowroom::search::{Dstar, GoalError, Graph, Progress, Until};
use serde_json::json;

use super::lattice::Lattice;
use super::{Outcome, runs};

/// D*'s cost-to-go of every cell from scratch.
pub(crate) fn from_scratch(cells: &Lattice, goal: usize) -> Result<Dstar, GoalError> {
    let mut field = Dstar::new(cells.len());
    field.insert_goal(goal, 0.0)?;
    let progress = field.expand(cells, Until::WholeField, usize::MAX);
    debug_assert_eq!(progress, Progress::Done);
    Ok(field)
}

/// The cost-to-go over a mask of a byte a point, 1 for free; writes it as little-endian doubles, in steps.
pub(crate) fn measure(mask: &str, side: usize, goal: usize, runs: usize, out: &str) -> Outcome {
    let free = std::fs::read(mask)?.into_iter().map(|byte| byte == 1).collect();
    let cells = Lattice::new(side, 1.0, free);
    let (times, field) = runs::times(runs, || from_scratch(&cells, goal));
    let field = field?.field();
    if out != "-" {
        std::fs::write(out, field.iter().flat_map(|cost| cost.to_le_bytes()).collect::<Vec<u8>>())?;
    }
    Ok(json!({ "times_ms": times }))
}
