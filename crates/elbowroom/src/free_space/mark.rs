use super::CellState;

/// The number that stands for a [`CellState`] in a map: 0 for free, and small where few obstacles are numbered.
pub(super) type Mark = u64;

/// Stands for a free place.
pub(super) const FREE: Mark = 0;

/// The number of `state`.
pub(super) fn mark_of(state: CellState) -> Mark {
    match state {
        CellState::Free => FREE,
        CellState::OutOfReach => 1,
        CellState::JointLimit { joint } => 1 + Mark::from(joint),
        CellState::Collision { link, obstacle } => 3 + Mark::from(link) + 2 * Mark::from(obstacle),
    }
}

/// The state that `mark` stands for.
pub(super) fn state_of_mark(mark: Mark) -> CellState {
    match mark {
        FREE => CellState::Free,
        1 => CellState::OutOfReach,
        2 | 3 => CellState::JointLimit { joint: mark as u8 - 1 },
        _ => CellState::Collision { link: (mark % 2) as u8 + 1, obstacle: ((mark - 4) / 2) as u16 },
    }
}

/// The marks of a map, in as few bytes each as the scene's obstacles need.
#[derive(Debug, Clone)]
pub(super) enum Marks {
    Bytes(Vec<u8>),
    Words(Vec<u32>),
}

/// What a mark is kept as.
pub(super) trait Kept: Copy + Send + PartialEq {
    /// `mark` cut to this size.
    fn cut(mark: Mark) -> Self;
}

impl Kept for u8 {
    fn cut(mark: Mark) -> Self {
        mark as Self
    }
}

impl Kept for u32 {
    fn cut(mark: Mark) -> Self {
        mark as Self
    }
}

/// Whether a byte is enough for every mark in a scene of so many obstacles.
fn fit_bytes(obstacles: usize) -> bool {
    let last = obstacles.saturating_sub(1).min(usize::from(u16::MAX)) as u16;
    mark_of(CellState::Collision { link: 2, obstacle: last }) <= Mark::from(u8::MAX)
}

impl Marks {
    /// `len` marks, all of free places.
    ///
    /// Zeros come from the system as such, unwritten: taking them costs no time, whatever their number.
    pub(super) fn free(len: usize, obstacles: usize) -> Self {
        if fit_bytes(obstacles) { Self::Bytes(vec![0; len]) } else { Self::Words(vec![0; len]) }
    }

    /// Makes room for the numbers of more obstacles, if need be.
    pub(super) fn make_room(&mut self, obstacles: usize) {
        if let Self::Bytes(marks) = self
            && !fit_bytes(obstacles)
        {
            *self = Self::Words(marks.iter().copied().map(u32::from).collect());
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::Bytes(marks) => marks.len(),
            Self::Words(marks) => marks.len(),
        }
    }

    pub(super) fn get(&self, cell: usize) -> Option<Mark> {
        match self {
            Self::Bytes(marks) => marks.get(cell).map(|&mark| Mark::from(mark)),
            Self::Words(marks) => marks.get(cell).map(|&mark| Mark::from(mark)),
        }
    }
}
