//! Certified straight moves against a rigorous judge for two links (`make campaign` does the same for a million), and
//! against dense looks for more.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[expect(dead_code, reason = "shared between tests")]
mod chain_judge;
#[path = "judge/distance.rs"]
mod distance;
mod edges_judge;

use std::f64::consts::PI;

use elbowroom::arm::{Arm, Joint};
use elbowroom::geometry::Point;
use elbowroom::path::{motion_bounds, straight_move_is_free, straight_move_keeps};
use elbowroom::scene::{Obstacle, Scene};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

#[test]
fn no_edge_that_touches_is_called_free() {
    let tally = edges_judge::compare(1, 5_000);
    assert_eq!((tally.unsafe_called_free, tally.false_alarms_far), (0, 0), "{tally:?}");
    assert!(tally.free > 1_500 && tally.in_contact > 1_500, "{tally:?}");
    assert!(tally.undecided * 20 < tally.edges, "{tally:?}");
}

/// Looks at a move of many links.
const LOOKS: u32 = 300;

/// What the judge's arithmetic may be off by (m).
const ROUNDING: f64 = 1e-12;

fn number(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn chance(rng: &mut ChaCha8Rng) -> bool {
    rng.next_u64() & 1 == 0
}

fn between(from: &[f64], to: &[f64], t: f64) -> Vec<f64> {
    from.iter().zip(to).map(|(from, to)| from + (to - from) * t).collect()
}

/// Least clearance at many places of the move (m).
fn least_clearance(scene: &Scene, from: &[f64], to: &[f64]) -> f64 {
    (0..=LOOKS)
        .map(|look| chain_judge::clearance(scene, &between(from, to, f64::from(look) / f64::from(LOOKS))))
        .fold(f64::INFINITY, f64::min)
}

struct Move {
    scene: Scene,
    from: Vec<f64>,
    to: Vec<f64>,
}

/// Three to seven links among a few obstacles, every other time with one within a hair's breadth of the arm on its way.
fn random_move(rng: &mut ChaCha8Rng) -> Option<Move> {
    let links = 3 + (rng.next_u64() % 5) as usize;
    let lengths: Vec<f64> = (0..links).map(|_| number(rng, 0.1, 0.4)).collect();
    let half_width = if chance(rng) { 0.0 } else { number(rng, 0.0, 0.02) };
    let bare = build::arm_of(&lengths, half_width, &vec![Joint::CONTINUOUS; links]);
    let reach = bare.reach()[1];
    let from: Vec<f64> = (0..links).map(|_| number(rng, -1.2, 1.2)).collect();
    let turn = 10f64.powf(number(rng, -4.0, -0.3));
    let to: Vec<f64> = from.iter().map(|from| from + turn * number(rng, -1.0, 1.0)).collect();
    let mut obstacles: Vec<Obstacle> = Vec::new();
    for _ in 0..rng.next_u64() % 4 {
        let (distance, angle) = (reach * number(rng, 0.1, 1.1), number(rng, -PI, PI));
        let [x, y] = [distance * angle.cos(), distance * angle.sin()];
        let size = 10f64.powf(number(rng, -3.0, -1.0));
        let corner = |k: f64| [x + size * (angle + k).cos(), y + size * (angle + k).sin()];
        let radius = if chance(rng) { 0.0 } else { 0.2 * size };
        obstacles.push(match rng.next_u64() % 3 {
            0 => build::circle(x, y, size),
            1 => build::rounded(&[corner(0.0), corner(1.9), corner(4.0)], radius),
            _ => build::segment([corner(0.0), corner(2.5)], radius),
        });
    }
    if chance(rng) {
        let (distance, angle) = (reach * number(rng, 0.1, 1.0), number(rng, -PI, PI));
        let [x, y] = [distance * angle.cos(), distance * angle.sin()];
        let dot = 1e-6;
        let there = between(&from, &to, number(rng, 0.0, 1.0));
        let near =
            chain_judge::clearance(&build::scene(bare.clone(), vec![build::circle(x, y, dot)]), &there) + dot;
        let side = if chance(rng) { 1.0 } else { -1.0 };
        let radius = near + side * 10f64.powf(number(rng, -8.5, -2.0));
        if radius > 1e-5 {
            obstacles.push(build::circle(x, y, radius));
        }
    }
    let joints = bare.joints().to_vec();
    let arm = Arm::new(bare.base(), lengths, half_width, joints, chance(rng)).ok()?;
    Some(Move { scene: build::scene(arm, obstacles), from, to })
}

#[test]
fn no_move_of_many_links_that_touches_is_called_free() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let (mut free, mut in_contact, mut kept, mut near) = (0, 0, 0, 0);
    for case in 0..2_000 {
        let Some(Move { scene, from, to }) = random_move(&mut rng) else { continue };
        let margin = if chance(&mut rng) { 0.0 } else { 10f64.powf(number(&mut rng, -6.0, -1.0)) };
        let least = least_clearance(&scene, &from, &to);
        // No place is farther than half a step from a look; two links move towards each other by twice as much.
        let farthest = motion_bounds(scene.arm(), &from, &to).iter().copied().fold(0.0, f64::max);
        let unseen = farthest / f64::from(LOOKS);
        let is_free = straight_move_is_free(&scene, &from, &to);
        assert!(!is_free || least > -ROUNDING, "case {case}: {least} m and called free");
        assert!(is_free || least - unseen < 1e-6, "case {case}: {least} m and called not free");
        let keeps = straight_move_keeps(&scene, &from, &to, margin);
        assert!(!keeps || least > margin - ROUNDING, "case {case}: {least} m, called {margin} m");
        assert!(
            keeps || least - unseen < margin + 1e-3,
            "case {case}: {least} m, called less than {margin} m"
        );
        assert!(is_free || !keeps, "case {case}: clear by {margin} m and not free");
        assert_eq!(is_free, straight_move_is_free(&scene, &to, &from), "case {case}: forth and back");
        free += usize::from(is_free);
        in_contact += usize::from(!is_free && least < 0.0);
        kept += usize::from(keeps);
        near += usize::from(is_free && least < 1e-4);
    }
    assert!(
        free > 500 && in_contact > 400 && kept > 400 && near > 50,
        "{free} free, {near} of them within 0.1 mm, {in_contact} in contact, {kept} kept"
    );
}

