//! The verifier among obstacles that move: closed forms, and a judge that samples space and time.

#![expect(clippy::unwrap_used, reason = "a test that cannot be set up may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
#[path = "judge/distance.rs"]
mod distance;

use std::f64::consts::PI;

use build::{circle, polygon};
use elbowroom::arm::Joint;
use elbowroom::geometry::Vector;
use elbowroom::path::straight_move_is_free;
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, ObstacleMotionError, Scene, Sight, Waypoint};
use elbowroom::trajectory::{Motion, Piece, durations_by_length, quintic_through, vias_at};
use elbowroom::verify::{Against, FLOOR, Trajectory, Verdict, VerifySettings, Violation, verify};
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
}

fn scene(lengths: &[f64], half_width: f64, obstacles: Vec<Obstacle>) -> Scene {
    build::scene(build::arm_of(lengths, half_width, &vec![Joint::CONTINUOUS; lengths.len()]), obstacles)
}

/// The obstacle on its way, never faster than its course, or than what is declared (m/s).
fn moving(obstacle: Obstacle, course: Course, greatest_speed: Option<f64>) -> Obstacle {
    let motion = ObstacleMotion::new(course, Sight::Always, greatest_speed).unwrap();
    Obstacle { motion: Some(motion), ..obstacle }
}

fn judged(scene: &Scene, motion: &Motion) -> Verdict {
    verify(scene, motion, &VerifySettings::default())
}

fn standing(q: &[f64], start: f64, duration: f64) -> Motion {
    let coefficients = q.iter().map(|&q| [q, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
    Motion::new(vec![Piece { start, duration, coefficients }]).unwrap()
}

fn waypoints(points: &[(f64, f64, f64)]) -> Course {
    let point = |&(time, x, y): &(f64, f64, f64)| Waypoint { time, shift: Vector::new(x, y) };
    Course::Waypoints(points.iter().map(point).collect())
}

#[test]
fn a_disc_that_comes_towards_a_standing_arm_touches_it_when_it_should() {
    // The arm lies along the x axis; the disc comes down from y = 1 at 0.25 m/s.
    let still = || circle(0.7, 1.0, 0.1);
    let among = |obstacle| scene(&[0.5, 0.5], 0.02, vec![obstacle]);
    let drift = |start: f64| Course::Drift { start, velocity: Vector::new(0.0, -0.25) };
    let exact = (1.0 - 0.1 - 0.02) / 0.25;
    for start in [0.0, 1.5] {
        let scene = among(moving(still(), drift(start), None));
        let verdict = judged(&scene, &standing(&[0.0, 0.0], 0.0, 10.0));
        let [Violation::Contact { time, link: 2, against: Against::Obstacle(0), .. }] =
            verdict.violations[..]
        else {
            panic!("{verdict:?}")
        };
        assert!((time - (start + exact)).abs() < 1e-7, "{time} {start}");
    }
    // It stops a hair before the arm, or touches it just so.
    for (gap, safe) in [(1e-6, true), (0.0, false)] {
        let course = waypoints(&[(0.0, 0.0, 0.0), (4.0, 0.0, -0.88 + gap)]);
        let scene = among(moving(still(), course, None));
        let verdict = judged(&scene, &standing(&[0.0, 0.0], 0.0, 10.0));
        assert_eq!(verdict.is_safe(), safe, "{gap} {verdict:?}");
    }
    assert!(judged(&among(still()), &standing(&[0.0, 0.0], 0.0, 10.0)).is_safe());
}

#[test]
fn it_matters_when_a_motion_runs() {
    // A disc crosses the arm's place between 2 s and 4 s, and is away before and after.
    let course = waypoints(&[(0.0, 0.0, 0.0), (6.0, 0.0, -2.0)]);
    let scene = scene(&[0.5, 0.5], 0.0, vec![moving(circle(0.7, 1.0, 0.1), course, None)]);
    for (start, duration, safe) in [(0.0, 2.6, true), (2.0, 2.0, false), (3.4, 5.0, true), (0.0, 9.0, false)]
    {
        let motion = standing(&[0.0, 0.0], start, duration);
        let verdict = judged(&scene, &motion);
        assert_eq!(verdict.is_safe(), safe, "{start} {duration} {verdict:?}");
        assert_eq!(Trajectory::certify(&scene, motion, &VerifySettings::default()).is_ok(), safe);
    }
}

#[test]
fn no_straight_move_is_certified_where_an_obstacle_moves() {
    let far = circle(1.5, 1.5, 0.1);
    let certified = |obstacle| {
        let scene = scene(&[0.5, 0.5], 0.01, vec![obstacle]);
        straight_move_is_free(&scene, &[0.0, 0.0], &[0.1, 0.2])
    };
    assert!(certified(far.clone()));
    assert!(!certified(moving(far.clone(), waypoints(&[(0.0, 0.0, 0.0)]), None)));
    assert!(!certified(moving(far, Course::Absent, None)));
}

#[test]
fn the_least_clearance_to_a_passing_disc_is_that_of_its_line() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(1));
    for _ in 0..500 {
        // Past the tip of an arm that stands along the x axis, on a line x = 1.2 .. 1.6.
        let (x, radius) = (numbers.within(1.2, 1.6), numbers.within(0.01, 0.15));
        let course = Course::Drift { start: 0.0, velocity: Vector::new(0.0, numbers.within(0.1, 3.0)) };
        let scene = scene(&[0.5, 0.5], 0.01, vec![moving(circle(x, -3.0, radius), course, None)]);
        let verdict = judged(&scene, &standing(&[0.0, 0.0], 0.0, 60.0));
        let least = verdict.least_clearance.unwrap();
        let exact = x - 1.0 - radius - 0.01;
        assert!(verdict.is_safe() && least.at_least.unwrap() <= exact && least.distance >= exact - 1e-12);
        assert!(least.distance <= 1.011 * exact + 1e-6, "{least:?} {exact}");
    }
}

