//! Arms that keep going among moving obstacles: random episodes before a judge that samples.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test that cannot be set up may panic; a campaign tells"
)]

#[path = "judge/distance.rs"]
mod distance;
#[path = "judge/doom.rs"]
mod doom;

use std::f64::consts::PI;

use elbowroom::arm::{Configuration, Joint, JointLimits, MotionLimits, TwoLinkArm};
use elbowroom::geometry::{Circle, Point, Segment, Vector};
use elbowroom::grid::Grid;
use elbowroom::online::{Decision, Replanner, World};
use elbowroom::path::clearances;
use elbowroom::scene::{Course, Mover, Obstacle, Place, Scene, Shape, Sight, Waypoint};
use elbowroom::trajectory::{Motion, State};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

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
    Obstacle { name: None, shape: Shape::Circle(Circle { center, radius }) }
}

struct Episode {
    world: World,
    movers: Vec<Mover>,
    start: Configuration<2>,
    goal: Place,
}

/// The paper's arm among still and moving discs whose courses are known.
fn episode(seed: u64) -> Option<Episode> {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(seed));
    let motion = MotionLimits { velocity: Some(1.5), acceleration: Some(4.0), jerk: Some(40.0) };
    let joint = |limits| Joint { limits, motion };
    let bend = JointLimits::range(-2.6, 2.6).unwrap();
    let joints = [joint(JointLimits::Continuous), joint(bend)];
    let arm = TwoLinkArm::new(Point::new(0.0, 0.0), [0.25, 0.25], 0.01, joints).unwrap();
    let grid = Grid::new([-0.5, 0.5], [-0.5, 0.5], 0.02).unwrap();
    let still = (0..numbers.below(3)).map(|_| disc(numbers.place(0.3, 0.5), numbers.within(0.02, 0.05)));
    let mut obstacles: Vec<Obstacle> = still.collect();
    let mut movers = Vec::new();
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
        movers.push(Mover::new(obstacles.len(), course, Sight::Always, None).unwrap());
        obstacles.push(disc(from, numbers.within(0.02, 0.05)));
    }
    let scene = Scene { arm, grid, obstacles, tasks: Vec::new() };
    let mut free = || {
        let q = [numbers.within(-PI, PI), numbers.within(-2.5, 2.5)];
        (clearances(&scene, &q).into_iter().fold(f64::INFINITY, f64::min) > 0.01).then_some(q)
    };
    let (start, goal) = ((0..50).find_map(|_| free())?, (0..50).find_map(|_| free())?);
    let world = World::new(scene.clone(), movers.clone());
    Some(Episode { world, movers, start: Configuration(start), goal: Place::Configuration(goal.to_vec()) })
}

#[derive(Debug, PartialEq, Clone, Copy)]
enum End {
    Arrived,
    TimeUp,
}

/// How an episode went.
struct Account {
    end: End,
    /// Looks at which the judge saw contact.
    contacts: usize,
    /// Updates whose motion was not safe.
    not_safe: usize,
    /// Whether nothing safe was found at the very beginning.
    trapped: bool,
    /// When it was over (s).
    time: f64,
}

