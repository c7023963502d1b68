use std::f64::consts::{PI, TAU};

use super::sew::{Opening, Sewn, Stretch, sew};
use super::slabs::{Cutter, Slab, Walls};
use crate::arm::{Configuration, JointLimits};
use crate::free_space::Slices;
use crate::geometry::{Point, wrap_angle};
use crate::scene::Scene;
use crate::surface::{Surface, SurfacePlace};

/// How far beyond a cell a place counts as in it (rad): rounding.
const ROUNDING: f64 = 1e-12;

/// The plane of both joints, x the first and y the second (rad), as a surface of what is open.
pub(crate) struct JointChart {
    pub(crate) surface: Surface,
    slabs: Vec<Slab>,
    openings: Vec<Vec<Opening>>,
    /// The first cell of each slab.
    first_cells: Vec<usize>,
    rounds: [bool; 2],
}

/// Where the second joint may be (rad) for each of `starts`: within its stops and, where the posture is to be kept,
/// between full stretch and fold.
pub(crate) fn sheet_ranges(scene: &Scene, starts: &[Configuration<2>], may_flip: bool) -> Vec<[f64; 2]> {
    let [low, high] = second_range(scene);
    if may_flip {
        return vec![[low, high]];
    }
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for start in starts {
        let round = scene.arm.joints()[1].limits == JointLimits::Continuous;
        let angle = if round { wrap_angle(start.0[1]) } else { start.0[1] };
        let half_turn = (angle / PI).floor();
        let sheets = if angle == half_turn * PI { vec![half_turn - 1.0, half_turn] } else { vec![half_turn] };
        for sheet in sheets {
            let range = [(sheet * PI).max(low), ((sheet + 1.0) * PI).min(high)];
            if range[0] < range[1] && !ranges.contains(&range) {
                ranges.push(range);
            }
        }
    }
    ranges
}

fn second_range(scene: &Scene) -> [f64; 2] {
    match scene.arm.joints()[1].limits {
        JointLimits::Continuous => [-PI, PI],
        JointLimits::Range { min, max } => [min, max],
    }
}

impl JointChart {
    /// The chart of `scene` with links that stay `margin` (m) clear and the second joint within `range` (rad); `None`
    /// where `keep_going` said no, or there are more cells than can be numbered.
    pub(crate) fn new(
        scene: &Scene,
        margin: f64,
        range: [f64; 2],
        walls: Walls,
        keep_going: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let slices = Slices::new(scene, margin);
        let cutter = Cutter { slices: &slices, walls, range };
        let rounds = [
            scene.arm.joints()[0].limits == JointLimits::Continuous,
            scene.arm.joints()[1].limits == JointLimits::Continuous && range == [-PI, PI],
        ];
        let mut stretches = Vec::new();
        for (ends, round) in open_stretches(scene, &slices, walls) {
            if !keep_going() {
                return None;
            }
            stretches.push(Stretch { slabs: cutter.slabs(ends[0], ends[1]), round });
        }
        let Sewn { openings, surface } = sew(&stretches, range, rounds[1]).ok()?;
        let mut first_cells = Vec::with_capacity(openings.len());
        let mut count = 0;
        for opening in &openings {
            first_cells.push(count);
            count += opening.len();
        }
        let slabs = stretches.into_iter().flat_map(|stretch| stretch.slabs).collect();
        Some(Self { surface, slabs, openings, first_cells, rounds })
    }

    /// Where `q` is on the surface, if it is in the open.
    pub(crate) fn place(&self, q: &Configuration<2>) -> Option<SurfacePlace> {
        let y = if self.rounds[1] { wrap_angle(q.0[1]) } else { q.0[1] };
        let turns = if self.rounds[0] { -1..=1 } else { 0..=0 };
        let first = if self.rounds[0] { wrap_angle(q.0[0]) } else { q.0[0] };
        for x in turns.map(|turn| first + TAU * f64::from(turn)) {
            // Slabs lie in order; a place between two of them is in either.
            let after = self.slabs.partition_point(|slab| slab.x[0] <= x);
            for slab in [after.checked_sub(1), after.checked_sub(2)].into_iter().flatten() {
                let [x0, x1] = self.slabs[slab].x;
                let share = (x - x0) / (x1 - x0);
                if !(-ROUNDING..=1.0 + ROUNDING).contains(&share) {
                    continue;
                }
                let holds = |open: &Opening| {
                    let at = |i: usize| open.left[i] + (open.right[i] - open.left[i]) * share;
                    (at(0) - ROUNDING..=at(1) + ROUNDING).contains(&y)
                };
                if let Some(i) = self.openings[slab].iter().position(holds) {
                    return Some(SurfacePlace { cell: self.first_cells[slab] + i, point: Point::new(x, y) });
                }
            }
        }
        None
    }
}

/// Stretches of the first joint (rad) in which the first link touches nothing, and whether one goes all round.
fn open_stretches(scene: &Scene, slices: &Slices<'_>, walls: Walls) -> Vec<([f64; 2], bool)> {
    let limits = scene.arm.joints()[0].limits;
    let [low, high] = match limits {
        JointLimits::Continuous => [-PI, PI],
        JointLimits::Range { min, max } => [min, max],
    };
    let mut from = low;
    let mut open: Vec<[f64; 2]> = Vec::new();
    for [start, end] in slices.first_joint([low, high]) {
        let shift = if walls.inside { walls.distance.min((end - start) / 4.0) } else { -walls.distance };
        // At the ends of the range the stop is the wall, or the obstacle goes on beyond.
        let start = if start <= low { low } else { start + shift };
        let end = if end >= high { high } else { end - shift };
        if start > from {
            open.push([from, start]);
        }
        from = from.max(end);
    }
    if high > from {
        open.push([from, high]);
    }
    if limits == JointLimits::Continuous {
        match *open.as_slice() {
            [whole] if whole == [low, high] => return vec![(whole, true)],
            [first, .., last] if first[0] == low && last[1] == high => {
                open.remove(0);
                let across = open.len() - 1;
                open[across][1] = first[1] + TAU;
            }
            _ => {}
        }
    }
    open.into_iter().map(|ends| (ends, false)).collect()
}