#[test]
fn no_move_on_which_links_touch_each_other_is_called_free() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut free, mut in_contact, mut on_the_way) = (0, 0, 0);
    for case in 0..3_000 {
        let links = 3 + (rng.next_u64() % 4) as usize;
        let lengths: Vec<f64> = (0..links).map(|_| number(&mut rng, 0.1, 0.4)).collect();
        let half_width = number(&mut rng, 0.0, 0.02);
        let joints = vec![Joint::CONTINUOUS; links];
        let base = Point::new(0.0, 0.0);
        let arm = Arm::new(base, lengths, half_width, joints, true).unwrap();
        let scene = build::scene(arm, Vec::new());
        // Curled up one way, and more so, or less, at the end of the move.
        let curled = |rng: &mut ChaCha8Rng| (0..links).map(|_| number(rng, 0.1, 2.4)).collect::<Vec<_>>();
        let (from, target) = (curled(&mut rng), curled(&mut rng));
        let share = if chance(&mut rng) { 1.0 } else { 10f64.powf(number(&mut rng, -3.0, 0.0)) };
        let to = between(&from, &target, share);
        let least = least_clearance(&scene, &from, &to);
        let ends = [&from, &to].map(|q| chain_judge::clearance(&scene, q));
        let farthest = motion_bounds(scene.arm(), &from, &to).iter().copied().fold(0.0, f64::max);
        let unseen = farthest / f64::from(LOOKS);
        let is_free = straight_move_is_free(&scene, &from, &to);
        assert!(!is_free || least > -ROUNDING, "case {case}: {least} m and called free");
        assert!(is_free || least - unseen < 1e-6, "case {case}: {least} m and called not free");
        assert!(is_free || !straight_move_keeps(&scene, &from, &to, 0.0), "case {case}");
        free += usize::from(is_free);
        in_contact += usize::from(least < 0.0);
        on_the_way += usize::from(least < 0.0 && ends.iter().all(|clear| *clear > 0.0));
    }
    assert!(
        free > 500 && in_contact > 500 && on_the_way > 15,
        "{free} free, {in_contact} in contact, {on_the_way} of them but at neither end"
    );
}

#[test]
fn links_that_fold_onto_the_first_are_seen() {
    // The third touches the first where joints 2 and 3 make a triangle.
    let folding = |self_collision: bool| {
        let joints = vec![Joint::CONTINUOUS; 3];
        let arm = Arm::new(Point::new(0.0, 0.0), vec![0.3, 0.3, 0.4], 0.01, joints, self_collision).unwrap();
        build::scene(arm, Vec::new())
    };
    let (open, closed) = ([0.0, 1.0, 1.0], [0.0, 2.2, 2.2]);
    assert!(straight_move_is_free(&folding(false), &open, &closed));
    assert!(!straight_move_is_free(&folding(true), &open, &closed));
    assert!(!straight_move_keeps(&folding(true), &open, &closed, 0.0));
    assert!(straight_move_is_free(&folding(true), &open, &[0.0, 1.5, 1.5]));
}
