use std::error::Error;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

use elbowroom::free_space::configurations;
use elbowroom::geometry::{Segment, Shape, Vector};
use elbowroom::online::{Decision, KnownMotion, Replanner, World};
use elbowroom::path::link_clearances;
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Scene, Sight, Waypoint};
use elbowroom::trajectory::State;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use serde_json::{Value, json};

use super::online::spread;
use super::{Outcome, scenes};

/// Time between two updates (s).
const TICK: f64 = 0.02;

/// Every so many updates the same is asked of a replanner that knows nothing yet: not always one of those that look
/// for something better.
const COMPARE: usize = 247;

/// How far ahead (s) the arm is told where the discs will be.
const KNOWN_AHEAD: f64 = 60.0;

/// Radius of the discs that move (m).
const RADIUS: f64 = 0.02;

/// Discs stay farther from the base than this share of the reach: where the arm can get out of the way of all of them.
const ROOM_AT_BASE: f64 = 0.6;

/// How often the memory held is examined in all.
const LOOKS_AT_MEMORY: usize = 6;

/// How an arm is kept going.
pub(crate) struct Run {
    /// How many discs move, besides the scene's obstacles, which stand still.
    pub(crate) moving: usize,
    /// How long, in the time of the arm (s).
    pub(crate) seconds: f64,
    /// After how long an update is told to come to an end (ms).
    pub(crate) deadline: Option<f64>,
    /// How many times over all is done; of the times that an update took the least counts.
    pub(crate) runs: usize,
}

/// Updates of a replanner at 50 Hz while discs move and the arm goes to and fro between the ends of the first task.
///
/// What came of it is the same in every run where there is no deadline.
pub(crate) fn measure(file: &str, points: usize, run: &Run) -> Outcome {
    let (mut found, mut times) = follow(file, points, run)?;
    for _ in 1..run.runs {
        let (_, again) = follow(file, points, run)?;
        for (times, again) in times.iter_mut().zip(again) {
            times.iter_mut().zip(again).for_each(|(time, again)| *time = time.min(again));
        }
    }
    let [updates, kept, scratch] = times;
    let mut ratios: Vec<f64> = kept.iter().zip(&scratch).map(|(kept, scratch)| kept / scratch).collect();
    ratios.sort_by(f64::total_cmp);
    found["of_scratch_median"] = ratios.get(ratios.len() / 2).copied().into();
    found["update_ms"] = spread(updates);
    found["compared_ms"] = spread(kept);
    found["scratch_ms"] = spread(scratch);
    Ok(found)
}

/// Times (ms) of all updates, of those that were compared, and of the same from scratch.
type Times = [Vec<f64>; 3];

fn follow(file: &str, points: usize, run: &Run) -> Result<(Value, Times), Box<dyn Error>> {
    let scene = scenes::load(file, points)?;
    let task = scene.tasks().first().ok_or("the scene has no task")?;
    let ends = [&task.start, &task.goal].map(|place| Ok(configurations(scene.two_link()?, place)?[0]));
    let [start, goal]: [Result<[f64; 2], Box<dyn Error>>; 2] = ends;
    let ends = [start?, goal?];
    let scene = among_discs(&scene, run)?;
    let goals = ends.map(|end| Place::Configuration(end.into()));
    let replanner = |goal: &Place| Replanner::new(scene.clone(), ends[0], goal, 1);
    let mut replanners = [replanner(&goals[0])?, replanner(&goals[1])?];
    let mut state = State::rest(&ends[0]);
    let (mut towards, mut arrivals, mut unsafe_updates, mut contacts, mut stops) = (1, 0, 0, 0, 0);
    let mut times: Times = Default::default();
    let mut memory = Vec::new();
    let mut world = World::new(scene.clone());
    let mut largest: f64 = 0.0;
    let ticks = (run.seconds / TICK).round() as usize;
    for tick in 0..ticks {
        let now = TICK * tick as f64;
        let known = known(&scene, now)?;
        let began = Instant::now();
        let until = run.deadline.map(|deadline| Duration::from_secs_f64(deadline * 1e-3));
        let update = replanners[towards]
            .update(&known, now, &state, &|| until.is_none_or(|until| began.elapsed() < until))?;
        let took = began.elapsed().as_secs_f64() * 1e3;
        times[0].push(took);
        unsafe_updates += usize::from(!update.verdict.is_safe());
        stops += usize::from(matches!(update.decision, Decision::Stop(_)));
        // What was followed before, against what is planned from here on.
        let planned = match &update.decision {
            Decision::New(trajectory) => Some(trajectory.motion()),
            Decision::Stop(motion) => Some(motion),
            _ => None,
        };
        if let Some(motion) = planned {
            let begin = motion.at(now);
            let pairs = [
                (&begin.position, &state.position),
                (&begin.velocity, &state.velocity),
                (&begin.acceleration, &state.acceleration),
            ];
            for (planned, followed) in pairs.into_iter().flat_map(|(a, b)| a.iter().zip(b)) {
                largest = largest.max((planned - followed).abs());
            }
        }
        if tick % COMPARE == 9 {
            let here = [state.position[0], state.position[1]];
            let began = Instant::now();
            let scratch = Replanner::new(scene.clone(), here, &goals[towards], 1);
            if let Ok(mut scratch) = scratch {
                scratch.update(&known, now, &state, &|| true)?;
                times[2].push(began.elapsed().as_secs_f64() * 1e3);
                times[1].push(took);
            }
        }
        if tick % ticks.div_ceil(LOOKS_AT_MEMORY) == 0 || tick + 1 == ticks {
            memory.push(json!({ "at_s": now, "resident_mib": resident() }));
        }
        let next = now + TICK;
        state = replanners[towards].motion().at(next);
        world.advance(next, &state.position);
        contacts += usize::from(is_touched(&world, &state)?);
        if replanners[towards].is_at_goal(&state) {
            arrivals += 1;
            towards = 1 - towards;
        }
    }
    let found = json!({
        "updates": ticks, "arrivals": arrivals, "unsafe_updates": unsafe_updates, "stops": stops,
        "contacts": contacts, "largest_difference": largest, "memory": memory,
    });
    Ok((found, times))
}

