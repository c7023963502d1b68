//! Lower bounds and proofs of "no path" against brute force: a fine grid of joint angles whose steps are certified.
//! A path over the grid is a motion, so that no bound may be above it, and none may exist where one is denied.

#![expect(clippy::print_stdout, reason = "a campaign reports its figures")]
#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

mod brute_force;
#[path = "../worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "../judge/distance.rs"]
mod distance;
#[path = "../judge/mod.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod judge;
mod time;
#[path = "../worlds/mod.rs"]
mod worlds;

use brute_force::judged;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};

use elbowroom::arm::{Arm, Joint, JointLimits, Posture};
use elbowroom::free_space::configurations;
use elbowroom::geometry::{Point, Vector};
use elbowroom::mesh::{Across, Measure, MeshPoint, NavigationMesh, Side};
use elbowroom::path::straight_move_keeps;
use elbowroom::planners::OptimalPlanner;
use elbowroom::planning::{Objective, PlanError, PlanSettings, Unwatched, plan};
use elbowroom::scene::{Scene, Task, TaskPosture, TwoLinkScene};
use elbowroom::verify::{BoundError, OpenJoints, OpenTips, Reachability, bound_over_joints, bound_over_tips};

/// Walls that part many a task: bars across the reach, and around its ends.
fn wall_in(scene: Scene, seed: u64) -> Scene {
    let mut scene = scene;
    let mut numbers = worlds::Numbers::seeded(seed ^ 0x5A5A);
    let reach: f64 = scene.arm().lengths().iter().sum();
    for _ in 0..8 + numbers.below(5) {
        let angle = numbers.within(-PI, PI);
        let (from, to) = (reach * numbers.within(0.1, 0.5), reach * numbers.within(0.7, 1.1));
        let at = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
        let added = worlds::bar(at(from, angle), at(to, angle + numbers.within(-0.3, 0.3)), 0.01);
        let Some(added) = added else { continue };
        let walled = build::with_obstacle(&scene, added);
        // A wall on the start or the goal would only be refused.
        let is_free = |two: TwoLinkScene<'_>| {
            let places = walled.tasks().iter().flat_map(|task| [&task.start, &task.goal]);
            places.map(|place| configurations(two, place)).all(|found| found.is_ok())
        };
        if walled.two_link().is_ok_and(is_free) {
            scene = walled;
        }
    }
    scene
}

/// How many worlds said what.
#[derive(Debug, Default)]
struct Count {
    bounds: usize,
    denied: usize,
    parted: usize,
    without_bound: usize,
    undecided: usize,
}

fn campaign(seeds: std::ops::Range<u64>, points: usize) -> Count {
    let mut count = Count::default();
    for seed in seeds {
        let Some(mut scene) = worlds::world(seed) else { continue };
        if seed % 2 == 0 {
            scene = wall_in(scene, seed);
        }
        let task = &scene.tasks()[0];
        // The assumed speeds where none is stated: half pi.
        let speeds = [0, 1].map(|j| scene.arm().joints()[j].motion.velocity.unwrap_or(PI / 2.0));
        let Some(judged) = judged(&scene, task, points, speeds) else { continue };
        for (k, objective) in [Objective::Joint, Objective::Tip, Objective::Time].into_iter().enumerate() {
            let settings = PlanSettings { objective, ..PlanSettings::default() };
            match plan(&scene, task, &OptimalPlanner, &settings, &Unwatched) {
                Ok(plan) => {
                    assert!(!judged.parted, "seed {seed}: a motion where the flood finds none");
                    let Some(bound) = plan.lower_bound() else {
                        count.without_bound += 1;
                        continue;
                    };
                    assert!(
                        bound <= plan.cost() * (1.0 + 1e-12),
                        "seed {seed} {objective:?}: {bound} above the plan's own {}",
                        plan.cost()
                    );
                    if let Some(least) = judged.least {
                        // Time of the way alone does not hold the time to speed up.
                        let most = if objective == Objective::Time { plan.cost() } else { least[k] };
                        assert!(
                            bound <= most * (1.0 + 1e-9),
                            "seed {seed} {objective:?}: bound {bound} above {most}"
                        );
                        count.bounds += 1;
                    }
                }
                Err(PlanError::NoPath(_)) => {
                    assert!(judged.least.is_none(), "seed {seed}: denied what the grid has");
                    count.denied += 1;
                    count.parted += usize::from(judged.parted);
                }
                Err(PlanError::NotFoundOverJoints { .. }) => count.undecided += 1,
                Err(PlanError::Start(_) | PlanError::Goal(_)) => {}
                Err(other) => panic!("seed {seed}: {other}"),
            }
        }
    }
    count
}

