//! Maps refilled after obstacles moved, against maps from scratch: every state of every cell.

use elbowroom::arm::Posture;
use elbowroom::free_space::FreeSpace;
use elbowroom::grid::Grid;
use elbowroom::scene::Scene;

use crate::{moves, worlds};

fn assert_refill(space: &mut FreeSpace, before: &Scene, now: &Scene) -> usize {
    let old = space.clone();
    let changed = space.refill(before.obstacles(), now.two_link().unwrap());
    let judge = FreeSpace::of(now.two_link().unwrap());
    for posture in Posture::ALL {
        let mut told = changed[posture.index()].clone();
        told.sort_unstable();
        let other = |cell: &usize| old.map(posture).state(*cell) != judge.map(posture).state(*cell);
        let expected: Vec<usize> = (0..now.grid().len()).filter(other).collect();
        assert_eq!(told, expected, "{posture:?}\nfrom {before:#?}\nto {now:#?}");
    }
    assert!(*space == judge, "from {before:#?}\nto {now:#?}");
    changed.iter().map(Vec::len).sum()
}

#[test]
fn refilled_maps_equal_maps_from_scratch() {
    let (mut updates, mut with_changes, mut cells) = (0, 0, 0);
    for seed in 0..700 {
        let Some(mut scene) = worlds::world(seed) else { continue };
        if seed % 20 == 0 {
            let reach: f64 = scene.arm().lengths().iter().sum();
            let grid = Grid::new([-reach, reach], [-0.9 * reach, 1.1 * reach], reach / 75.0).unwrap();
            scene = scene.with_grid(grid);
        }
        let mut numbers = worlds::Numbers::seeded(seed ^ 0xa5);
        let mut space = FreeSpace::of(scene.two_link().unwrap());
        for _ in 0..10 {
            let now = scene.with_obstacles(moves::update(&mut numbers, &scene)).unwrap();
            let changed = assert_refill(&mut space, &scene, &now);
            updates += 1;
            with_changes += u32::from(changed > 0);
            cells += changed;
            scene = now;
        }
    }
    assert!(updates > 5_000 && with_changes > 2_500, "{with_changes} of {updates}, {cells} cells");
}

#[test]
fn many_obstacles_need_wider_marks() {
    let mut scene = (0..).find_map(|seed| worlds::world(seed).filter(|s| !s.obstacles().is_empty())).unwrap();
    let mut numbers = worlds::Numbers::seeded(7);
    let mut space = FreeSpace::of(scene.two_link().unwrap());
    for count in [120, 127, 125, 300, 90, 0, 1] {
        let mut obstacles = scene.obstacles().to_vec();
        obstacles.truncate(count);
        while obstacles.len() < count {
            obstacles.append(&mut moves::update(&mut numbers, &scene));
        }
        obstacles.truncate(count);
        let now = scene.with_obstacles(obstacles).unwrap();
        assert_refill(&mut space, &scene, &now);
        scene = now;
    }
}
