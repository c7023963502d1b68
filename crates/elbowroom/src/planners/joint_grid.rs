use std::cell::RefCell;

use super::sheets::direct;
use crate::arm::{Configuration, JointLimits, Posture};
use crate::path::{certified_clearance, motion_bounds, sweep_is_free};
use crate::scene::Scene;
use crate::search::Graph;

/// Grids of more nodes are not made.
const MOST_NODES: usize = 1 << 21;

/// Steps to the sixteen neighbours, once round; the way back is eight further.
const DIRECTIONS: [(isize, isize); 16] = [
    (1, 0),
    (2, 1),
    (1, 1),
    (1, 2),
    (0, 1),
    (-1, 2),
    (-1, 1),
    (-2, 1),
    (-1, 0),
    (-2, -1),
    (-1, -1),
    (-1, -2),
    (0, -1),
    (1, -2),
    (1, -1),
    (2, -1),
];

/// Configurations on a grid of joint angles, and starts and goals between them; edges are certified straight turns.
/// A continuous joint closes to a ring.
pub(crate) struct JointGrid<'a> {
    scene: &'a Scene,
    axes: [Axis; 2],
    /// What a radian of each joint costs.
    weights: [f64; 2],
    may_flip: bool,
    places: Vec<Place>,
    nodes: RefCell<Vec<Known>>,
}

/// The angles of one joint that belong to the grid.
#[derive(Clone, Copy)]
struct Axis {
    first: f64,
    step: f64,
    count: usize,
    ring: bool,
}

/// A configuration off the grid.
struct Place {
    q: Configuration<2>,
    joined: Vec<(usize, f64)>,
}

/// What is known of a node.
#[derive(Clone, Copy)]
struct Known {
    /// Of each link, beyond what is to be kept (m); not a number before it is asked for.
    clearance: [f32; 2],
    looked_at: u16,
    certified: u16,
}

impl Axis {
    fn new(limits: &JointLimits, step: f64) -> Self {
        let (first, length, ring) = match *limits {
            JointLimits::Continuous => (-std::f64::consts::PI, std::f64::consts::TAU, true),
            JointLimits::Range { min, max } => (min, max - min, false),
        };
        let steps = (length / step).ceil().max(1.0);
        Self { first, step: length / steps, count: steps as usize + usize::from(!ring), ring }
    }

    fn angle(&self, index: usize) -> f64 {
        self.first + self.step * index as f64
    }

    fn neighbour(&self, index: usize, by: isize) -> Option<usize> {
        let count = self.count as isize;
        let moved = index as isize + by;
        if self.ring {
            Some(moved.rem_euclid(count) as usize)
        } else {
            (0..count).contains(&moved).then_some(moved as usize)
        }
    }

    /// The indices on both sides of `angle`.
    fn around(&self, angle: f64) -> [Option<usize>; 2] {
        let below = if self.step > 0.0 { ((angle - self.first) / self.step).floor() } else { 0.0 };
        [0, 1].map(|k| {
            let index = below as isize + k;
            if self.ring {
                return Some(index.rem_euclid(self.count as isize) as usize);
            }
            usize::try_from(index).ok().filter(|index| *index < self.count)
        })
    }
}

impl<'a> JointGrid<'a> {
    /// The grid with about `step` (rad) between angles, or `None` if it would have more than [`MOST_NODES`]; a radian of
    /// joint `j` costs `weights[j]`. The posture never changes unless `may_flip`.
    pub(crate) fn new(scene: &'a Scene, step: f64, weights: [f64; 2], may_flip: bool) -> Option<Self> {
        let axes = [0, 1].map(|j| Axis::new(&scene.arm.joints()[j].limits, step));
        let len = axes[0].count.checked_mul(axes[1].count).filter(|len| *len <= MOST_NODES)?;
        let unknown = Known { clearance: [f32::NAN; 2], looked_at: 0, certified: 0 };
        let nodes = RefCell::new(vec![unknown; len]);
        Some(Self { scene, axes, weights, may_flip, places: Vec::new(), nodes })
    }

    fn grid_len(&self) -> usize {
        self.axes[0].count * self.axes[1].count
    }

    /// A node for `q`, joined to the grid around it and to the places already there.
    pub(crate) fn insert(&mut self, q: Configuration<2>) -> usize {
        let node = self.len();
        let mut joined = Vec::new();
        let [around1, around2] = [0, 1].map(|j| self.axes[j].around(q.0[j]));
        for i in around1.into_iter().flatten() {
            for k in around2.into_iter().flatten() {
                let other = k * self.axes[0].count + i;
                if let Some(cost) = self.certified_cost(&q, &self.configuration(other))
                    && joined.iter().all(|&(known, _)| known != other)
                {
                    joined.push((other, cost));
                }
            }
        }
        let grid = self.grid_len();
        let reach = 2.0 * self.axes[0].step.max(self.axes[1].step);
        for i in 0..self.places.len() {
            let place = self.places[i].q;
            if direct(&self.scene.arm, &place, &q).is_some_and(|to| place.distance(&to) <= reach)
                && let Some(cost) = self.certified_cost(&place, &q)
            {
                joined.push((grid + i, cost));
                self.places[i].joined.push((node, cost));
            }
        }
        self.places.push(Place { q, joined });
        node
    }

