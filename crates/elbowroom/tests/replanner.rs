//! Arms that keep going among moving obstacles: random episodes before a judge that samples.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test that cannot be set up may panic; a campaign tells"
)]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;
#[path = "judge/doom.rs"]
mod doom;

use std::f64::consts::PI;
use std::sync::atomic::{AtomicU64, Ordering};

use elbowroom::arm::{Joint, JointLimits, MotionLimits};
use elbowroom::geometry::{Point, Segment, Vector};
use elbowroom::online::{Decision, Replanner, World};
use elbowroom::path::link_clearances;
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Scene, Sight, Waypoint};
use elbowroom::trajectory::{Motion, State};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// How long an episode lasts at most (s).
const LONGEST: f64 = 30.0;

/// How long after a contact it is still looked whether any motion could have gone on (s).
const AFTER_CONTACT: f64 = 2.0;

struct Numbers(ChaCha8Rng);

impl Numbers {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    fn place(&mut self, near: f64, far: f64) -> Point {
        let (way, angle) = (self.within(near, far), self.within(-PI, PI));
        Point::new(way * angle.cos(), way * angle.sin())
    }
}

fn disc(center: Point, radius: f64) -> Obstacle {
    build::circle(center.x, center.y, radius)
}

struct Episode {
    world: World,
    start: [f64; 2],
    goal: [f64; 2],
}

/// The paper's arm among still and moving discs whose courses are known.
fn episode(seed: u64) -> Option<Episode> {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(seed));
    let motion = MotionLimits { velocity: Some(1.5), acceleration: Some(4.0), jerk: Some(40.0) };
    let joint = |limits| Joint { limits, motion };
    let joints = [joint(JointLimits::Continuous), joint(build::stops(-2.6, 2.6))];
    let arm = build::arm_of(&[0.25, 0.25], 0.01, &joints);
    let still = (0..numbers.below(3)).map(|_| disc(numbers.place(0.3, 0.5), numbers.within(0.02, 0.05)));
    let mut obstacles: Vec<Obstacle> = still.collect();
    for _ in 0..1 + numbers.below(3) {
        let from = numbers.place(0.2, 0.7);
        let mut time = 0.0;
        let mut at = from;
        let mut waypoints = vec![Waypoint { time, shift: Vector::new(0.0, 0.0) }];
        for _ in 0..2 + numbers.below(5) {
            let to = numbers.place(0.15, 0.7);
            // The base cannot get out of the way.
            if Segment::new(at, to).distance_to_point(Point::new(0.0, 0.0)) < 0.1 {
                continue;
            }
            time += to.distance(at) / numbers.within(0.03, 0.15) + 0.01;
            waypoints.push(Waypoint { time, shift: to - from });
            at = to;
        }
        let course = Course::Waypoints(waypoints);
        let motion = ObstacleMotion::new(course, Sight::Always, None).unwrap();
        obstacles.push(Obstacle { motion: Some(motion), ..disc(from, numbers.within(0.02, 0.05)) });
    }
    let scene = Scene::new(arm, build::grid(0.5, 0.02), obstacles, Vec::new()).unwrap();
    let mut free = || {
        let q = [numbers.within(-PI, PI), numbers.within(-2.5, 2.5)];
        (link_clearances(&scene, &q).into_iter().fold(f64::INFINITY, f64::min) > 0.01).then_some(q)
    };
    let (start, goal) = ((0..50).find_map(|_| free())?, (0..50).find_map(|_| free())?);
    Some(Episode { world: World::new(scene), start, goal })
}

#[derive(Debug, PartialEq, Clone, Copy)]
enum End {
    Arrived,
    /// When the judge saw the arm touch something (s).
    Contact(f64),
    TimeUp,
}

/// How an episode went.
struct Account {
    end: End,
    /// Updates whose motion was not safe.
    not_safe: usize,
    /// Whether the motion of the first update, and standing at its end, would have been free of contact all along.
    had_a_way: bool,
    /// Whether it is proved that nobody could have avoided the contact.
    was_doomed: bool,
}