/// Runs an episode in steps.
fn run(episode: &mut Episode, seed: u64) -> Account {
    const STEP: f64 = 0.05;
    let scene = episode.world.scene().clone();
    let mut replanner = Replanner::new(scene, &episode.movers, episode.start, &episode.goal, seed).unwrap();
    let mut account = Account { end: End::TimeUp, contacts: 0, not_safe: 0, trapped: false, time: 30.0 };
    let mut state = State::rest(&episode.start.0);
    for step in 0..600 {
        let now = STEP * f64::from(step);
        let q = Configuration([state.position[0], state.position[1]]);
        let seen = episode.world.seen_from(&q);
        let update = replanner.update(&seen, now, &state, &|| true);
        account.not_safe += usize::from(!update.verdict.is_safe());
        account.trapped |= step == 0 && !update.verdict.is_safe();
        let motion: &Motion = replanner.motion();
        if let Decision::New(next) | Decision::Stop(next) = &update.decision {
            let begin = next.at(now);
            let jump = |a: &[f64], b: &[f64]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            assert!(jump(&begin.position, &state.position) < 1e-9);
            assert!(jump(&begin.velocity, &state.velocity) < 1e-9);
            assert!(jump(&begin.acceleration, &state.acceleration) < 1e-7);
        }
        for i in 1..=10 {
            let time = now + STEP * f64::from(i) / 10.0;
            let q = motion.at(time).position;
            episode.world.advance(time, &Configuration([q[0], q[1]]));
            account.contacts += usize::from(least(&episode.world, &q) <= 0.0);
        }
        state = motion.at(now + STEP);
        if replanner.reaches_goal() && now > motion.end() {
            return Account { end: End::Arrived, time: now, ..account };
        }
    }
    account
}

/// Least clearance now by another library's distances.
fn least(world: &World, q: &[f64]) -> f64 {
    let elbow = [0.25 * q[0].cos(), 0.25 * q[0].sin()];
    let tip = [elbow[0] + 0.25 * (q[0] + q[1]).cos(), elbow[1] + 0.25 * (q[0] + q[1]).sin()];
    let obstacles = world.obstacles();
    let links = [([0.0, 0.0], elbow), (elbow, tip)];
    let all = obstacles.iter().flat_map(|o| links.iter().map(move |&(a, b)| distance::distance(o, a, b)));
    all.fold(f64::INFINITY, f64::min) - 0.01
}

/// Whether nobody could have kept the arm out of contact until `end` (s).
fn is_doomed(episode: &Episode, end: f64) -> bool {
    let scene = episode.world.scene();
    let discs_at = |time: f64| {
        let disc = |(i, obstacle): (usize, &Obstacle)| {
            let Shape::Circle(circle) = obstacle.shape else { panic!("only discs are drawn") };
            let mover = episode.movers.iter().find(|mover| mover.obstacle() == i);
            let center = circle.center + mover.map_or(Vector::new(0.0, 0.0), |m| m.course().shift_at(time));
            ([center.x, center.y], circle.radius)
        };
        scene.obstacles.iter().enumerate().map(disc).collect()
    };
    doom::is_doomed(episode.start.0, end, discs_at)
}

#[test]
fn nothing_is_touched_in_random_episodes() {
    let number = |name: &str, default: u64| std::env::var(name).map_or(default, |text| text.parse().unwrap());
    let (first, episodes) = (number("FIRST", 0), number("EPISODES", 30));
    let (mut arrived, mut late, mut trapped, mut escaped, mut doomed, mut hit) = (0, 0, 0, 0, 0, Vec::new());
    for seed in first..first + episodes {
        let Some(mut episode) = episode(seed) else { continue };
        let account = run(&mut episode, seed);
        let Account { end, contacts, not_safe, time, .. } = account;
        if std::env::var("TELL").is_ok() || contacts > 0 {
            println!("{seed}: {end:?} at {time:.2} s, {contacts} contacts, {not_safe} updates not safe");
        }
        assert!(contacts == 0 || not_safe > 0, "seed {seed}: contact on a motion called safe");
        if account.trapped {
            trapped += 1;
            escaped += usize::from(contacts == 0);
            doomed += usize::from(contacts > 0 && is_doomed(&episode, time));
        } else if contacts > 0 {
            hit.push(seed);
        }
        match end {
            End::Arrived if contacts == 0 => arrived += 1,
            End::TimeUp if contacts == 0 => late += 1,
            _ => {}
        }
    }
    println!(
        "{arrived} arrived, {late} on their way after 30 s; {trapped} began without anything safe, of which {escaped} got \
         out and {doomed} could not by any motion; contacts in the others: {hit:?}"
    );
    assert!(hit.is_empty());
    assert!(arrived > late);
}
