//! How near the links are to what they must not touch, and how that changes with the joints.

use crate::geometry::{Point, Segment, Shape, Vector};
use crate::scene::Scene;

/// Core distances below this (m) are contact: directions between nearest points are lost in rounding.
const TOUCH: f64 = 1e-9;

/// One link near one obstacle, or near another link.
pub(super) struct SignedDistance {
    /// Between their surfaces (m), minus the depth where they meet.
    pub(super) distance: f64,
    /// How it changes with each joint (m/rad).
    pub(super) gradient: Vec<f64>,
}

/// Where two shapes are nearest, or deepest.
struct Nearest {
    distance: f64,
    /// From the other towards the link, of length 1.
    away: Vector,
    /// On the link.
    point: Point,
}

/// All that the arm of `scene` is nearer to than `near` (m) at `q` (rad).
pub(super) fn signed_distances(scene: &Scene, q: &[f64], near: f64) -> Vec<SignedDistance> {
    let arm = scene.arm();
    let links: Vec<Segment> = arm.link_segments(q).collect();
    let mut found = Vec::new();
    for obstacle in scene.obstacles() {
        let shape = &obstacle.shape;
        let (center, radius) = shape.bounding_circle();
        let needed = shape.radius() + arm.half_width();
        for (i, link) in links.iter().enumerate() {
            if link.distance_to_point(center) - radius - arm.half_width() > near {
                continue;
            }
            let nearest = nearest_to(shape, *link);
            if nearest.distance - needed <= near {
                let mut gradient = vec![0.0; links.len()];
                add(&mut gradient, &links[..=i], nearest.point, nearest.away);
                found.push(SignedDistance { distance: nearest.distance - needed, gradient });
            }
        }
    }
    if arm.self_collision() {
        let needed = 2.0 * arm.half_width();
        for i in 0..links.len() {
            for k in i + 2..links.len() {
                let (distance, on_i, on_k) = between(links[i], links[k]);
                if distance - needed > near {
                    continue;
                }
                let mut gradient = vec![0.0; links.len()];
                // No direction tells links apart that cross: a step that makes them do so is only as bad as it is.
                if distance > TOUCH {
                    let away = (on_k - on_i) * (1.0 / distance);
                    add(&mut gradient, &links[..=k], on_k, away);
                    add(&mut gradient, &links[..=i], on_i, -away);
                }
                found.push(SignedDistance { distance: distance - needed, gradient });
            }
        }
    }
    found
}

/// Adds how far `point`, which all joints before it turn, moves in direction `along` with each of them.
fn add(gradient: &mut [f64], links: &[Segment], point: Point, along: Vector) {
    for (slope, link) in gradient.iter_mut().zip(links) {
        let arm = point - link.a;
        *slope += Vector::new(-arm.y, arm.x).dot(along);
    }
}

/// Nearest points of two links; 0 apart where they meet.
fn between(a: Segment, b: Segment) -> (f64, Point, Point) {
    let pairs = [(a.a, b.nearest(a.a)), (a.b, b.nearest(a.b)), (a.nearest(b.a), b.a), (a.nearest(b.b), b.b)];
    let apart = |(p, q): &(Point, Point)| p.distance(*q);
    let nearest =
        pairs.iter().fold(pairs[0], |best, pair| if apart(pair) < apart(&best) { *pair } else { best });
    (if a.meets(b) { 0.0 } else { apart(&nearest) }, nearest.0, nearest.1)
}

/// Of the core of `shape` and a link's centre line.
fn nearest_to(shape: &Shape, link: Segment) -> Nearest {
    let apart = shape.distance_to_segment(link) + shape.radius();
    let vertices = shape.vertices().iter().map(|&vertex| (link.nearest(vertex), vertex));
    let ends =
        shape.edges().flat_map(|edge| [(link.a, edge.nearest(link.a)), (link.b, edge.nearest(link.b))]);
    let nearest = vertices
        .chain(ends)
        .map(|(on_link, on_core)| (on_link.distance(on_core), on_link, on_core))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    match nearest {
        Some((distance, point, on_core)) if apart > TOUCH && distance > TOUCH => {
            Nearest { distance, away: (point - on_core) * (1.0 / distance), point }
        }
        _ => deepest(shape, link),
    }
}