/// Runs an episode in steps.
fn run(episode: &Episode, seed: u64) -> Account {
    const STEP: f64 = 0.05;
    let mut world = episode.world.clone();
    let goal = Place::Configuration(episode.goal.into());
    let mut replanner = Replanner::new(world.scene().clone(), episode.start, &goal, seed).unwrap();
    let mut account = Account { end: End::TimeUp, not_safe: 0, had_a_way: false, was_doomed: false };
    let mut state = State::rest(&episode.start);
    for step in 0..(LONGEST / STEP).round() as u32 {
        let now = STEP * f64::from(step);
        let known = world.seen_from(&state.position);
        let update = replanner.update(&known, now, &state, &|| true).unwrap();
        account.not_safe += usize::from(!update.verdict.is_safe());
        let motion: &Motion = replanner.motion();
        if step == 0 {
            account.had_a_way = is_clear(episode, motion, update.reaches_goal);
        }
        let next = match &update.decision {
            Decision::New(trajectory) => {
                assert!(trajectory.verdict().is_safe() && update.verdict.is_safe());
                Some(trajectory.motion())
            }
            Decision::Stop(motion) => {
                assert!(!update.verdict.is_safe() && !update.reaches_goal);
                Some(motion)
            }
            _ => None,
        };
        if let Some(next) = next {
            let begin = next.at(now);
            let jump = |a: &[f64], b: &[f64]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            assert_eq!(next, motion);
            assert!(jump(&begin.position, &state.position) < 1e-9);
            assert!(jump(&begin.velocity, &state.velocity) < 1e-9);
            assert!(jump(&begin.acceleration, &state.acceleration) < 1e-7);
        }
        for i in 1..=10 {
            let time = now + STEP * f64::from(i) / 10.0;
            let q = motion.at(time).position;
            world.advance(time, &q);
            if least(&world.obstacles(), [q[0], q[1]]) <= 0.0 {
                return Account { end: End::Contact(time), ..account };
            }
        }
        state = motion.at(now + STEP);
        if replanner.is_at_goal(&state) {
            return Account { end: End::Arrived, ..account };
        }
    }
    account
}

/// Least clearance by another library's distances.
fn least(obstacles: &[Obstacle], q: [f64; 2]) -> f64 {
    let elbow = [0.25 * q[0].cos(), 0.25 * q[0].sin()];
    let tip = [elbow[0] + 0.25 * (q[0] + q[1]).cos(), elbow[1] + 0.25 * (q[0] + q[1]).sin()];
    let links = [([0.0, 0.0], elbow), (elbow, tip)];
    let all = obstacles.iter().flat_map(|o| links.iter().map(move |&(a, b)| distance::distance(o, a, b)));
    all.fold(f64::INFINITY, f64::min) - 0.01
}

/// The obstacles where they are at `time` (s).
fn obstacles_at(episode: &Episode, time: f64) -> Vec<Obstacle> {
    let place = |obstacle: &Obstacle| {
        let [center] = *obstacle.shape.vertices() else { panic!("only discs are drawn") };
        let motion = obstacle.motion.as_ref();
        let shift = motion.map_or(Vector::new(0.0, 0.0), |motion| motion.course().shift_at(time));
        disc(center + shift, obstacle.shape.radius())
    };
    episode.world.scene().obstacles().iter().map(place).collect()
}

/// Whether the arm touches nothing that runs `motion`, the last one if it `is_last`, and else stands at its end as long as
/// an episode lasts.
fn is_clear(episode: &Episode, motion: &Motion, is_last: bool) -> bool {
    const LOOKS: f64 = 200.0;
    let end = if is_last { motion.end() } else { LONGEST };
    (0..=(LOOKS * end) as u32).all(|look| {
        let time = f64::from(look) / LOOKS;
        let q = motion.at(time).position;
        least(&obstacles_at(episode, time), [q[0], q[1]]) > 0.0
    })
}

