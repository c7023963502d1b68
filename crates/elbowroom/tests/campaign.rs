//! Safety at length: `make campaign`. Seeds are fixed; every count is printed.

#![expect(clippy::print_stdout, reason = "a campaign reports its figures")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
mod edges_judge;
mod judge;
mod worlds;

use std::hash::{DefaultHasher, Hash, Hasher};

use elbowroom::free_space::FreeSpace;
use elbowroom::planners::{DstarPlanner, DstarPsoPlanner};
use elbowroom::planning::{
    ASSUMED_LIMITS, Objective, Plan, PlanError, PlanSettings, Planner, Unwatched, plan,
};
use elbowroom::scene::Scene;
use elbowroom::swarm::GuidedSwarmSettings;
use elbowroom::trajectory::{Piece, SpeedLimits, fastest_durations, quintic_through, vias_at};
use rayon::prelude::*;

fn planned(scene: &Scene, seed: u64) -> Result<Plan, PlanError> {
    let swarm = GuidedSwarmSettings { candidates: 10, ..GuidedSwarmSettings::default() };
    let drawn = DstarPsoPlanner { swarm };
    let planner: &dyn Planner = if seed.is_multiple_of(2) { &DstarPlanner } else { &drawn };
    let settings = PlanSettings {
        objective: [Objective::Tip, Objective::Joint, Objective::Time][(seed % 3) as usize],
        seed,
        ..PlanSettings::default()
    };
    plan(scene, &scene.tasks()[0], planner, &settings, &Unwatched)
}

/// What became of some worlds.
#[derive(Debug, Default, Clone, Copy)]
struct Outcome {
    planned: u64,
    without_path: u64,
    not_found: u64,
    refused: u64,
    without_task: u64,
    unsafe_motions: u64,
    failed: u64,
    pieces: u64,
    pieces_beyond_limits: u64,
    posture_jumps: u64,
    stops: u64,
}

impl Outcome {
    fn plus(self, other: Self) -> Self {
        Self {
            planned: self.planned + other.planned,
            without_path: self.without_path + other.without_path,
            not_found: self.not_found + other.not_found,
            refused: self.refused + other.refused,
            without_task: self.without_task + other.without_task,
            unsafe_motions: self.unsafe_motions + other.unsafe_motions,
            failed: self.failed + other.failed,
            pieces: self.pieces + other.pieces,
            pieces_beyond_limits: self.pieces_beyond_limits + other.pieces_beyond_limits,
            posture_jumps: self.posture_jumps + other.posture_jumps,
            stops: self.stops + other.stops,
        }
    }
}

fn outcome(seed: u64) -> Outcome {
    let mut outcome = Outcome::default();
    let Some(scene) = worlds::world(seed) else { return Outcome { without_task: 1, ..outcome } };
    match planned(&scene, seed) {
        Ok(plan) => {
            outcome.planned = 1;
            outcome.stops = plan.record().stops as u64;
            if let Some(fault) = judge::fault(&scene, plan.trajectory().motion(), 200) {
                println!("world {seed}: {fault}");
                outcome.unsafe_motions = 1;
            }
            judge_pieces(&scene, &plan, &mut outcome);
        }
        Err(PlanError::NoPath(_)) => outcome.without_path = 1,
        Err(PlanError::NotFound { .. }) => outcome.not_found = 1,
        Err(PlanError::Start(_) | PlanError::Goal(_) | PlanError::GoalPosture { .. }) => outcome.refused = 1,
        Err(error) => {
            println!("world {seed}: {error}");
            outcome.failed = 1;
        }
    }
    outcome
}

/// Velocity, acceleration and jerk of every piece at their extrema, against the limits stated or assumed.
fn judge_pieces(scene: &Scene, plan: &Plan, outcome: &mut Outcome) {
    let assumed = [ASSUMED_LIMITS.velocity, ASSUMED_LIMITS.acceleration, ASSUMED_LIMITS.jerk];
    for piece in plan.trajectory().motion().pieces() {
        outcome.pieces += 1;
        let beyond = (0..2).any(|j| {
            let stated = scene.arm().joints()[j].motion;
            let stated = [stated.velocity, stated.acceleration, stated.jerk];
            let mut rate = derivative(&piece.coefficients[j]);
            (0..3).any(|k| {
                let most = greatest(&rate, piece.duration);
                rate = derivative(&rate);
                most > stated[k].unwrap_or(assumed[k]) * (1.0 + 1e-12)
            })
        });
        outcome.pieces_beyond_limits += u64::from(beyond);
        outcome.posture_jumps += u64::from(jumps_posture(piece));
    }
}

/// Whether the second joint gets from one side to the other without passing a multiple of half a turn.
fn jumps_posture(piece: &Piece) -> bool {
    let bend = |s: f64| judge::derivatives(piece, 1, s)[0].sin();
    (0..64).any(|i| {
        let (mut a, mut b) = (piece.duration * f64::from(i) / 64.0, piece.duration * f64::from(i + 1) / 64.0);
        if bend(a) * bend(b) >= 0.0 {
            return false;
        }
        for _ in 0..60 {
            let middle = f64::midpoint(a, b);
            if bend(a) * bend(middle) <= 0.0 { b = middle } else { a = middle }
        }
        bend(a).abs() > 1e-6
    })
}

fn derivative(polynomial: &[f64]) -> Vec<f64> {
    polynomial.iter().enumerate().skip(1).map(|(k, c)| c * k as f64).collect()
}