/// The direction in which link and core come apart the soonest, of those across an edge or across the link.
fn deepest(shape: &Shape, link: Segment) -> Nearest {
    let along = link.b - link.a;
    let across = Vector::new(-along.y, along.x) * (1.0 / along.length().max(TOUCH));
    let mut best = Nearest { distance: f64::NEG_INFINITY, away: across, point: link.a };
    let mut consider = |candidate: Nearest| {
        if candidate.distance > best.distance {
            best = candidate;
        }
    };
    for away in [across, -across] {
        // The core behind the link, as seen in this direction.
        let reach = |vertex: &&Point| (**vertex - link.a).dot(away);
        if let Some(vertex) = shape.vertices().iter().max_by(|a, b| reach(a).total_cmp(&reach(b))) {
            consider(Nearest { distance: -reach(&vertex), away, point: link.nearest(*vertex) });
        }
    }
    let corners = shape.vertices();
    let twice_area: f64 = shape.edges().map(|edge| (edge.a - corners[0]).cross(edge.b - corners[0])).sum();
    let turn = if twice_area < 0.0 { -1.0 } else { 1.0 };
    for edge in shape.edges().filter(|edge| edge.a.distance(edge.b) > TOUCH) {
        let side = edge.b - edge.a;
        let outward = Vector::new(side.y, -side.x) * (turn / side.length());
        let behind = |away: Vector, point: Point| (point - edge.a).dot(away);
        // A line has no inside: both its sides are out.
        let ways = if shape.has_inside() { vec![outward] } else { vec![outward, -outward] };
        for away in ways {
            let (at_a, at_b) = (behind(away, link.a), behind(away, link.b));
            let (distance, point) = if at_a < at_b { (at_a, link.a) } else { (at_b, link.b) };
            consider(Nearest { distance, away, point });
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arm::{Arm, Joint};
    use crate::grid::Grid;
    use crate::path::{link_clearances, self_clearance};
    use crate::random::unit;
    use crate::scene::Obstacle;
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    fn world(rng: &mut ChaCha8Rng) -> Scene {
        let links = 2 + (4.0 * unit(rng)) as usize;
        let arm = Arm::new(
            Point::new(0.1, -0.2),
            vec![1.0 / links as f64; links],
            0.03 * unit(rng),
            vec![Joint::CONTINUOUS; links],
            links > 2,
        );
        let mut place = || Point::new(2.4 * unit(rng) - 1.2, 2.4 * unit(rng) - 1.2);
        let (center, at) = (place(), place());
        let corner = |i: usize, radius: f64| at + Vector::polar(radius, 1.3 * i as f64);
        let mut shapes = vec![
            Shape::circle(center, 0.15).unwrap(),
            Shape::segment(place(), place(), 0.02).unwrap(),
            Shape::polygon((0..4).map(|i| corner(i, 0.3)).collect()).unwrap(),
        ];
        // The same, the other way round.
        shapes.push(Shape::polygon((0..4).rev().map(|i| corner(i, 0.2)).collect()).unwrap());
        let grid = Grid::new([-2.0, 2.0], [-2.0, 2.0], 0.5).unwrap();
        Scene::new(arm.unwrap(), grid, shapes.into_iter().map(Obstacle::still).collect(), Vec::new()).unwrap()
    }

    #[test]
    fn the_least_clearance_is_that_of_the_scene_s_own_distances() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut apart = 0;
        for _ in 0..3000 {
            let scene = world(&mut rng);
            let q: Vec<f64> = (0..scene.arm().links()).map(|_| 6.0 * unit(&mut rng) - 3.0).collect();
            let found =
                signed_distances(&scene, &q, 10.0).iter().map(|it| it.distance).fold(f64::INFINITY, f64::min);
            let links = link_clearances(&scene, &q).into_iter().fold(f64::INFINITY, f64::min);
            let least = links.min(self_clearance(&scene, &q));
            // What meets is in contact, links that cross too.
            assert!((least > 0.0) == (found > 0.0) || least.abs() < 1e-9, "{found} {least}");
            if least > 0.0 {
                apart += 1;
                assert!((found - least).abs() < 1e-9, "{found} {least}");
            }
        }
        assert!(apart > 500, "{apart}");
    }

    #[test]
    fn gradients_are_those_of_differences_apart_and_in_contact() {
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let (mut apart, mut deep, mut off) = (0, 0, 0);
        for _ in 0..2000 {
            let scene = world(&mut rng);
            let links = scene.arm().links();
            let q: Vec<f64> = (0..links).map(|_| 6.0 * unit(&mut rng) - 3.0).collect();
            let here = signed_distances(&scene, &q, 10.0);
            for j in 0..links {
                let moved = |by: f64| {
                    let mut q = q.clone();
                    q[j] += by;
                    signed_distances(&scene, &q, 10.0)
                };
                let (before, after) = (moved(-1e-6), moved(1e-6));
                if before.len() != here.len() || after.len() != here.len() {
                    continue;
                }
                for (i, it) in here.iter().enumerate() {
                    let slope = (after[i].distance - before[i].distance) / 2e-6;
                    *(if it.distance > 0.0 { &mut apart } else { &mut deep }) += 1;
                    off += usize::from((slope - it.gradient[j]).abs() > 1e-4);
                }
            }
        }
        // Where the nearest features change there is no gradient.
        assert!(apart > 10_000 && deep > 500 && off * 200 < apart + deep, "{apart} {deep} {off}");
    }
}
