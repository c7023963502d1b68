//! Distances by another library.

use elbowroom::scene::Obstacle;
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query;
use parry2d_f64::shape::{Ball, Segment};

/// Distance from the obstacle to the segment from `a` to `b`: negative inside, by the depth in what is round.
pub(crate) fn distance(obstacle: &Obstacle, a: [f64; 2], b: [f64; 2]) -> f64 {
    let still = Pose::identity();
    let link = Segment::new(Vector::new(a[0], a[1]), Vector::new(b[0], b[1]));
    let (core, radius) = (obstacle.shape.vertices(), obstacle.shape.radius());
    if let [center] = core {
        // A dot in place of the disc: the library reports 0 inside, where the depth is wanted.
        let at = Pose::translation(center.x, center.y);
        return query::distance(&still, &link, &at, &Ball::new(0.0)).map_or(f64::NAN, |d| d.distance)
            - radius;
    }
    // Of a line between two points there and back, which goes round nothing.
    let edges = || (0..core.len()).map(|i| (core[i], core[(i + 1) % core.len()]));
    let winding: f64 = edges()
        .map(|(p, q)| {
            let (px, py, qx, qy) = (p.x - a[0], p.y - a[1], q.x - a[0], q.y - a[1]);
            (px * qy - py * qx).atan2(px * qx + py * qy)
        })
        .sum();
    let to_edges = edges()
        .map(|(p, q)| {
            let edge = Segment::new(Vector::new(p.x, p.y), Vector::new(q.x, q.y));
            query::distance(&still, &link, &still, &edge).map_or(f64::NAN, |d| d.distance)
        })
        .fold(f64::INFINITY, f64::min);
    if winding.abs() > std::f64::consts::PI || to_edges == 0.0 { -1.0 } else { to_edges - radius }
}
