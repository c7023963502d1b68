//! How much a configuration is in contact: what orders candidates that may not be taken.

use crate::arm::{Arm, PlanarArm};
use crate::geometry::{Point, Segment};
use crate::scene::{Obstacle, Scene, Shape};

/// All that the arm of a scene must not touch, prepared for looking at it many times.
pub(super) struct Contacts<'a> {
    scene: &'a Scene<PlanarArm>,
    /// Clearance that counts as none (m).
    margin: f64,
    /// Around each obstacle a disc: centre and radius (m).
    discs: Vec<(Point, f64)>,
}

impl<'a> Contacts<'a> {
    pub(super) fn new(scene: &'a Scene<PlanarArm>, margin: f64) -> Self {
        Self { scene, margin, discs: scene.obstacles.iter().map(disc_around).collect() }
    }

    /// By how much links at `q` (rad) come nearer than the margin to what they must keep clear of, summed up over all that
    /// do (m); 0 where none does. It grows with the depth of every contact, so that there is always a way out.
    pub(super) fn violation(&self, q: &[f64]) -> f64 {
        let arm = &self.scene.arm;
        let links: Vec<Segment> = arm.link_segments(q).collect();
        let needed = self.margin + arm.half_width();
        let mut sum = 0.0;
        for (obstacle, (center, radius)) in self.scene.obstacles.iter().zip(&self.discs) {
            for link in &links {
                if link.distance_to_point(*center) - radius < needed {
                    sum += (needed - signed_distance(obstacle, *link)).max(0.0);
                }
            }
        }
        if arm.self_collision() {
            let needed = self.margin + 2.0 * arm.half_width();
            for (i, link) in links.iter().enumerate() {
                for other in links.iter().skip(i + 2) {
                    let distance = link.distance_to_segment(*other);
                    // Links that cross are as deep as their nearest end is from coming out.
                    let depth = if distance > 0.0 { 0.0 } else { nearest_end(*link, *other) };
                    sum += (needed - distance).max(0.0) + depth;
                }
            }
        }
        sum
    }
}

/// From the obstacle to the link, negative by the depth (m).
fn signed_distance(obstacle: &Obstacle, link: Segment) -> f64 {
    let distance = obstacle.distance_to_segment(link);
    if distance > 0.0 { distance } else { obstacle.signed_distance_to_segment(link) }
}

/// How far the nearest end of two links is from the other link (m).
fn nearest_end(a: Segment, b: Segment) -> f64 {
    let of =
        |link: Segment, other: Segment| link.distance_to_point(other.a).min(link.distance_to_point(other.b));
    of(a, b).min(of(b, a))
}

fn disc_around(obstacle: &Obstacle) -> (Point, f64) {
    match &obstacle.shape {
        Shape::Circle(circle) => (circle.center, circle.radius),
        Shape::Polygon(polygon) => {
            let corners = polygon.vertices();
            let ends = |of: fn(&Point) -> f64| {
                let values = || corners.iter().map(of);
                (values().fold(f64::INFINITY, f64::min) + values().fold(f64::NEG_INFINITY, f64::max)) / 2.0
            };
            let center = Point::new(ends(|p| p.x), ends(|p| p.y));
            (center, corners.iter().map(|p| p.distance(center)).fold(0.0, f64::max))
        }
    }
}
