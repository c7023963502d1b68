use super::CellState;
use super::mark::{FREE, Marks, state_of_mark};
use crate::arm::Posture;

/// Where the tip may stand in one posture: a [`CellState`] for each point of the scene's grid.
#[derive(Debug, Clone)]
pub struct FreeSpaceMap {
    posture: Posture,
    marks: Marks,
}

/// How many points of a map are in each state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Reasons {
    /// Free ones.
    pub free: usize,
    /// Those out of reach.
    pub out_of_reach: usize,
    /// Those beyond a limit of each joint, base first.
    pub joint_limit: [usize; 2],
    /// Those at which each link collides, base first.
    pub collision: [usize; 2],
}

impl FreeSpaceMap {
    pub(super) fn new(posture: Posture, marks: Marks) -> Self {
        Self { posture, marks }
    }

    pub(super) fn marks_mut(&mut self) -> &mut Marks {
        &mut self.marks
    }

    /// The posture it holds for.
    pub fn posture(&self) -> Posture {
        self.posture
    }

    /// The state of `cell`; `None` beyond the grid.
    pub fn state(&self, cell: usize) -> Option<CellState> {
        self.marks.get(cell).map(state_of_mark)
    }

    /// The state of every cell of the grid, row after row.
    pub fn states(&self) -> impl ExactSizeIterator<Item = CellState> + '_ {
        (0..self.marks.len()).map(|cell| self.marks.get(cell).map_or(CellState::OutOfReach, state_of_mark))
    }

    /// Whether the tip may stand at `cell`; false beyond the grid.
    pub fn is_free(&self, cell: usize) -> bool {
        self.marks.get(cell) == Some(FREE)
    }

    /// How many points are in each state.
    pub fn reasons(&self) -> Reasons {
        let mut reasons = Reasons::default();
        for state in self.states() {
            match state {
                CellState::Free => reasons.free += 1,
                CellState::OutOfReach => reasons.out_of_reach += 1,
                CellState::JointLimit { joint } => reasons.joint_limit[usize::from(joint) - 1] += 1,
                CellState::Collision { link, .. } => reasons.collision[usize::from(link) - 1] += 1,
            }
        }
        reasons
    }
}

impl PartialEq for FreeSpaceMap {
    fn eq(&self, other: &Self) -> bool {
        self.posture == other.posture && self.states().eq(other.states())
    }
}

impl Eq for FreeSpaceMap {}
