use std::f64::consts::{PI, TAU};

use super::connect::{ConnectedCells, Stretch, connect};
use super::slabs::{Approximation, Cutter};
use crate::arm::JointLimits;
use crate::free_space::Slices;
use crate::geometry::{Point, wrap_angle};
use crate::mesh::MeshPoint;
use crate::scene::TwoLinkScene;

/// How wide the slabs are that are begun with (rad).
const WIDEST: f64 = 0.06;

/// The plane of both joints, x the first and y the second (rad), as a mesh of what is open.
pub(crate) struct JointSpaceCells {
    pub(crate) connected: ConnectedCells,
    rounds: [bool; 2],
}

/// Where the second joint may be (rad) for each of `starts`: within its limits and, where the posture is to be kept,
/// between full stretch and fold.
pub(crate) fn branch_ranges(
    scene: TwoLinkScene<'_>,
    starts: &[[f64; 2]],
    keep_posture: bool,
) -> Vec<[f64; 2]> {
    let [low, high] = second_range(scene);
    if !keep_posture {
        return vec![[low, high]];
    }
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for start in starts {
        let round = scene.arm().joints()[1].limits == JointLimits::Continuous;
        let angle = if round { wrap_angle(start[1]) } else { start[1] };
        let half_turn = (angle / PI).floor();
        let branches =
            if angle == half_turn * PI { vec![half_turn - 1.0, half_turn] } else { vec![half_turn] };
        for branch in branches {
            let range = [(branch * PI).max(low), ((branch + 1.0) * PI).min(high)];
            if range[0] < range[1] && !ranges.contains(&range) {
                ranges.push(range);
            }
        }
    }
    ranges
}

fn second_range(scene: TwoLinkScene<'_>) -> [f64; 2] {
    match scene.arm().joints()[1].limits {
        JointLimits::Continuous => [-PI, PI],
        JointLimits::Range { min, max } => [min, max],
    }
}

impl JointSpaceCells {
    /// The cells of `scene` with links that stay `margin` (m) clear and the second joint within `range` (rad); `None`
    /// where `keep_going` said no, or there are more cells than can be numbered.
    pub(crate) fn new(
        scene: TwoLinkScene<'_>,
        margin: f64,
        range: [f64; 2],
        approximation: Approximation,
        keep_going: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let slices = Slices::new(scene, margin);
        let forbidden = |x: f64| slices.second_joint(x, range);
        let cutter = Cutter { forbidden: &forbidden, approximation, range, widest: WIDEST, keep_going };
        let rounds = [
            scene.arm().joints()[0].limits == JointLimits::Continuous,
            scene.arm().joints()[1].limits == JointLimits::Continuous && range == [-PI, PI],
        ];
        let mut stretches = Vec::new();
        for (ends, round) in open_stretches(scene, &slices, approximation) {
            stretches.push(Stretch { slabs: cutter.slabs(ends[0], ends[1])?, round });
        }
        Some(Self { connected: connect(stretches, range, rounds[1], keep_going)?, rounds })
    }

    /// Where `q` is on the mesh, if it is in the open.
    pub(crate) fn place(&self, q: &[f64; 2]) -> Option<MeshPoint> {
        let y = if self.rounds[1] { wrap_angle(q[1]) } else { q[1] };
        let turns = if self.rounds[0] { -1..=1 } else { 0..=0 };
        let first = if self.rounds[0] { wrap_angle(q[0]) } else { q[0] };
        let mut turned = turns.map(|turn| Point::new(first + TAU * f64::from(turn), y));
        turned.find_map(|point| self.connected.place(point))
    }
}

/// Stretches of the first joint (rad) in which the first link touches nothing, and whether one goes all round.
fn open_stretches(
    scene: TwoLinkScene<'_>,
    slices: &Slices<'_>,
    approximation: Approximation,
) -> Vec<([f64; 2], bool)> {
    let limits = scene.arm().joints()[0].limits;
    let [low, high] = match limits {
        JointLimits::Continuous => [-PI, PI],
        JointLimits::Range { min, max } => [min, max],
    };
    let mut from = low;
    let mut open: Vec<[f64; 2]> = Vec::new();
    for [start, end] in slices.first_joint([low, high]) {
        let shift = if approximation.is_inner {
            approximation.distance.min((end - start) / 4.0)
        } else {
            -approximation.distance
        };
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