#[test]
fn what_nobody_knows_may_be_anywhere_in_time() {
    let course = Course::Unknown { seen: 5.0, shift: Vector::new(0.0, 0.0) };
    let scene = scene(&[0.5, 0.5], 0.0, vec![moving(circle(0.7, 1.0, 0.1), course, Some(0.3))]);
    // 0.9 m away at 0.3 m/s: 3 s.
    assert!(judged(&scene, &standing(&[0.0, 0.0], 5.0, 2.99)).is_safe());
    let verdict = judged(&scene, &standing(&[0.0, 0.0], 5.0, 3.5));
    let [Violation::Contact { time, link: 2, .. }, ..] = verdict.violations[..] else {
        panic!("{verdict:?}")
    };
    assert!((time - 8.0).abs() < 1e-7, "{time}");
}

#[test]
fn a_judge_that_samples_space_and_time_agrees() {
    const SAMPLES: usize = 3000;
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(2));
    let (mut safe, mut contacts) = (0, 0);
    for case in 0..600 {
        let links = 2 + numbers.below(3);
        let lengths: Vec<f64> = (0..links).map(|_| numbers.within(0.1, 0.4)).collect();
        let reach: f64 = lengths.iter().sum();
        let mut obstacles: Vec<Obstacle> = (0..1 + numbers.below(3))
            .map(|_| {
                let (way, angle) = (numbers.within(0.5, 1.5) * reach, numbers.within(-PI, PI));
                let (x, y) = (way * angle.cos(), way * angle.sin());
                if numbers.below(2) == 0 {
                    return circle(x, y, numbers.within(0.005, 0.15));
                }
                polygon(&[(0.0, 0.0), (0.2, 0.02), (0.05, 0.15)].map(|(dx, dy)| [x + dx, y + dy]))
            })
            .collect();
        let half_width = [0.0, 0.01][numbers.below(2)];
        let duration = numbers.within(1.0, 6.0);
        if case % 4 > 0 {
            let mut on_its_way = |obstacle| {
                let mut place = || Vector::new(numbers.within(-0.6, 0.6), numbers.within(-0.6, 0.6));
                let course = if case % 3 == 0 {
                    Course::Drift { start: 0.3, velocity: place() }
                } else {
                    let times = [0.0, 0.2, 0.25, 0.7].map(|share| share * duration);
                    Course::Waypoints(times.map(|time| Waypoint { time, shift: place() }).to_vec())
                };
                moving(obstacle, course, None)
            };
            obstacles = obstacles.into_iter().map(&mut on_its_way).collect();
        }
        let scene = scene(&lengths, half_width, obstacles);
        let spread = [0.2, 2.0][numbers.below(2)];
        let places: Vec<Vec<f64>> = (0..2 + numbers.below(3))
            .map(|_| (0..links).map(|_| numbers.within(-spread, spread)).collect())
            .collect();
        let vias = vias_at(&places);
        let motion = Motion::new(quintic_through(&vias, &durations_by_length(&vias, duration))).unwrap();
        let verdict = judged(&scene, &motion);
        let mut least = f64::INFINITY;
        for i in 0..=SAMPLES {
            let time = duration * i as f64 / SAMPLES as f64;
            least = least.min(clearance(&scene, &motion, time));
        }
        if verdict.is_safe() {
            safe += 1;
            assert!(least > 0.0, "case {case}: called safe, {least}");
            let at_least = verdict.least_clearance.unwrap().at_least.unwrap();
            assert!(at_least <= least + 1e-12, "case {case}: {at_least} {least}");
        } else {
            contacts += 1;
            for violation in &verdict.violations {
                let Violation::Contact { time, .. } = violation else { panic!("case {case}: {violation:?}") };
                let there = clearance(&scene, &motion, *time);
                assert!(there <= FLOOR + 1e-11, "case {case}: {violation:?} {there}");
            }
        }
    }
    assert!(safe > 100 && contacts > 100, "{safe} {contacts}");
}