    fn certified_cost(&self, from: &Configuration<2>, to: &Configuration<2>) -> Option<f64> {
        if !self.keeps_posture(from, to) {
            return None;
        }
        let to = direct(&self.scene.arm, from, to)?;
        sweep_is_free(self.scene, from, &to).then(|| self.cost(from, &to).max(f64::MIN_POSITIVE.sqrt()))
    }

    /// Whether the posture is the same at both ends, where it has to be: a grid point with the links in line would lead
    /// from one posture to the other.
    fn keeps_posture(&self, from: &Configuration<2>, to: &Configuration<2>) -> bool {
        self.may_flip
            || match (Posture::of(from), Posture::of(to)) {
                (Some(a), Some(b)) => a == b,
                (None, Some(_)) => self.places.iter().any(|place| place.q == *from),
                (Some(_), None) => self.places.iter().any(|place| place.q == *to),
                (None, None) => false,
            }
    }

    fn cost(&self, from: &Configuration<2>, to: &Configuration<2>) -> f64 {
        let [a, b] = [0, 1].map(|j| (to.0[j] - from.0[j]) * self.weights[j]);
        a.hypot(b)
    }

    /// The configuration at `node`, a continuous joint within a turn.
    pub(crate) fn configuration(&self, node: usize) -> Configuration<2> {
        match node.checked_sub(self.grid_len()) {
            None => {
                let columns = self.axes[0].count;
                Configuration([self.axes[0].angle(node % columns), self.axes[1].angle(node / columns)])
            }
            Some(i) => self.places[i].q,
        }
    }

    fn clearance(&self, node: usize, q: &Configuration<2>) -> [f32; 2] {
        let known = self.nodes.borrow()[node].clearance;
        if !known[0].is_nan() {
            return known;
        }
        // Rounded down, so that a glance promises no more than there is.
        let found = certified_clearance(self.scene, q).map(|c| (c as f32).next_down());
        self.nodes.borrow_mut()[node].clearance = found;
        found
    }

    fn edge(
        &self,
        node: usize,
        other: usize,
        direction: usize,
        from: &Configuration<2>,
        to: &Configuration<2>,
    ) -> bool {
        let bit = 1u16 << direction;
        let known = self.nodes.borrow()[node];
        if known.looked_at & bit != 0 {
            return known.certified & bit != 0;
        }
        let (a, b) = (self.clearance(node, from), self.clearance(other, to));
        let certified = a.iter().chain(&b).all(|c| *c > 0.0) && {
            let bounds = motion_bounds(&self.scene.arm, from, to);
            (0..2).all(|link| f64::from(a[link]) + f64::from(b[link]) > bounds[link])
                || sweep_is_free(self.scene, from, to)
        };
        let back = 1u16 << ((direction + 8) % 16);
        let mut nodes = self.nodes.borrow_mut();
        for (node, bit) in [(node, bit), (other, back)] {
            nodes[node].looked_at |= bit;
            nodes[node].certified |= if certified { bit } else { 0 };
        }
        certified
    }
}

impl Graph for JointGrid<'_> {
    fn len(&self) -> usize {
        self.grid_len() + self.places.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        if let Some(i) = node.checked_sub(self.grid_len()) {
            self.places[i].joined.iter().for_each(|&(other, cost)| visit(other, cost));
            return;
        }
        let columns = self.axes[0].count;
        let (i, k) = (node % columns, node / columns);
        let from = self.configuration(node);
        for (direction, (di, dk)) in DIRECTIONS.into_iter().enumerate() {
            let (Some(ni), Some(nk)) = (self.axes[0].neighbour(i, di), self.axes[1].neighbour(k, dk)) else {
                continue;
            };
            let other = nk * columns + ni;
            let turn = [di as f64 * self.axes[0].step, dk as f64 * self.axes[1].step];
            let to = Configuration([from.0[0] + turn[0], from.0[1] + turn[1]]);
            if other != node
                && self.keeps_posture(&from, &to)
                && self.edge(node, other, direction, &from, &to)
            {
                visit(other, self.cost(&from, &to));
            }
        }
        for (i, place) in self.places.iter().enumerate() {
            for &(other, cost) in &place.joined {
                if other == node {
                    visit(self.grid_len() + i, cost);
                }
            }
        }
    }
}
