//! Which lists of points are simple polygons, judged in whole numbers and pair by pair.

use elbowroom::geometry::{Point, Shape, ShapeError};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

type Corner = [i64; 2];

/// Twice the area of the triangle, positive when it turns left.
fn turn([ax, ay]: Corner, [bx, by]: Corner, [cx, cy]: Corner) -> i64 {
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

fn on_edge(a: Corner, b: Corner, p: Corner) -> bool {
    let within = |k: usize| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]);
    turn(a, b, p) == 0 && within(0) && within(1)
}

/// Whether the closed segments a-b and c-d have a point in common.
fn meet(a: Corner, b: Corner, c: Corner, d: Corner) -> bool {
    let apart = |p, q, r, s| turn(p, q, r).signum() * turn(p, q, s).signum() < 0;
    (apart(a, b, c, d) && apart(c, d, a, b))
        || on_edge(a, b, c)
        || on_edge(a, b, d)
        || on_edge(c, d, a)
        || on_edge(c, d, b)
}

/// The first two edges that have more in common than neighbours' shared corner.
fn judged(corners: &[Corner]) -> Option<(usize, usize)> {
    let n = corners.len();
    let corner = |i: usize| corners[i % n];
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    pairs.into_iter().find(|&(i, j)| {
        let (a, b, c, d) = (corner(i), corner(i + 1), corner(j), corner(j + 1));
        match (j == i + 1, i == 0 && j == n - 1) {
            // All three edges of a triangle are neighbours; the shared corner is b and c, or a and d.
            (true, _) => a == b || c == d || on_edge(a, b, d) || on_edge(c, d, a),
            (_, true) => a == b || c == d || on_edge(a, b, c) || on_edge(c, d, b),
            _ => meet(a, b, c, d),
        }
    })
}

fn found(corners: &[Corner]) -> Option<(usize, usize)> {
    match Shape::polygon(corners.iter().map(|&[x, y]| Point::new(x as f64, y as f64)).collect()) {
        Ok(_) => None,
        Err(ShapeError::EdgesMeet { first, second }) => Some((first, second)),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn crossings_are_those_a_judge_in_whole_numbers_finds() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut simple, mut crossed) = (0, 0);
    for round in 0..60_000 {
        // Small squares of corners give many that coincide, lie on edges or fold back.
        let (corners, side) = (3 + round % 7, [3, 5, 9, 1000][round % 4]);
        let mut whole = || (rng.next_u64() % side) as i64 - side as i64 / 2;
        let polygon: Vec<Corner> = (0..corners).map(|_| [whole(), whole()]).collect();
        let expected = judged(&polygon);
        assert_eq!(found(&polygon), expected, "{polygon:?}");
        *(if expected.is_none() { &mut simple } else { &mut crossed }) += 1;
    }
    assert!(simple > 5_000 && crossed > 20_000, "{simple} simple, {crossed} crossed");
}

#[test]
fn a_comb_of_many_teeth_is_simple_until_two_touch() {
    // Every box meets every other in x: what the order from left to right cannot tell apart.
    let mut comb: Vec<Corner> = Vec::new();
    for tooth in 0..400 {
        comb.extend([[0, 4 * tooth], [1000, 4 * tooth + 1], [0, 4 * tooth + 2]]);
    }
    comb.push([-5, 800]);
    assert_eq!(found(&comb), None);
    comb[301] = [1000, 4 * 100 + 5];
    assert_eq!(found(&comb), judged(&comb));
    assert!(found(&comb).is_some());
}
