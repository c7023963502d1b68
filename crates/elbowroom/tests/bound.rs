//! Lower bounds and proofs of "no path" against brute force: a fine grid of joint angles whose steps are certified.
//! A path over the grid is a motion, so that no bound may be above it, and none may exist where one is denied.

#![expect(clippy::print_stdout, reason = "a campaign reports its figures")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
#[expect(dead_code, reason = "shared between tests")]
mod judge;
mod worlds;

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

/// What brute force finds.
struct Judged {
    /// The shortest certified way over the grid in joint travel (rad), tip travel (m) and time at greatest speed
    /// (s), if there is one.
    least: Option<[f64; 3]>,
    /// Whether start and goal are parted even where every place that is not deep in an obstacle counts as free.
    parted: bool,
}

struct Lattice {
    low: [f64; 2],
    step: [f64; 2],
    count: [usize; 2],
    round: [bool; 2],
    keep: Option<Posture>,
}

impl Lattice {
    fn new(arm: &Arm, points: usize, keep: Option<Posture>) -> Self {
        let of = |limits: JointLimits| match limits {
            JointLimits::Continuous => (-PI, TAU / points as f64, points, true),
            JointLimits::Range { min, max } => {
                let count = ((max - min) / TAU * points as f64).ceil().max(1.0) as usize;
                (min, (max - min) / count as f64, count + 1, false)
            }
        };
        let (a, b) = (of(arm.joints()[0].limits), of(arm.joints()[1].limits));
        Self { low: [a.0, b.0], step: [a.1, b.1], count: [a.2, b.2], round: [a.3, b.3], keep }
    }

    fn q(&self, node: usize) -> [f64; 2] {
        let at = [node / self.count[1], node % self.count[1]];
        std::array::from_fn(|j| self.low[j] + self.step[j] * at[j] as f64)
    }

    /// The place `by` steps away, and the plain way there.
    fn next(&self, node: usize, by: [i64; 2]) -> Option<(usize, [f64; 2])> {
        let at = [(node / self.count[1]) as i64, (node % self.count[1]) as i64];
        let mut to = [0; 2];
        for j in 0..2 {
            let n = self.count[j] as i64;
            let there = at[j] + by[j];
            to[j] = if self.round[j] { there.rem_euclid(n) } else { there };
            if !(0..n).contains(&to[j]) {
                return None;
            }
        }
        let q = self.q(node);
        let way = std::array::from_fn(|j| q[j] + self.step[j] * by[j] as f64);
        Some((to[0] as usize * self.count[1] + to[1] as usize, way))
    }

    fn nodes(&self) -> usize {
        self.count[0] * self.count[1]
    }

    /// The nodes around `q`, with the way from `q` to each.
    fn around(&self, q: &[f64; 2]) -> Vec<(usize, [f64; 2])> {
        let mut found = Vec::new();
        for node in 0..self.nodes() {
            let mut at = self.q(node);
            let near = (0..2).all(|j| {
                if self.round[j] {
                    at[j] += TAU * ((q[j] - at[j]) / TAU).round();
                }
                (at[j] - q[j]).abs() <= self.step[j] * (1.0 + 1e-9)
            });
            if near {
                found.push((node, at));
            }
        }
        found
    }

    fn in_posture(&self, q: &[f64; 2]) -> bool {
        self.keep.is_none_or(|keep| Posture::of(q).is_none_or(|posture| posture == keep))
    }
}

/// What each step costs: joint travel, tip travel, time at the greatest speeds.
fn costs(arm: &Arm, from: &[f64; 2], to: &[f64; 2], speeds: [f64; 2]) -> [f64; 3] {
    let tips = |i: usize| {
        let share = i as f64 / 8.0;
        arm.tip(&[0, 1].map(|j| from[j] + (to[j] - from[j]) * share))
    };
    let tip: f64 = (0..8).map(|i| tips(i).distance(tips(i + 1))).sum();
    let turn = [0, 1].map(|j| (to[j] - from[j]).abs());
    [turn[0].hypot(turn[1]), tip, (turn[0] / speeds[0]).max(turn[1] / speeds[1])]
}

