use thiserror::Error;

use crate::geometry::{Point, Vector};

/// No vertex, no cell, no side.
pub(super) const NONE: u32 = u32::MAX;

/// How far ends of sides that are one may lie apart, as a share of the greatest coordinate: some roundings.
const ROUNDING: f64 = 1e-12;

/// Angles that differ by less than this (rad) count as equal, in favour of letting paths bend.
const ANGLE_ROUNDING: f64 = 1e-9;

/// What lies beyond a side of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Across {
    /// The neighbour.
    pub cell: usize,
    /// Which of its sides is this one.
    pub side: usize,
    /// By how much the neighbour's plane is moved against this one: zero within one plane.
    pub shift: Vector,
}

/// One side of a cell: from its point to that of the next side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// Where it begins.
    pub from: Point,
    /// What lies beyond; `None` for a wall.
    pub across: Option<Across>,
}

/// Cells between two questions whether to keep going.
const CELLS_PER_LOOK: usize = 4096;

/// Why cells make no mesh.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum MeshError {
    /// A cell has fewer than three sides, a coordinate that is no number, or does not turn left without limits.
    #[error("cell {cell} is not convex and counter-clockwise")]
    Shape {
        /// Which cell.
        cell: usize,
    },
    /// A side and the one said to lie beyond it are not the same line, or not each other's.
    #[error("side {side} of cell {cell} does not meet the side said to lie beyond it")]
    Seam {
        /// Which cell.
        cell: usize,
        /// Which of its sides.
        side: usize,
    },
    /// `keep_going` said no.
    #[error("stopped before the cells were joined")]
    Stopped,
    /// More sides than can be numbered.
    #[error("{sides} sides are more than can be numbered")]
    TooMany {
        /// How many.
        sides: usize,
    },
}

/// Convex cells joined along whole sides: a flat mesh with walls.
///
/// Each cell is a convex polygon, counter-clockwise in a plane of its own; sides that meet are equally long.
#[derive(Debug, Clone, PartialEq)]
pub struct NavigationMesh {
    pub(super) sides: Vec<Side>,
    /// Where in `sides` each cell begins; one more at the end.
    pub(super) begins: Vec<u32>,
    /// The vertex at which each side begins.
    pub(super) vertices: Vec<u32>,
    /// Whether a shortest path can bend at each vertex.
    pub(super) bends: Vec<bool>,
    /// How much lengths may be off by what was let pass as rounding.
    pub(super) rounding: f64,
}

impl NavigationMesh {
    /// The mesh of `cells`, joined as their sides say.
    ///
    /// # Errors
    /// [`MeshError`]
    pub fn new(cells: &[Vec<Side>]) -> Result<Self, MeshError> {
        Self::new_until(cells, &|| true)
    }

