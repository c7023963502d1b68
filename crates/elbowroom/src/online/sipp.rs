use std::cmp::{Ordering, Reverse};
use std::collections::{BinaryHeap, HashMap};

use super::safe_intervals::{SafeIntervals, Standing};
use super::settings::MOST_EXPANSIONS;

/// Turns between places a `step` (rad) apart in one joint or both, each in the same `time` (s).
#[derive(Debug, Clone, Copy)]
pub(super) struct Lattice {
    pub(super) step: f64,
    pub(super) time: f64,
}

/// A place on a way, and from when to when the arm stands there (s).
pub(super) struct Stay {
    pub(super) q: [f64; 2],
    pub(super) arrive: f64,
    pub(super) leave: f64,
}

/// On a lattice about where the arm starts.
type Cell = [i32; 2];

/// A cell, and which of the intervals in which it is free.
type Node = (Cell, usize);

/// How a node is reached the soonest, as far as is known.
#[derive(Clone, Copy)]
struct Reached {
    arrive: f64,
    from: Option<Node>,
}

/// The way from `start` to the place where the arm can stay for good that it reaches the soonest; or else to the place
/// where it can stay the longest. `None` if it cannot be at `start` when it begins.
///
/// Safe interval path planning (Phillips and Likhachev, 2011): who enters a place sooner in the same interval can do all
/// that others can, for the arm may wait; so each interval is entered once. Turns are examined only at their ends.
pub(super) fn earliest_safe_place(
    free: &SafeIntervals,
    start: &[f64; 2],
    lattice: Lattice,
    keep_going: &dyn Fn() -> bool,
) -> Option<Vec<Stay>> {
    let place = |cell: Cell| [0, 1].map(|j| start[j] + lattice.step * f64::from(cell[j]));
    let here = free.at(start);
    here.intervals.first().filter(|interval| interval[0] <= free.now)?;
    let first = ([0, 0], 0);
    let mut standing = HashMap::from([([0, 0], here)]);
    let mut reached = HashMap::from([(first, Reached { arrive: free.now, from: None })]);
    let mut open = BinaryHeap::from([Reverse((Time(free.now), first))]);
    let mut best = (f64::NEG_INFINITY, first);
    let mut expansions = 0;
    while let Some(Reverse((Time(arrive), node))) = open.pop() {
        if arrive > reached[&node].arrive {
            continue;
        }
        let (cell, k) = node;
        let Standing { intervals, doubtful_from } = &standing[&cell];
        let (end, leave_before) = (intervals[k][1], intervals[k][1].min(*doubtful_from));
        if end > best.0 {
            best = (end, node);
        }
        expansions += 1;
        if end.is_infinite() || expansions > MOST_EXPANSIONS || !keep_going() {
            break;
        }
        for turn in TURNS {
            let next = [cell[0] + turn[0], cell[1] + turn[1]];
            let there = standing.entry(next).or_insert_with(|| free.at(&place(next)));
            for (k, &[from, until]) in there.intervals.iter().enumerate() {
                let at = (arrive + lattice.time).max(from);
                if at >= until.min(there.doubtful_from) || at - lattice.time > leave_before {
                    continue;
                }
                if reached.get(&(next, k)).is_none_or(|known| at < known.arrive) {
                    reached.insert((next, k), Reached { arrive: at, from: Some(node) });
                    open.push(Reverse((Time(at), (next, k))));
                }
            }
        }
    }
    let mut way = Vec::new();
    let (mut node, mut leave) = (Some(best.1), f64::INFINITY);
    while let Some((cell, k)) = node {
        let Reached { arrive, from } = reached[&(cell, k)];
        way.push(Stay { q: place(cell), arrive, leave });
        (node, leave) = (from, arrive - lattice.time);
    }
    way.reverse();
    Some(way)
}

const TURNS: [Cell; 8] = [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]];

/// In order.
#[derive(PartialEq)]
struct Time(f64);

impl Eq for Time {}

impl PartialOrd for Time {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Time {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::{Lattice, TURNS, earliest_safe_place};
    use crate::arm::{Arm, Joint, JointLimits, MotionLimits};
    use crate::geometry::{Point, Shape, Vector};
    use crate::grid::Grid;
    use crate::online::placed::still;
    use crate::online::safe_intervals::SafeIntervals;
    use crate::path::link_clearances;
    use crate::random::unit;
    use crate::scene::{Course, Obstacle, ObstacleMotion, Scene, Sight, Waypoint};

    const ROOM: f64 = 0.01;
    const HORIZON: f64 = 20.0;
    const LATTICE: Lattice = Lattice { step: 0.4, time: 0.5 };
    /// Between two samples of the check (s).
    const TICK: f64 = 0.025;
    /// No disc gets farther in a tick (m).
    const SLACK: f64 = 0.012;