fn judged(scene: &Scene, task: &Task, points: usize, speeds: [f64; 2]) -> Option<Judged> {
    let (arm, two) = (scene.arm(), scene.two_link().ok()?);
    let starts = configurations(two, &task.start).ok()?;
    let mut goals = configurations(two, &task.goal).ok()?;
    let wanted = match task.posture {
        TaskPosture::Up => Some(Posture::ElbowUp),
        TaskPosture::Down => Some(Posture::ElbowDown),
        _ => None,
    };
    goals.retain(|q| wanted.is_none_or(|wanted| Posture::of(q).is_none_or(|posture| posture == wanted)));
    if goals.is_empty() {
        return None;
    }
    let mut judged = Judged { least: None, parted: true };
    let keeps: Vec<Option<Posture>> = match task.posture {
        TaskPosture::Keep => Posture::ALL.map(Some).to_vec(),
        _ => vec![None],
    };
    for keep in keeps {
        let lattice = Lattice::new(arm, points, keep);
        let clear: Vec<f64> = (0..lattice.nodes())
            .map(|node| {
                let q = lattice.q(node);
                if lattice.in_posture(&q) { judge::clearance(scene, q) } else { f64::NEG_INFINITY }
            })
            .collect();
        let own =
            |ends: &[[f64; 2]]| ends.iter().filter(|q| lattice.in_posture(q)).copied().collect::<Vec<_>>();
        let (starts, goals) = (own(&starts), own(&goals));
        for objective in 0..3 {
            let mut least = vec![f64::INFINITY; lattice.nodes()];
            let mut queue = BinaryHeap::new();
            let key = |cost: f64| Reverse(cost.to_bits());
            for start in &starts {
                for (node, way) in lattice.around(start) {
                    let cost = costs(arm, start, &way, speeds)[objective];
                    if clear[node] > 0.0 && cost < least[node] && straight_move_keeps(scene, start, &way, 0.0)
                    {
                        least[node] = cost;
                        queue.push((key(cost), node));
                    }
                }
            }
            while let Some((Reverse(bits), node)) = queue.pop() {
                let cost = f64::from_bits(bits);
                if cost > least[node] {
                    continue;
                }
                let from = lattice.q(node);
                for by in [
                    [0, 1],
                    [1, 0],
                    [0, -1],
                    [-1, 0],
                    [1, 1],
                    [1, -1],
                    [-1, 1],
                    [-1, -1],
                    [1, 2],
                    [2, 1],
                    [-1, 2],
                    [-2, 1],
                    [1, -2],
                    [2, -1],
                    [-1, -2],
                    [-2, -1],
                ] {
                    let Some((to, way)) = lattice.next(node, by) else { continue };
                    let cost = cost + costs(arm, &from, &way, speeds)[objective];
                    if clear[to] > 0.0 && cost < least[to] && straight_move_keeps(scene, &from, &way, 0.0) {
                        least[to] = cost;
                        queue.push((key(cost), to));
                    }
                }
            }
            for goal in &goals {
                for (node, way) in lattice.around(goal) {
                    let cost = least[node] + costs(arm, goal, &way, speeds)[objective];
                    if cost.is_finite() && straight_move_keeps(scene, goal, &way, 0.0) {
                        let best = judged.least.get_or_insert([f64::INFINITY; 3]);
                        best[objective] = best[objective].min(cost);
                    }
                }
            }
        }
        // No place of a square is farther from its corners than half a step each way.
        let [l1, l2] = two.arm().lengths();
        let half = 0.5 * lattice.step[0];
        let moved = half * (l1 + l2) + 0.5 * lattice.step[1] * l2;
        let open = |node: usize| clear[node] > -moved;
        let mut reached = vec![false; lattice.nodes()];
        let mut waiting: Vec<usize> =
            starts.iter().flat_map(|q| lattice.around(q)).map(|(node, _)| node).collect();
        while let Some(node) = waiting.pop() {
            if std::mem::replace(&mut reached[node], true) {
                continue;
            }
            for by in [[0, 1], [1, 0], [0, -1], [-1, 0], [1, 1], [1, -1], [-1, 1], [-1, -1]] {
                waiting.extend(lattice.next(node, by).map(|(to, _)| to).filter(|&to| open(to)));
            }
        }
        judged.parted &= !goals.iter().flat_map(|q| lattice.around(q)).any(|(node, _)| reached[node]);
    }
    Some(judged)
}

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
    let count = campaign(0..100, 60);
    assert!(count.bounds > 100 && count.denied > 10, "{count:?}");
}

#[test]
#[ignore = "half an hour: make campaign"]
fn ten_thousand_worlds() {
    let seeds: u64 = std::env::var("WORLDS").map_or(10_000, |text| text.parse().unwrap());
    println!("{:?}", campaign(0..seeds, 90));
}