/// Least clearance at `time`: the obstacles moved bodily, distances by another library, textbook kinematics.
fn clearance(scene: &Scene, motion: &Motion, time: f64) -> f64 {
    let q = motion.at(time).position;
    let mut points = vec![[0.0, 0.0]];
    for (k, length) in scene.arm().lengths().iter().enumerate() {
        let direction: f64 = q[..=k].iter().sum();
        let [x, y] = points[k];
        points.push([x + length * direction.cos(), y + length * direction.sin()]);
    }
    let mut least = f64::INFINITY;
    for obstacle in scene.obstacles() {
        let shift = obstacle.motion.as_ref().map_or([0.0, 0.0], |motion| match motion.course() {
            Course::Drift { start, velocity } => {
                [velocity.x, velocity.y].map(|v| v * (time - start).max(0.0))
            }
            Course::Waypoints(points) => {
                let along = |pair: &[Waypoint]| {
                    let share = ((time - pair[0].time) / (pair[1].time - pair[0].time)).clamp(0.0, 1.0);
                    [(pair[1].shift.x - pair[0].shift.x) * share, (pair[1].shift.y - pair[0].shift.y) * share]
                };
                let first = [points[0].shift.x, points[0].shift.y];
                points.windows(2).map(along).fold(first, |sum, step| [sum[0] + step[0], sum[1] + step[1]])
            }
            Course::Unknown { .. } | Course::Chase { .. } | Course::Absent => panic!("not drawn here"),
        });
        for pair in points.windows(2) {
            let [a, b] = [0, 1].map(|end| [pair[end][0] - shift[0], pair[end][1] - shift[1]]);
            least = least.min(distance::distance(obstacle, a, b) - scene.arm().half_width());
        }
    }
    least
}

#[test]
fn motions_that_make_no_sense_are_named() {
    let still = || waypoints(&[(0.0, 0.0, 0.0)]);
    let new = |course, sight, speed| ObstacleMotion::new(course, sight, speed).map(|_| ());
    assert_eq!(
        new(Course::Waypoints(vec![]), Sight::Always, None),
        Err(ObstacleMotionError::Waypoints { found: 0 })
    );
    let back = waypoints(&[(0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (1.0, 2.0, 0.0)]);
    assert_eq!(
        new(back, Sight::Always, None),
        Err(ObstacleMotionError::Times { index: 2, time: 1.0, before: 1.0 })
    );
    let fast = waypoints(&[(0.0, 0.0, 0.0), (2.0, 3.0, 4.0)]);
    assert_eq!(
        new(fast.clone(), Sight::Always, Some(2.4)),
        Err(ObstacleMotionError::TooFast { found: 2.5, declared: 2.4 })
    );
    let motion = ObstacleMotion::new(fast, Sight::Always, None).unwrap();
    assert_eq!((motion.greatest_speed(), motion.declared_speed()), (2.5, None));
    assert_eq!(motion.on(Course::Absent).declared_speed(), Some(2.5));
    for sight in [Sight::From(f64::NAN), Sight::Within(-1.0), Sight::Within(f64::INFINITY)] {
        assert!(matches!(new(still(), sight, None), Err(ObstacleMotionError::Number { .. })));
    }
    let odd = Course::Drift { start: 0.0, velocity: Vector::new(f64::INFINITY, 0.0) };
    assert!(matches!(
        new(odd, Sight::Always, None),
        Err(ObstacleMotionError::Number { what: "velocity", .. })
    ));
    assert!(matches!(new(still(), Sight::Always, Some(-1.0)), Err(ObstacleMotionError::Number { .. })));
}