/// The scene with discs that fly from waypoint to waypoint.
fn among_discs(scene: &Scene, run: &Run) -> Result<Scene, Box<dyn Error>> {
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    let mut unit = move || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (base, [_, reach]) = (scene.arm().base(), scene.arm().reach());
    let mut place =
        || base + Vector::polar(reach * (ROOM_AT_BASE + (1.4 - ROOM_AT_BASE) * unit()), TAU * unit());
    let mut obstacles = scene.obstacles().to_vec();
    for _ in 0..run.moving {
        let from = place();
        let (mut at, mut time) = (from, 0.0);
        let mut waypoints = vec![Waypoint { time, shift: Vector::new(0.0, 0.0) }];
        while time < run.seconds + KNOWN_AHEAD {
            let to = place();
            if Segment::new(at, to).distance_to_point(base) < ROOM_AT_BASE * reach {
                continue;
            }
            // 0.05 to 0.1 m/s, by where it goes.
            time += at.distance(to) / (0.05 + 0.05 * (to.x - base.x).abs() / (1.4 * reach)) + TICK;
            waypoints.push(Waypoint { time, shift: to - from });
            at = to;
        }
        let motion = ObstacleMotion::new(Course::Waypoints(waypoints), Sight::Always, None)?;
        let disc = Shape::circle(from, RADIUS)?;
        obstacles.push(Obstacle { motion: Some(motion), ..Obstacle::still(disc) });
    }
    Ok(scene.with_obstacles(obstacles)?)
}

/// What the arm knows at `now` (s): the next waypoints.
fn known(scene: &Scene, now: f64) -> Result<Vec<KnownMotion>, Box<dyn Error>> {
    let mut known = Vec::new();
    for (obstacle, motion) in scene.obstacles().iter().map(|obstacle| obstacle.motion.as_ref()).enumerate() {
        let Some(Course::Waypoints(waypoints)) = motion.map(ObstacleMotion::course) else { continue };
        let first = waypoints.partition_point(|waypoint| waypoint.time <= now).saturating_sub(1);
        let last = waypoints.partition_point(|waypoint| waypoint.time <= now + KNOWN_AHEAD);
        let last = (last + 1).min(waypoints.len());
        let next = Course::Waypoints(waypoints[first..last].to_vec());
        known.push(KnownMotion { obstacle, motion: ObstacleMotion::new(next, Sight::Always, None)? });
    }
    Ok(known)
}

fn is_touched(world: &World, state: &State) -> Result<bool, Box<dyn Error>> {
    let now = world.scene().with_obstacles(world.obstacles())?;
    Ok(link_clearances(&now, &state.position).into_iter().any(|clearance| clearance <= 0.0))
}

/// The memory this process holds (MiB), where the system tells, in pages of 4 KiB: on Linux.
fn resident() -> Option<f64> {
    let sizes = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: f64 = sizes.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4.0 / 1024.0)
}