    /// [`NavigationMesh::new`], given up when `keep_going`, asked every few thousand cells, says no.
    ///
    /// # Errors
    /// [`MeshError`]
    pub(crate) fn new_until(cells: &[Vec<Side>], keep_going: &dyn Fn() -> bool) -> Result<Self, MeshError> {
        let total: usize = cells.iter().map(Vec::len).sum();
        if total >= NONE as usize {
            return Err(MeshError::TooMany { sides: total });
        }
        let mut begins = Vec::with_capacity(cells.len() + 1);
        let mut sides = Vec::with_capacity(total);
        for cell in cells {
            begins.push(sides.len() as u32);
            sides.extend_from_slice(cell);
        }
        begins.push(sides.len() as u32);
        let greatest = sides.iter().map(|side| side.from.x.abs().max(side.from.y.abs())).fold(0.0, f64::max);
        let mut mesh =
            Self { sides, begins, vertices: Vec::new(), bends: Vec::new(), rounding: ROUNDING * greatest };
        for cell in 0..cells.len() {
            if cell.is_multiple_of(CELLS_PER_LOOK) && !keep_going() {
                return Err(MeshError::Stopped);
            }
            mesh.check_shape(cell)?;
            mesh.check_seams(cell)?;
        }
        mesh.find_vertices(keep_going)?;
        Ok(mesh)
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.begins.len() - 1
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The sides of `cell`, counter-clockwise.
    pub fn sides(&self, cell: usize) -> &[Side] {
        &self.sides[self.begins[cell] as usize..self.begins[cell + 1] as usize]
    }

    /// Whether each cell can be reached from one of `cells`.
    pub fn reached_from(&self, cells: impl IntoIterator<Item = usize>) -> Vec<bool> {
        let mut reached = vec![false; self.len()];
        let mut waiting: Vec<usize> = cells.into_iter().collect();
        while let Some(cell) = waiting.pop() {
            if !std::mem::replace(&mut reached[cell], true) {
                waiting
                    .extend(self.sides(cell).iter().filter_map(|side| side.across).map(|across| across.cell));
            }
        }
        reached
    }

    /// Whether `point`, in the plane of `cell`, lies in the cell or on its boundary, rounding included.
    pub fn holds(&self, cell: usize, point: Point) -> bool {
        let sides = self.sides(cell);
        (0..sides.len()).all(|i| {
            let (a, b) = (sides[i].from, sides[(i + 1) % sides.len()].from);
            let along = b - a;
            along.cross(point - a) >= -self.rounding * along.length()
        })
    }

    /// The side after `side` of the same cell, all sides numbered.
    pub(super) fn next(&self, cell: usize, side: usize) -> usize {
        if side + 1 == self.begins[cell + 1] as usize { self.begins[cell] as usize } else { side + 1 }
    }

    fn check_shape(&self, cell: usize) -> Result<(), MeshError> {
        let sides = self.sides(cell);
        let n = sides.len();
        let point = |i: usize| sides[i % n].from;
        let mut turned = 0.0;
        let mut sound = n >= 3 && sides.iter().all(|side| side.from.is_finite());
        for i in 0..n {
            let (along, next) = (point(i + 1) - point(i), point(i + 2) - point(i + 1));
            let turn = along.cross(next);
            sound &= turn >= -self.rounding * (along.length() + next.length()) && along.length() > 0.0;
            turned += libm::atan2(turn, along.dot(next));
        }
        // Once round, not twice.
        sound &= (turned - std::f64::consts::TAU).abs() < 1e-3;
        if sound { Ok(()) } else { Err(MeshError::Shape { cell }) }
    }

    fn check_seams(&self, cell: usize) -> Result<(), MeshError> {
        let sides = self.sides(cell);
        for (i, side) in sides.iter().enumerate() {
            let Some(across) = side.across else { continue };
            let other = (across.cell < self.len()).then(|| self.sides(across.cell));
            let back = other.and_then(|other| other.get(across.side)?.across);
            let (Some(other), Some(back)) = (other, back) else {
                return Err(MeshError::Seam { cell, side: i });
            };
            let (a, b) = (side.from, sides[(i + 1) % sides.len()].from);
            let (c, d) = (other[across.side].from, other[(across.side + 1) % other.len()].from);
            let apart = (a + across.shift)
                .distance(d)
                .max((b + across.shift).distance(c))
                .max((across.shift + back.shift).length());
            if !(back.cell == cell && back.side == i && apart <= self.rounding) {
                return Err(MeshError::Seam { cell, side: i });
            }
        }
        Ok(())
    }

    /// Which sides begin at one vertex, and where a path can bend: where the walls leave more than half a revolution, or
    /// cells without walls more than a whole one.
    fn find_vertices(&mut self, keep_going: &dyn Fn() -> bool) -> Result<(), MeshError> {
        let look = |cell: usize| {
            let stopped = cell.is_multiple_of(CELLS_PER_LOOK) && !keep_going();
            if stopped { Err(MeshError::Stopped) } else { Ok(()) }
        };
        let mut joined = Joined::new(self.sides.len());
        let mut at_wall = vec![false; self.sides.len()];
        for cell in 0..self.len() {
            look(cell)?;
            let begin = self.begins[cell] as usize;
            for side in begin..self.begins[cell + 1] as usize {
                let next = self.next(cell, side);
                let Some(Across { cell: there, side: across, .. }) = self.sides[side].across else {
                    at_wall[side] = true;
                    at_wall[next] = true;
                    continue;
                };
                let across = self.begins[there] as usize + across;
                let across_next = self.next(there, across);
                joined.join(side, across_next);
                joined.join(next, across);
            }
        }
        let mut angles = vec![0.0; self.sides.len()];
        let mut walls = vec![false; self.sides.len()];
        self.vertices = (0..self.sides.len()).map(|side| joined.first(side) as u32).collect();
        for cell in 0..self.len() {
            look(cell)?;
            let sides = self.sides(cell);
            let n = sides.len();
            for (i, side) in (self.begins[cell] as usize..).take(n).enumerate() {
                let vertex = self.vertices[side] as usize;
                let (before, here, after) =
                    (sides[(i + n - 1) % n].from, sides[i].from, sides[(i + 1) % n].from);
                let (out, back) = (after - here, before - here);
                let cross = out.cross(back);
                // Straight on is half a revolution, whatever the sign of its zero.
                angles[vertex] += libm::atan2(if cross > 0.0 { cross } else { 0.0 }, out.dot(back));
                walls[vertex] |= at_wall[side];
            }
        }
        let turn = std::f64::consts::PI;
        let bends = |vertex: usize| {
            let straight = if walls[vertex] { turn - ANGLE_ROUNDING } else { 2.0 * turn + ANGLE_ROUNDING };
            angles[vertex] > straight
        };
        self.bends = (0..self.sides.len()).map(bends).collect();
        Ok(())
    }
}

/// Sets of numbers that are one, each known by its least.
struct Joined(Vec<u32>);

impl Joined {
    fn new(len: usize) -> Self {
        Self((0..len as u32).collect())
    }

    fn first(&mut self, mut i: usize) -> usize {
        while self.0[i] as usize != i {
            self.0[i] = self.0[self.0[i] as usize];
            i = self.0[i] as usize;
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
