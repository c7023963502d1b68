//! The obstacles nearest to the arm, for many configurations.

use crate::geometry::{Point, Segment};
use crate::path::CERTIFIED_CLEARANCE;
use crate::scene::TwoLinkScene;

/// Clearances of each link beyond what is to be kept (m), rounded down: from the obstacle nearest to it, and from all
/// others.
#[derive(Debug, Clone, Copy)]
pub(super) struct CachedClearance {
    obstacle: [u16; 2],
    clearance: [f32; 2],
    others: [f32; 2],
}

impl CachedClearance {
    /// Whether the clearances here and at `other` are enough for links whose points move no farther than `bounds` (m)
    /// between the two.
    pub(super) fn are_enough_with(&self, other: &Self, bounds: [f64; 2]) -> bool {
        (0..2).all(|link| sum(self.clearance[link], other.clearance[link]) > bounds[link])
    }

    /// The obstacles for which they may not be enough, if that is plain for all others; an obstacle may come twice.
    pub(super) fn suspects(&self, other: &Self, bounds: [f64; 2]) -> Option<impl Iterator<Item = usize>> {
        let others_are_clear = |link: usize| sum(self.others[link], other.others[link]) > bounds[link];
        if !(0..2).all(others_are_clear) {
            return None;
        }
        let near = [self.obstacle[0], self.obstacle[1], other.obstacle[0], other.obstacle[1]];
        let link_is_clear =
            [0, 1].map(|link| sum(self.clearance[link], other.clearance[link]) > bounds[link]);
        let suspects = (0..4).filter(move |&i| {
            // Of equal ones the first will do.
            !link_is_clear[i % 2] && !(0..i).any(|j| !link_is_clear[j % 2] && near[j] == near[i])
        });
        Some(suspects.map(move |i| usize::from(near[i])))
    }
}

fn sum(here: f32, there: f32) -> f64 {
    f64::from(here) + f64::from(there)
}

/// The obstacles of a scene, made ready for many looks.
pub(super) struct Obstacles<'a> {
    scene: TwoLinkScene<'a>,
    discs: Vec<(u16, Disc)>,
    others: Vec<u16>,
}

#[derive(Clone, Copy)]
struct Disc {
    center: Point,
    radius: f64,
}

impl<'a> Obstacles<'a> {
    pub(super) fn of(scene: TwoLinkScene<'a>) -> Self {
        let (mut discs, mut others) = (Vec::new(), Vec::new());
        for (index, obstacle) in (0..=u16::MAX).zip(scene.obstacles()) {
            match *obstacle.shape.vertices() {
                [center] => discs.push((index, Disc { center, radius: obstacle.shape.radius() })),
                _ => others.push(index),
            }
        }
        Self { scene, discs, others }
    }

    /// What is nearest to the arm at `q`.
    pub(super) fn nearest_to(&self, q: &[f64; 2]) -> CachedClearance {
        let cache = self.scene.arm().half_width() + CERTIFIED_CLEARANCE;
        let mut nearest =
            CachedClearance { obstacle: [0; 2], clearance: [f32::INFINITY; 2], others: [f32::INFINITY; 2] };
        for (link, segment) in self.scene.arm().link_segments(q).into_iter().enumerate() {
            let (mut first, mut second, mut obstacle) = (f64::INFINITY, f64::INFINITY, 0);
            let mut look = |index: u16, distance: f64| {
                if distance < first {
                    (second, first, obstacle) = (first, distance, index);
                } else if distance < second {
                    second = distance;
                }
            };
            let to_disc = distance_to_discs(segment);
            self.discs.iter().for_each(|(index, disc)| look(*index, to_disc(disc)));
            for &index in &self.others {
                look(index, self.scene.obstacles()[usize::from(index)].distance_to_segment(segment));
            }
            nearest.obstacle[link] = obstacle;
            nearest.clearance[link] = ((first - cache) as f32).next_down();
            nearest.others[link] = ((second - cache) as f32).next_down();
        }
        nearest
    }
}

/// Signed distances from `segment` (m), as exact as `Shape::distance_to_segment`, without its division.
fn distance_to_discs(segment: Segment) -> impl Fn(&Disc) -> f64 {
    let along = segment.b - segment.a;
    let squared = along.length_squared();
    let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
    move |disc| {
        let share = ((disc.center - segment.a).dot(along) * inverse).clamp(0.0, 1.0);
        (disc.center - (segment.a + along * share)).length_squared().sqrt() - disc.radius
    }
}
