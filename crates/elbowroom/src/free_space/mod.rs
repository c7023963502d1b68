//! Where the tip may stand: the free Cartesian space of the paper's section 4, as a map per posture over the
//! scene's grid.

mod arc;
mod block;
mod boundary;
mod fill;
mod map;
mod mark;
mod near;
mod place;
mod reason;
mod rule;
mod slices;
mod space;
mod stances;
mod state;
mod target;

pub use map::{FreeSpaceMap, Reasons};
pub(crate) use near::{ShortWays, cells_near_moved};
pub use place::{NotFree, configurations};
pub use reason::{Reason, reason_against};
pub use slices::Slices;
pub(crate) use slices::merged;
pub use space::{Cases, ChangedCells, FreeSpace};
pub use state::{CONTACT_FLOOR, CellState, state_of};
