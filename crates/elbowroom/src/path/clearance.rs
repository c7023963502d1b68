use smallvec::SmallVec;

use crate::arm::Arm;
use crate::geometry::Segment;
use crate::scene::Scene;

/// Least clearance that a certified move keeps (m): twice the verifier's floor, so that what is certified here is not
/// refused there for a rounding.
pub const CERTIFIED_CLEARANCE: f64 = 2e-9;

/// Clearance of each link at `q` (rad) from the nearest obstacle (m), base first; 0 or less in contact, infinite without
/// obstacles. One that moves counts where the scene has it.
///
/// # Panics
/// Unless `q` has a position for each joint.
pub fn link_clearances(scene: &Scene, q: &[f64]) -> SmallVec<[f64; 4]> {
    let half_width = scene.arm().half_width();
    let from_obstacles = |link: Segment| {
        let distances = scene.obstacles().iter().map(|obstacle| obstacle.distance_to_segment(link));
        distances.fold(f64::INFINITY, f64::min) - half_width
    };
    scene.arm().link_segments(q).map(from_obstacles).collect()
}

/// Least clearance at `q` (rad) between links that have to keep clear of each other (m); 0 or less in contact, infinite
/// where there are none.
///
/// # Panics
/// Unless `q` has a position for each joint.
pub fn self_clearance(scene: &Scene, q: &[f64]) -> f64 {
    let arm = scene.arm();
    let links = links_at(arm, q);
    let pairs = self_pairs(arm).map(|(a, b)| between(links[a], links[b], arm.half_width()));
    pairs.fold(f64::INFINITY, f64::min)
}

/// How far a point of each link can move (m), base first, while the joints turn evenly from `from` to `to` (rad).
pub fn motion_bounds(arm: &Arm, from: &[f64], to: &[f64]) -> SmallVec<[f64; 4]> {
    ways_of(arm.lengths(), from, to).collect()
}

/// How far a point of each of a chain of links can move (m), as seen from where the first begins.
pub(super) fn ways_of(lengths: &[f64], from: &[f64], to: &[f64]) -> impl Iterator<Item = f64> {
    lengths.iter().zip(from.iter().zip(to)).scan((0.0, 0.0), |(turn, way), (length, (from, to))| {
        *turn += to - from;
        *way += length * f64::abs(*turn);
        Some(*way)
    })
}

/// Links that are no neighbours, each pair once, where they have to keep clear.
fn self_pairs(arm: &Arm) -> impl Iterator<Item = (usize, usize)> {
    let links = if arm.self_collision() { arm.links() } else { 0 };
    (0..links).flat_map(move |a| (a + 2..links).map(move |b| (a, b)))
}

pub(super) type Links = SmallVec<[Segment; 8]>;

/// Centre lines of all links at `q` (rad).
pub(super) fn links_at(arm: &Arm, q: &[f64]) -> Links {
    arm.link_segments(q).collect()
}

/// Clearance between two links (m).
pub(super) fn between(a: Segment, b: Segment, half_width: f64) -> f64 {
    a.distance_to_segment(b) - 2.0 * half_width
}
