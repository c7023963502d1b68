//! A fine grid of joint angles whose steps are certified.

use super::*;

/// What brute force finds.
pub(crate) struct Judged {
    /// The shortest certified way over the grid in joint travel (rad), tip travel (m) and time at greatest speed
    /// (s), if there is one.
    pub(crate) least: Option<[f64; 3]>,
    /// Whether start and goal are parted even where every place that is not deep in an obstacle counts as free.
    pub(crate) parted: bool,
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

pub(crate) fn judged(scene: &Scene, task: &Task, points: usize, speeds: [f64; 2]) -> Option<Judged> {
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