/// A triangle around `at` with sides of about `size`, all of them walls.
fn walled(at: [f64; 2], size: f64, numbers: &mut worlds::Numbers) -> Option<NavigationMesh> {
    let turned = numbers.within(0.0, TAU);
    let corner = |i: usize| {
        let angle = turned + TAU * i as f64 / 3.0;
        Point::new(at[0] + size * angle.cos(), at[1] + size * angle.sin())
    };
    NavigationMesh::new(&[(0..3).map(|i| Side { from: corner(i), across: None }).collect()]).ok()
}

/// Whether the judge finds a place of the triangle's sides that is clear by more than rounding.
fn has_a_gap(mesh: &NavigationMesh, clearance: impl Fn(Point) -> f64) -> bool {
    let sides = mesh.sides(0);
    (0..3).any(|i| {
        let (a, b) = (sides[i].from, sides[(i + 1) % 3].from);
        (0..=300).any(|k| clearance(a.lerp(b, f64::from(k) / 300.0)) > 1e-9)
    })
}

#[test]
fn walls_that_the_verifier_accepts_are_blocked_all_along() {
    let (mut accepted, mut refused) = ([0; 2], [0; 2]);
    for seed in 0..4_000 {
        let Some(scene) = worlds::world(seed) else { continue };
        let free = |joint: &Joint| Joint { limits: JointLimits::Continuous, ..*joint };
        let joints: Vec<Joint> = scene.arm().joints().iter().map(free).collect();
        let scene =
            scene.with_arm(build::arm_of(scene.arm().lengths(), scene.arm().half_width(), &joints)).unwrap();
        let (two, half_width) = (scene.two_link().unwrap(), scene.arm().half_width());
        let mut numbers = worlds::Numbers::seeded(seed ^ 0xC3C3);
        for _ in 0..10 {
            let q = [numbers.within(-PI, PI), numbers.within(-PI, PI)];
            let size = 10f64.powf(numbers.within(-4.0, -0.7));
            let tip = two.arm().tip(&q);
            let at = [q, [tip.x, tip.y]];
            let in_contact = [
                judge::clearance(&scene, q) < 0.0,
                scene.obstacles().iter().any(|o| distance::distance(o, at[1], at[1]) < half_width),
            ];
            for plane in (0..2).filter(|&plane| in_contact[plane]) {
                let Some(mesh) = walled(at[plane], size, &mut numbers) else { continue };
                let place = MeshPoint { cell: 0, point: Point::new(at[plane][0], at[plane][1]) };
                let ends = [(q, place)];
                let (found, gap) = if plane == 0 {
                    let claim = OpenJoints { mesh: &mesh, starts: &ends, goals: &[], keeps_posture: false };
                    let gap = has_a_gap(&mesh, |p| judge::clearance(&scene, [p.x, p.y]));
                    (bound_over_joints(two, &claim, Measure::Euclidean, &|| true), gap)
                } else {
                    let claim = OpenTips { mesh: &mesh, starts: &ends, goals: &[] };
                    let clear = |p: Point| {
                        let at = [p.x, p.y];
                        let to = scene.obstacles().iter().map(|o| distance::distance(o, at, at));
                        let reach = p.distance(scene.arm().base());
                        let [near, far] = scene.arm().reach();
                        let reached = (near..=far).contains(&reach);
                        let clearance = to.fold(f64::INFINITY, f64::min) - half_width;
                        if reached { clearance } else { -1.0 }
                    };
                    (bound_over_tips(two, &claim, &|| true), has_a_gap(&mesh, clear))
                };
                match found {
                    Ok(Reachability::Parted) => {
                        assert!(
                            !gap,
                            "seed {seed}, plane {plane}: a wall around {at:?} of size {size} has a gap"
                        );
                        accepted[plane] += 1;
                    }
                    Err(BoundError::Wall { .. } | BoundError::TipWall { .. }) => refused[plane] += 1,
                    other => panic!("seed {seed}: {other:?}"),
                }
            }
        }
    }
    assert!(accepted.iter().chain(&refused).all(|&count| count > 100), "{accepted:?}, {refused:?}");
}

