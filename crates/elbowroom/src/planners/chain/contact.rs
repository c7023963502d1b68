//! How much a configuration is in contact: what orders candidates that may not be taken.

use crate::arm::Arm;
use crate::geometry::Segment;
use crate::scene::Scene;

/// By how much links at `q` (rad) come nearer than `margin` (m) to what they must keep clear of, summed up over all that
/// do (m); 0 where none does. It grows with the depth of every contact, so that there is always a way out.
pub(super) fn violation<A: Arm>(scene: &Scene<A>, q: &[f64], margin: f64) -> f64 {
    let width = scene.arm.half_width();
    let links: Vec<Segment> = scene.arm.link_segments(q).collect();
    let mut sum = 0.0;
    for link in &links {
        for obstacle in &scene.obstacles {
            let mut distance = obstacle.distance_to_segment(*link);
            if distance <= 0.0 {
                distance = obstacle.signed_distance_to_segment(*link);
            }
            sum += (margin + width - distance).max(0.0);
        }
    }
    if scene.arm.self_collision() {
        for (i, link) in links.iter().enumerate() {
            for other in links.iter().skip(i + 2) {
                let distance = link.distance_to_segment(*other);
                sum += (margin + 2.0 * width - distance).max(0.0);
                if distance == 0.0 {
                    sum += depth(*link, *other);
                }
            }
        }
    }
    sum
}

/// How far the nearest end of two links that cross is from the other link (m).
fn depth(a: Segment, b: Segment) -> f64 {
    let ends = [
        b.distance_to_point(a.a),
        b.distance_to_point(a.b),
        a.distance_to_point(b.a),
        a.distance_to_point(b.b),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}
