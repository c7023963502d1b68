//! Slices of configuration space against another library's distances, on random worlds.

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
#[expect(dead_code, reason = "shared between tests")]
mod judge;
mod worlds;

use std::f64::consts::PI;

use elbowroom::free_space::Slices;
use elbowroom::scene::Scene;

use worlds::Numbers;

/// Distances nearer to contact than this (m) are left out: there rounding decides.
const UNDECIDED: f64 = 1e-8;

fn holds(intervals: &[[f64; 2]], angle: f64) -> bool {
    intervals.iter().any(|[from, to]| (*from..=*to).contains(&angle))
}

/// Clearance of each link at `q` (m).
fn clearances(scene: &Scene, q: [f64; 2]) -> [f64; 2] {
    let [base, elbow, tip] = judge::skeleton(scene, q);
    [(base, elbow), (elbow, tip)].map(|(a, b)| {
        let distances = scene.obstacles().iter().map(|obstacle| distance::distance(obstacle, a, b));
        distances.fold(f64::INFINITY, f64::min) - scene.arm().half_width()
    })
}

#[test]
fn a_place_is_forbidden_exactly_where_a_link_touches() {
    let (mut touching, mut clear) = ([0; 2], [0; 2]);
    for seed in 0..2_000 {
        let Some(scene) = worlds::world(seed) else { continue };
        let mut numbers = Numbers::seeded(seed ^ 0xA5A5);
        let margin = if seed % 2 == 0 { 0.0 } else { 0.01 };
        let slices = Slices::new(scene.two_link().unwrap(), margin);
        let range = [-1.5 * PI, 2.5 * PI];
        let first = slices.first_joint(range);
        for _ in 0..20 {
            let q1 = numbers.within(range[0], range[1]);
            let second = slices.second_joint(q1, range);
            assert!(second.windows(2).all(|pair| pair[0][1] < pair[1][0]), "in order and apart");
            for _ in 0..20 {
                let q = [q1, numbers.within(range[0], range[1])];
                let [link1, link2] = clearances(&scene, q).map(|clearance| clearance - margin);
                for (link, clearance, intervals, angle) in
                    [(0, link1, &first, q[0]), (1, link2, &second, q[1])]
                {
                    if clearance.abs() < UNDECIDED {
                        continue;
                    }
                    let forbidden = holds(intervals, angle);
                    // A second link that begins in an obstacle is left to the first, which ends there.
                    assert_eq!(
                        forbidden,
                        clearance < 0.0,
                        "seed {seed}, q {q:?}: link {} is clear by {clearance} m",
                        link + 1
                    );
                    if forbidden { touching[link] += 1 } else { clear[link] += 1 }
                }
            }
        }
    }
    assert!(touching.iter().chain(&clear).all(|&count| count > 20_000), "{touching:?}, {clear:?}");
}
