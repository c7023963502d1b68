//! Closed lines of three or more corners: whether they are simple, and what is inside.

use super::{Point, Segment};

/// The edges, the one that closes the line last.
fn edges(vertices: &[Point]) -> impl Iterator<Item = Segment> + '_ {
    let n = vertices.len();
    (0..n).map(move |i| Segment::new(vertices[i], vertices[(i + 1) % n]))
}

/// Whether `point` lies inside; the boundary may count either way.
pub(super) fn contains(vertices: &[Point], point: Point) -> bool {
    let mut inside = false;
    for edge in edges(vertices) {
        if (edge.a.y > point.y) != (edge.b.y > point.y) {
            let x = edge.a.x + (point.y - edge.a.y) / (edge.b.y - edge.a.y) * (edge.b.x - edge.a.x);
            inside ^= point.x < x;
        }
    }
    inside
}

/// Distance from the line and its inside to `segment` (m); 0 when they meet or the segment lies inside.
pub(super) fn distance_to_segment(vertices: &[Point], segment: Segment) -> f64 {
    if contains(vertices, segment.a) {
        return 0.0;
    }
    edges(vertices).map(|edge| edge.distance_to_segment(segment)).fold(f64::INFINITY, f64::min)
}

/// How far the innermost point of a segment that meets the polygon lies from the boundary (m), less by `tolerance` (m)
/// at most.
pub(super) fn depth_of_segment(vertices: &[Point], segment: Segment, tolerance: f64) -> f64 {
    // By bisection: depth changes along the segment no faster than the place does.
    let length = segment.a.distance(segment.b);
    let depth = |fraction: f64| {
        let point = segment.a + (segment.b - segment.a) * fraction;
        let to_boundary =
            edges(vertices).map(|edge| edge.distance_to_point(point)).fold(f64::INFINITY, f64::min);
        if contains(vertices, point) { to_boundary } else { -to_boundary }
    };
    let mut deepest = depth(0.0).max(depth(1.0)).max(0.0);
    let mut stretches = vec![(0.0, 1.0)];
    while let Some((from, to)) = stretches.pop() {
        let middle = (from + to) / 2.0;
        let here = depth(middle);
        deepest = deepest.max(here);
        if here + length * (to - from) / 2.0 > deepest + tolerance && to - from > 1e-9 {
            stretches.push((from, middle));
            stretches.push((middle, to));
        }
    }
    deepest
}

/// The first two edges, in their order, that have more in common than they may: decided exactly.
///
/// Only edges whose boxes meet are examined closely; they are found in the order of their left ends.
pub(super) fn first_meeting_edges(vertices: &[Point]) -> Option<(usize, usize)> {
    let edges: Vec<Segment> = edges(vertices).collect();
    let x = |i: usize| (edges[i].a.x.min(edges[i].b.x), edges[i].a.x.max(edges[i].b.x));
    let y = |i: usize| (edges[i].a.y.min(edges[i].b.y), edges[i].a.y.max(edges[i].b.y));
    let mut left_to_right: Vec<usize> = (0..edges.len()).collect();
    left_to_right.sort_by(|&i, &j| x(i).0.total_cmp(&x(j).0));
    let mut first = None;
    for (place, &i) in left_to_right.iter().enumerate() {
        let ((_, right), (bottom, top)) = (x(i), y(i));
        for &j in left_to_right[place + 1..].iter().take_while(|&&j| x(j).0 <= right) {
            let pair = (i.min(j), i.max(j));
            let boxes_meet = y(j).0 <= top && bottom <= y(j).1;
            if boxes_meet && first.is_none_or(|first| pair < first) && edges_meet(&edges, pair) {
                first = Some(pair);
            }
        }
    }
    first
}

/// Whether two edges of a closed line, the first given first, have more in common than neighbours' shared end.
fn edges_meet(edges: &[Segment], (i, j): (usize, usize)) -> bool {
    if j == i + 1 {
        folds_back(edges[i].a, edges[i].b, edges[j].b)
    } else if i == 0 && j == edges.len() - 1 {
        folds_back(edges[j].a, edges[j].b, edges[i].b)
    } else {
        edges[i].meets(edges[j])
    }
}

/// Whether the corner a-b-c has an edge of no length or turns straight back.
fn folds_back(a: Point, b: Point, c: Point) -> bool {
    let (first, second) = (Segment::new(a, b), Segment::new(b, c));
    a == b || b == c || first.meets(Segment::new(c, c)) || second.meets(Segment::new(a, a))
}