    fn case(seed: u64) -> (Scene, [f64; 2]) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut unit = move || unit(&mut rng);
        let range = |most: f64| JointLimits::range(-most, most).unwrap();
        let joints = [2.2, 2.4].map(|most| Joint { limits: range(most), motion: MotionLimits::default() });
        let arm = Arm::new(Point::new(0.0, 0.0), vec![0.25, 0.25], 0.01, joints.to_vec(), false).unwrap();
        let grid = Grid::new([-0.5, 0.5], [-0.5, 0.5], 0.05).unwrap();
        let mut obstacles = Vec::new();
        for _ in 0..3 {
            let mut place = || Vector::polar(0.15 + 0.5 * unit(), std::f64::consts::TAU * unit());
            let from = place();
            let course = Course::Waypoints(
                (0..4)
                    .map(|k| Waypoint {
                        time: 3.0 * f64::from(k),
                        shift: if k == 0 { Vector::new(0.0, 0.0) } else { place() + -from },
                    })
                    .collect(),
            );
            let motion = ObstacleMotion::new(course, Sight::Always, None).unwrap();
            let circle = Shape::circle(Point::new(0.0, 0.0) + from, 0.02 + 0.04 * unit()).unwrap();
            obstacles.push(Obstacle { motion: Some(motion), ..Obstacle::still(circle) });
        }
        let start = [1.5 - 3.0 * unit(), 2.0 - 4.0 * unit()];
        (Scene::new(arm, grid, obstacles, Vec::new()).unwrap(), start)
    }

    fn clearance_at(scene: &Scene, q: &[f64; 2], time: f64) -> f64 {
        let now = still(scene, |_, obstacle| Some(obstacle.motion.as_ref()?.course().shift_at(time)));
        link_clearances(&now, q).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// When a flood in time first gets to a cell that stays free, for arms that keep `clearance` (m).
    fn flood(scene: &Scene, start: &[f64; 2], clearance: f64) -> Option<f64> {
        let ticks = (HORIZON / TICK) as usize;
        let turn = (LATTICE.time / TICK).round() as usize;
        let mut free: std::collections::HashMap<[i32; 2], Vec<bool>> = Default::default();
        let mut look = |cell: [i32; 2], tick: usize| {
            let line = free.entry(cell).or_insert_with(|| {
                let q = [0, 1].map(|j| start[j] + LATTICE.step * f64::from(cell[j]));
                let within = scene.arm().within_limits(&q);
                (0..=ticks)
                    .map(|tick| within && clearance_at(scene, &q, TICK * tick as f64) > clearance)
                    .collect()
            });
            (line[tick], line[tick..].iter().all(|free| *free))
        };
        let mut arrivals: Vec<HashSet<[i32; 2]>> = vec![HashSet::new(); ticks + turn + 1];
        let mut here = HashSet::from([[0, 0]]);
        for tick in 0..=ticks {
            here.extend(std::mem::take(&mut arrivals[tick]));
            here.retain(|cell| look(*cell, tick).0);
            for cell in &here {
                if look(*cell, tick).1 {
                    return Some(TICK * tick as f64);
                }
                for step in TURNS {
                    arrivals[tick + turn].insert([cell[0] + step[0], cell[1] + step[1]]);
                }
            }
        }
        None
    }

    #[test]
    fn a_place_to_stay_is_reached_as_soon_as_by_a_flood_in_time() {
        let (mut found, mut lost) = (0, 0);
        for seed in 0..300 {
            let (scene, start) = case(seed);
            let free = SafeIntervals { scene: &scene, clearance: ROOM, now: 0.0, horizon: HORIZON };
            let way = earliest_safe_place(&free, &start, LATTICE, &|| true);
            let Some(way) = way else {
                assert!(clearance_at(&scene, &start, 0.0) <= ROOM, "seed {seed}");
                continue;
            };
            let last = way.last().unwrap();
            let intervals = free.at(&last.q).intervals;
            let stays = intervals.iter().any(|i| i[0] <= last.arrive && i[1].is_infinite());
            if let Some(soonest) = flood(&scene, &start, ROOM + SLACK) {
                found += 1;
                assert!(stays && last.arrive <= soonest + 1e-9, "seed {seed}: {soonest} s");
            }
            if stays {
                let soonest = flood(&scene, &start, ROOM - SLACK).unwrap();
                assert!(soonest <= last.arrive + TICK + 1e-9, "seed {seed}: {soonest} s");
            } else {
                lost += 1;
            }
            for stay in &way {
                let leave = stay.leave.min(HORIZON);
                for look in 0..=20 {
                    let time = stay.arrive + (leave - stay.arrive) * f64::from(look) / 20.0;
                    let is_last = stay.leave.is_infinite() && !stays;
                    assert!(is_last || clearance_at(&scene, &stay.q, time) > ROOM - SLACK, "seed {seed}");
                }
            }
        }
        assert!(found > 80 && lost > 40);
    }
}