#[test]
fn claims_that_the_arm_does_not_bear_out_are_refused() {
    let scene = (0..).find_map(worlds::world).unwrap();
    let two = scene.two_link().unwrap();
    let square = |across: [Option<Across>; 4]| {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let side = |i: usize| Side { from: Point::new(corners[i].0, corners[i].1), across: across[i] };
        (0..4).map(side).collect::<Vec<_>>()
    };
    // A square that goes on at its own other end, as if a joint turned round after a radian.
    let to = |side, x| Some(Across { cell: 0, side, shift: Vector::new(x, 0.0) });
    let round = NavigationMesh::new(&[square([None, to(3, -1.0), None, to(1, 1.0)])]).unwrap();
    let middle = [0.5, 0.5];
    let at = |q: [f64; 2], x: f64| (q, MeshPoint { cell: 0, point: Point::new(x, 0.5) });
    let judged = |mesh: &NavigationMesh, start: ([f64; 2], MeshPoint)| {
        let starts = [start];
        let claim = OpenJoints { mesh, starts: &starts, goals: &[middle], keeps_posture: false };
        bound_over_joints(two, &claim, Measure::Euclidean, &|| true)
    };
    assert!(matches!(judged(&round, at(middle, 0.5)), Err(BoundError::Seam { cell: 0, side: 1 })));
    let plain = NavigationMesh::new(&[square([None; 4])]).unwrap();
    assert!(matches!(judged(&plain, at(middle, 0.6)), Err(BoundError::Place { .. })));
    assert!(matches!(judged(&plain, at([2.5, 0.5], 2.5)), Err(BoundError::Place { .. })));
}

#[test]
fn no_bound_is_above_what_brute_force_finds_and_nothing_is_denied_that_it_finds() {
    let count = campaign(0..60, 60);
    assert!(count.bounds > 60 && count.denied > 5 && count.without_bound == 0, "{count:?}");
}

#[test]
fn the_tip_goes_round_what_the_second_joint_keeps_it_out_of() {
    // Bent by no more than a right angle the tip stays 0.5 m from the base: half way round that disc, or nearly straight past it.
    let joints = [Joint::CONTINUOUS, build::joint(build::stops(0.2, PI / 2.0))];
    let scene = build::scene(build::arm_of(&[0.4, 0.3], 0.0, &joints), vec![]);
    let at = |angle: f64| build::tip(0.52 * angle.cos(), 0.52 * angle.sin());
    for turn in [PI, 2.0, 1.0] {
        let task = build::task("round", at(0.3), at(0.3 + turn), TaskPosture::Any);
        let plan = plan(&scene, &task, &OptimalPlanner, &PlanSettings::default(), &Unwatched).unwrap();
        let (radius, distance) = (0.5, 0.52);
        // Tangents, and the arc between where they touch.
        let tangent = f64::sqrt(distance * distance - radius * radius);
        let arc = turn - 2.0 * f64::acos(radius / distance);
        let least = 2.0 * tangent + radius * arc;
        let bound = plan.lower_bound().unwrap();
        assert!(bound <= least + 1e-9 && bound > 0.99 * least, "{turn}: {bound}, {least}");
    }
}

#[test]
#[ignore = "half an hour: make campaign"]
fn ten_thousand_worlds() {
    let seeds: u64 = std::env::var("WORLDS").map_or(10_000, |text| text.parse().unwrap());
    println!("{:?}", campaign(0..seeds, 90));
}

#[test]
#[ignore = "twenty minutes: make campaign"]
fn bounds_on_duration_of_ten_thousand_worlds() {
    let seeds: u64 = std::env::var("WORLDS").map_or(10_000, |text| text.parse().unwrap());
    let [unhindered, others] = time::gaps(0..seeds);
    println!("nothing in the way: {}", time::quantiles(&unhindered));
    println!("elsewhere: {}", time::quantiles(&others));
}