/// Whether nobody could have kept the arm out of contact until `end` (s).
fn is_doomed(episode: &Episode, end: f64) -> bool {
    let discs_at = |time: f64| {
        let plain = |obstacle: Obstacle| {
            let [center] = *obstacle.shape.vertices() else { panic!("only discs are drawn") };
            ([center.x, center.y], obstacle.shape.radius())
        };
        obstacles_at(episode, time).into_iter().map(plain).collect()
    };
    [1.0, 2.0].into_iter().any(|finer| doom::is_doomed(episode.start, end, finer, discs_at))
}

/// Whether the goal is at no time free for the eight seconds that a motion there has to be safe for.
fn is_goal_never_free(episode: &Episode) -> bool {
    let is_free = |look: u32| least(&obstacles_at(episode, 0.1 * f64::from(look)), episode.goal) > 0.0;
    let free: Vec<bool> = (0..10 * (LONGEST as u32 + 8)).map(is_free).collect();
    !free.windows(80).any(|looks| looks.iter().all(|free| *free))
}

/// Accounts of the episodes of these seeds, on all cores, in the order of the seeds.
fn accounts(seeds: std::ops::Range<u64>) -> Vec<(u64, Episode, Account)> {
    let next = AtomicU64::new(seeds.start);
    let work = || {
        let mut done = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= seeds.end {
                return done;
            }
            let Some(episode) = episode(seed) else { continue };
            let mut account = run(&episode, seed);
            if let End::Contact(time) = account.end {
                println!("{seed}: contact at {time:.2} s, {} updates not safe", account.not_safe);
                account.was_doomed = is_doomed(&episode, time + AFTER_CONTACT);
            }
            done.push((seed, episode, account));
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<(u64, Episode, Account)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap()).collect()
    });
    all.sort_by_key(|(seed, ..)| *seed);
    all
}

/// Judges the episodes of these seeds, tells what became of them, and in how many there was a way at first.
fn judge(seeds: std::ops::Range<u64>) -> usize {
    let all = accounts(seeds);
    let count = |which: &dyn Fn(&Account) -> bool| all.iter().filter(|(.., account)| which(account)).count();
    let clear = |account: &Account| !matches!(account.end, End::Contact(_));
    let arrived = count(&|account| account.end == End::Arrived);
    let late: Vec<&Episode> = all
        .iter()
        .filter(|(.., account)| account.end == End::TimeUp)
        .map(|(_, episode, _)| episode)
        .collect();
    let barred = late.iter().filter(|episode| is_goal_never_free(episode)).count();
    let with_way = count(&|account| account.had_a_way);
    println!(
        "{} episodes, {with_way} of which began with a motion that was free of contact all along",
        all.len()
    );
    println!("{arrived} arrived without contact");
    println!(
        "{} on their way after {LONGEST} s without contact, in {barred} the goal was never free",
        late.len()
    );
    println!("{} of the others had no contact", count(&|account| !account.had_a_way && clear(account)));
    let hit: Vec<_> = all.iter().filter(|(.., account)| !clear(account)).collect();
    let seeds_of = |which: &dyn Fn(&Account) -> bool| -> Vec<u64> {
        hit.iter().filter(|(.., account)| which(account)).map(|(seed, ..)| *seed).collect()
    };
    let doomed = seeds_of(&|account| account.was_doomed);
    println!("{} had contact that no motion could have avoided: {doomed:?}", doomed.len());
    let other = seeds_of(&|account| !account.was_doomed);
    println!("{} had contact without that being proved: {other:?}", other.len());
    let lost = seeds_of(&|account| account.had_a_way);
    println!("{} had contact although they began with such a motion: {lost:?}", lost.len());
    for (seed, _, account) in &all {
        assert!(clear(account) || account.not_safe > 0, "seed {seed}: contact on a motion called safe");
    }
    assert!(lost.is_empty());
    assert!(arrived > late.len());
    with_way
}

#[test]
fn nothing_is_touched_in_random_episodes() {
    assert!(judge(0..40) >= 30);
}

/// `make campaign`.
#[test]
#[ignore = "ten thousand episodes take half an hour"]
fn nothing_is_touched_in_ten_thousand_episodes() {
    assert!(judge(100_000..111_100) >= 10_000);
}