fn value(polynomial: &[f64], s: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// Where `polynomial` is 0 between 0 and `end`: between its turning points by bisection.
fn roots(polynomial: &[f64], end: f64) -> Vec<f64> {
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let mut ends = vec![0.0];
    ends.extend(roots(&derivative(polynomial), end));
    ends.push(end);
    let crossing = |pair: &[f64]| {
        let (mut a, mut b) = (pair[0], pair[1]);
        if value(polynomial, a) * value(polynomial, b) > 0.0 {
            return None;
        }
        for _ in 0..80 {
            let middle = f64::midpoint(a, b);
            if value(polynomial, a) * value(polynomial, middle) <= 0.0 { b = middle } else { a = middle }
        }
        Some(f64::midpoint(a, b))
    };
    ends.windows(2).filter_map(crossing).collect()
}

/// The greatest size of `polynomial` from 0 to `end`.
fn greatest(polynomial: &[f64], end: f64) -> f64 {
    let mut places = roots(&derivative(polynomial), end);
    places.extend([0.0, end]);
    places.into_iter().map(|s| value(polynomial, s).abs()).fold(0.0, f64::max)
}

#[test]
#[ignore = "minutes: make campaign"]
fn a_hundred_thousand_worlds() {
    let outcome = (0..100_000u64).into_par_iter().map(outcome).reduce(Outcome::default, Outcome::plus);
    println!("worlds: {outcome:#?}");
    assert_eq!((outcome.unsafe_motions, outcome.failed, outcome.posture_jumps), (0, 0, 0));
    assert_eq!(outcome.pieces_beyond_limits, 0);
    assert!(outcome.planned > 50_000);
}

/// Pieces of a random motion under random limits, and how many of them go beyond a limit or jump.
fn random_motion(seed: u64) -> (u64, u64) {
    let mut numbers = worlds::Numbers::seeded(seed);
    let places: Vec<[f64; 2]> =
        (0..4 + numbers.below(12)).map(|_| [numbers.within(-3.0, 3.0), numbers.within(-2.5, 2.5)]).collect();
    let limit = |numbers: &mut worlds::Numbers| SpeedLimits {
        velocity: numbers.within(0.2, 8.0),
        acceleration: numbers.within(0.5, 40.0),
        jerk: numbers.within(2.0, 400.0),
    };
    let limits = [limit(&mut numbers), limit(&mut numbers)];
    let mut vias = vias_at(&places);
    for via in &mut vias {
        via.stop |= numbers.below(8) == 0;
    }
    let pieces = quintic_through(&vias, &fastest_durations(&vias, &limits));
    let beyond = pieces.iter().filter(|piece| {
        let over = |j: usize| {
            let mut rate = derivative(&piece.coefficients[j]);
            [limits[j].velocity, limits[j].acceleration, limits[j].jerk].into_iter().any(|limit| {
                let most = greatest(&rate, piece.duration);
                rate = derivative(&rate);
                most > limit * (1.0 + 1e-12)
            })
        };
        over(0) || over(1) || jumps_posture(piece)
    });
    (pieces.len() as u64, beyond.count() as u64)
}

#[test]
#[ignore = "minutes: make campaign"]
fn a_million_pieces() {
    let sum = |a: (u64, u64), b: (u64, u64)| (a.0 + b.0, a.1 + b.1);
    let (pieces, beyond) = (0..120_000u64).into_par_iter().map(random_motion).reduce(|| (0, 0), sum);
    println!("pieces through random vias: {pieces}, beyond a limit or jumping posture: {beyond}");
    assert!(pieces >= 1_000_000 && beyond == 0);
}

#[test]
#[ignore = "minutes: make campaign"]
fn a_million_edges() {
    let tallies: Vec<_> =
        (0..100u64).into_par_iter().map(|seed| edges_judge::compare(1000 + seed, 10_000)).collect();
    let sum = |of: fn(&edges_judge::Tally) -> u64| tallies.iter().map(of).sum::<u64>();
    println!(
        "edges: {}, free {}, in contact {}, unsafe called free {}, false alarms within 1e-6 m {}, farther {}, called \
         free but undecided {}",
        sum(|t| t.edges),
        sum(|t| t.free),
        sum(|t| t.in_contact),
        sum(|t| t.unsafe_called_free),
        sum(|t| t.false_alarms_near),
        sum(|t| t.false_alarms_far),
        sum(|t| t.undecided),
    );
    assert_eq!((sum(|t| t.unsafe_called_free), sum(|t| t.false_alarms_far)), (0, 0));
}

/// A number for the plans and maps of `count` worlds.
fn fingerprint(count: u64, threads: usize) -> Option<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()?;
    Some(pool.install(|| {
        let mut hasher = DefaultHasher::new();
        for seed in 0..count {
            let Some(scene) = worlds::world(seed) else { continue };
            format!("{:?}", scene.two_link().map(FreeSpace::of)).hash(&mut hasher);
            format!("{:?}", planned(&scene, seed)).hash(&mut hasher);
        }
        hasher.finish()
    }))
}

#[test]
fn same_seed_same_bytes_with_one_two_and_eight_threads() {
    let prints = [1, 2, 8].map(|threads| fingerprint(40, threads));
    assert!(prints[0].is_some() && prints.iter().all(|print| *print == prints[0]));
}

#[test]
fn the_judge_of_extrema_knows_them() {
    // 3 s - s^3 turns at 1, at 2.
    assert!((greatest(&[0.0, 3.0, 0.0, -1.0], 1.5) - 2.0).abs() < 1e-12);
    assert!((greatest(&[0.0, 3.0, 0.0, -1.0], 3.0) - 18.0).abs() < 1e-12);
}
