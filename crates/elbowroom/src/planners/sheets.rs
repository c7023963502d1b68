use crate::arm::{Configuration, JointLimits, Posture, TwoLinkArm};
use crate::free_space::FreeSpace;
use crate::geometry::angle_difference;
use crate::grid::Grid;

/// Rounding in the count of turns: a range of exactly one turn has one sheet, not two.
const TURN_ROUNDING: f64 = 1e-9;

/// The free configurations over the grid, laid out in sheets: over one sheet the configuration moves
/// continuously with the tip. There is one per posture, and more where a joint with stops can turn more
/// than once round.
pub(crate) struct Sheets {
    cells: usize,
    per_posture: usize,
    configurations: Vec<Option<Configuration<2>>>,
}

impl Sheets {
    pub(crate) fn new(arm: &TwoLinkArm, grid: &Grid, space: &FreeSpace) -> Self {
        let per_posture: usize = arm.joints().iter().map(|joint| turns(&joint.limits)).product();
        let cells = grid.len();
        let mut configurations = vec![None; 2 * per_posture * cells];
        for posture in Posture::ALL {
            let map = space.map(posture);
            for cell in (0..cells).filter(|&cell| map.is_free(cell)) {
                let found = arm.inverse(grid.point(cell), posture).unwrap_or_default();
                for (turn, q) in found.into_iter().take(per_posture).enumerate() {
                    configurations[(posture.index() * per_posture + turn) * cells + cell] = Some(q);
                }
            }
        }
        Self { cells, per_posture, configurations }
    }

    /// How many nodes there are: every sheet has one over every cell, free or not.
    pub(crate) fn len(&self) -> usize {
        self.configurations.len()
    }

    /// The cell under `node`.
    pub(crate) fn cell(&self, node: usize) -> usize {
        node % self.cells
    }

    /// The nodes over `cell`, one per sheet.
    pub(crate) fn over(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        (cell..self.configurations.len()).step_by(self.cells)
    }

    /// Whether two nodes lie on one sheet.
    pub(crate) fn same_sheet(&self, a: usize, b: usize) -> bool {
        a / self.cells == b / self.cells
    }

    /// Whether two nodes have one posture, whatever their turns.
    pub(crate) fn same_posture(&self, a: usize, b: usize) -> bool {
        let nodes = self.cells * self.per_posture;
        a / nodes == b / nodes
    }

    /// The configuration at `node` if it is free.
    pub(crate) fn configuration(&self, node: usize) -> Option<&Configuration<2>> {
        self.configurations[node].as_ref()
    }
}

/// How many sheets a joint needs for one direction of its link.
fn turns(limits: &JointLimits) -> usize {
    match *limits {
        JointLimits::Continuous => 1,
        JointLimits::Range { min, max } => {
            (((max - min) / std::f64::consts::TAU - TURN_ROUNDING).ceil() as usize).max(1)
        }
    }
}

/// The configuration that `to` is when the joints turn there from `from` directly: a continuous joint the
/// short way, with its turns counted; one with stops by the plain difference. `None` when a joint would
/// turn by more than half a turn, which no single step of a path does.
pub(crate) fn direct(
    arm: &TwoLinkArm,
    from: &Configuration<2>,
    to: &Configuration<2>,
) -> Option<Configuration<2>> {
    let steps: [f64; 2] = std::array::from_fn(|j| match arm.joints()[j].limits {
        JointLimits::Continuous => angle_difference(from.0[j], to.0[j]),
        JointLimits::Range { .. } => to.0[j] - from.0[j],
    });
    let short = steps.iter().all(|step| step.abs() <= std::f64::consts::PI);
    short.then(|| Configuration(std::array::from_fn(|j| from.0[j] + steps[j])))
}
