//! How much a configuration is in contact: what orders candidates that may not be taken.

use smallvec::SmallVec;

use crate::geometry::{Point, Segment};
use crate::scene::Scene;

/// What a configuration is like.
pub(crate) struct Look {
    /// See [`Penetration::violation`].
    pub(crate) violation: f64,
    /// As long as no point of the arm moves farther than this (m), the violation stays 0; not above 0 where it is not.
    pub(crate) gap: f64,
}

/// All that the arm of a scene must not touch, prepared for looking at it many times.
pub(crate) struct Penetration<'a> {
    scene: &'a Scene,
    /// Clearance that counts as none (m).
    margin: f64,
    /// Around each obstacle a disc: centre and radius (m).
    discs: Vec<(Point, f64)>,
}

impl<'a> Penetration<'a> {
    pub(crate) fn new(scene: &'a Scene, margin: f64) -> Self {
        let discs = scene.obstacles().iter().map(|obstacle| obstacle.shape.bounding_circle());
        Self { scene, margin, discs: discs.collect() }
    }

    /// By how much links at `q` (rad) come nearer than the margin to what they must keep clear of, summed up over all that
    /// do (m); 0 where none does. It grows with the depth of every contact, so that there is always a way out.
    pub(crate) fn violation(&self, q: &[f64]) -> f64 {
        self.look(q).violation
    }

    /// The violation at `q` (rad), and how far it is from there to the next.
    pub(crate) fn look(&self, q: &[f64]) -> Look {
        let arm = self.scene.arm();
        // Filled where it stands: to collect it would copy it.
        let mut links: SmallVec<[Segment; 8]> = SmallVec::new();
        for link in arm.link_segments(q) {
            links.push(link);
        }
        let needed = self.margin + arm.half_width();
        let mut look = Look { violation: 0.0, gap: f64::INFINITY };
        for (index, (center, radius)) in self.discs.iter().enumerate() {
            for link in &links {
                let mut gap = link.distance_to_point(*center) - radius - needed;
                if gap < 0.0 {
                    let obstacle = &self.scene.obstacles()[index];
                    gap = obstacle.shape.signed_distance_within(*link, self.margin) - needed;
                    look.violation += (-gap).max(0.0);
                }
                look.gap = look.gap.min(gap);
            }
        }
        if arm.self_collision() {
            let needed = self.margin + 2.0 * arm.half_width();
            for (i, link) in links.iter().enumerate() {
                for other in links.iter().skip(i + 2) {
                    let distance = link.distance_to_segment(*other);
                    // Links that cross are as deep as their nearest end is from coming out.
                    let depth = if distance > 0.0 { 0.0 } else { nearest_end(*link, *other) };
                    look.violation += (needed - distance).max(0.0) + depth;
                    // Both may move.
                    look.gap = look.gap.min((distance - needed) / 2.0);
                }
            }
        }
        look
    }
}

/// How far the nearest end of two links is from the other link (m).
fn nearest_end(a: Segment, b: Segment) -> f64 {
    let of =
        |link: Segment, other: Segment| link.distance_to_point(other.a).min(link.distance_to_point(other.b));
    of(a, b).min(of(b, a))
}
