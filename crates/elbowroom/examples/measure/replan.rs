use std::error::Error;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

use elbowroom::arm::Configuration;
use elbowroom::free_space::configurations;
use elbowroom::geometry::{Circle, Point, Segment, Vector};
use elbowroom::online::{Decision, Replanner};
use elbowroom::path::clearances;
use elbowroom::scene::{Course, Mover, Obstacle, Place, Scene, Shape, Sight, Waypoint};
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

/// How often the memory held is looked at in all.
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

/// A disc that moves: its number among the obstacles, and where it goes.
type Flight = (usize, Vec<Waypoint>);

/// Times (ms) of all updates, of those that were compared, and of the same from scratch.
type Times = [Vec<f64>; 3];

fn follow(file: &str, points: usize, run: &Run) -> Result<(Value, Times), Box<dyn Error>> {
    let mut scene = scenes::load(file, points)?;
    let task = scene.tasks.first().ok_or("the scene has no task")?.clone();
    let ends = [&task.start, &task.goal].map(|place| configurations(&scene, place));
    let ends = [ends[0].clone()?[0], ends[1].clone()?[0]];
    let courses = courses(&mut scene, run)?;
    let goals = ends.map(|end| Place::Configuration(end.0.to_vec()));
    let movers = known(&courses, 0.0)?;
    let replanner = |goal: &Place| Replanner::new(scene.clone(), &movers, ends[0], goal, 1);
    let mut replanners = [replanner(&goals[0])?, replanner(&goals[1])?];
    let mut state = State::rest(&ends[0].0);
    let (mut towards, mut arrivals, mut unsafe_updates, mut contacts, mut stops) = (1, 0, 0, 0, 0);
    let mut times: Times = Default::default();
    let mut memory = Vec::new();
    let mut largest: f64 = 0.0;
    let ticks = (run.seconds / TICK).round() as usize;
    for tick in 0..ticks {
        let now = TICK * tick as f64;
        let movers = known(&courses, now)?;
        let began = Instant::now();
        let until = run.deadline.map(|deadline| Duration::from_secs_f64(deadline * 1e-3));
        let update = replanners[towards]
            .update(&movers, now, &state, &|| until.is_none_or(|until| began.elapsed() < until));
        let took = began.elapsed().as_secs_f64() * 1e3;
        times[0].push(took);
        unsafe_updates += usize::from(!update.verdict.is_safe());
        stops += usize::from(matches!(update.decision, Decision::Stop(_)));
        // What was followed before, against what is planned from here on.
        if let Decision::New(motion) | Decision::Stop(motion) = &update.decision {
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
            let here = Configuration([state.position[0], state.position[1]]);
            let began = Instant::now();
            let scratch = Replanner::new(scene.clone(), &movers, here, &goals[towards], 1);
            if let Ok(mut scratch) = scratch {
                scratch.update(&movers, now, &state, &|| true);
                times[2].push(began.elapsed().as_secs_f64() * 1e3);
                times[1].push(took);
            }
        }
        if tick % ticks.div_ceil(LOOKS_AT_MEMORY) == 0 || tick + 1 == ticks {
            memory.push(json!({ "at_s": now, "resident_mib": resident() }));
        }
        let motion = replanners[towards].motion();
        let next = now + TICK;
        let is_there = replanners[towards].reaches_goal() && next > motion.end();
        state = motion.at(next);
        contacts += usize::from(is_touched(&scene, &courses, next, &state));
        if is_there {
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

/// Where the discs go, which are added to `scene`: obstacles by their number, and way-points.
fn courses(scene: &mut Scene, run: &Run) -> Result<Vec<Flight>, Box<dyn Error>> {
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    let mut unit = move || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (base, reach) = (scene.arm.base(), scene.arm.lengths().iter().sum::<f64>());
    let mut place =
        || base + Vector::polar(reach * (ROOM_AT_BASE + (1.4 - ROOM_AT_BASE) * unit()), TAU * unit());
    let mut courses = Vec::new();
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
        courses.push((scene.obstacles.len(), waypoints));
        let disc = Shape::Circle(Circle::new(from, RADIUS)?);
        scene.obstacles.push(Obstacle { name: None, shape: disc });
    }
    Ok(courses)
}

/// What the arm knows at `now` (s).
fn known(courses: &[Flight], now: f64) -> Result<Vec<Mover>, Box<dyn Error>> {
    let known = |(obstacle, waypoints): &Flight| {
        let first = waypoints.partition_point(|waypoint| waypoint.time <= now).saturating_sub(1);
        let last = waypoints.partition_point(|waypoint| waypoint.time <= now + KNOWN_AHEAD);
        let last = (last + 1).min(waypoints.len());
        Ok(Mover::new(*obstacle, Course::Waypoints(waypoints[first..last].to_vec()), Sight::Always, None)?)
    };
    courses.iter().map(known).collect()
}

fn is_touched(scene: &Scene, courses: &[Flight], now: f64, state: &State) -> bool {
    let mut scene = scene.clone();
    for (obstacle, waypoints) in courses {
        let after = waypoints.partition_point(|waypoint| waypoint.time <= now);
        let near = waypoints[after.saturating_sub(1)..(after + 1).min(waypoints.len())].to_vec();
        let shift = Course::Waypoints(near).shift_at(now);
        if let Shape::Circle(circle) = &mut scene.obstacles[*obstacle].shape {
            circle.center = Point::new(circle.center.x + shift.x, circle.center.y + shift.y);
        }
    }
    clearances(&scene, &state.position).into_iter().any(|clearance| clearance <= 0.0)
}

/// The memory this process holds (MiB), where the system tells, in pages of 4 KiB: on Linux.
fn resident() -> Option<f64> {
    let sizes = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: f64 = sizes.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4.0 / 1024.0)
}
