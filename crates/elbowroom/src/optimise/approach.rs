//! How near the links are to what they must not touch, and how that changes with the joints.

use crate::geometry::{Point, Segment, Shape, Vector};
use crate::scene::Scene;

/// Core distances below this (m) are contact: directions between nearest points are lost in rounding.
const TOUCH: f64 = 1e-9;

/// One link near one obstacle, or near another link.
pub(super) struct Approach {
    /// Clearance (m), minus the depth where they meet.
    pub(super) clearance: f64,
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
pub(super) fn approaches(scene: &Scene, q: &[f64], near: f64) -> Vec<Approach> {
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
                found.push(Approach { clearance: nearest.distance - needed, gradient });
            }
        }
    }
    if arm.self_collision() {
        let needed = 2.0 * arm.half_width();
        for i in 0..links.len() {
            for k in i + 2..links.len() {
                let Some((distance, on_i, on_k)) = between(links[i], links[k]) else { continue };
                if distance - needed <= near {
                    let away = (on_k - on_i) * (1.0 / distance);
                    let mut gradient = vec![0.0; links.len()];
                    add(&mut gradient, &links[..=k], on_k, away);
                    add(&mut gradient, &links[..=i], on_i, -away);
                    found.push(Approach { clearance: distance - needed, gradient });
                }
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

/// Nearest points of two links; `None` where they meet, which no direction tells apart.
fn between(a: Segment, b: Segment) -> Option<(f64, Point, Point)> {
    let pairs = [(a.a, b.nearest(a.a)), (a.b, b.nearest(a.b)), (a.nearest(b.a), b.a), (a.nearest(b.b), b.b)];
    let apart = |(p, q): &(Point, Point)| p.distance(*q);
    let (p, q) = pairs.into_iter().min_by(|one, other| apart(one).total_cmp(&apart(other)))?;
    let distance = p.distance(q);
    (distance > TOUCH && !a.meets(b)).then_some((distance, p, q))
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
