//! The shortest path by intervals: a search node is a stretch of a side and the last bend, from which all of the
//! stretch is seen. Nothing is discretised: the result is exact up to rounding, and rounding lets paths see past
//! corners rather than hide behind them.

use std::collections::{BinaryHeap, HashMap};

use super::Measure;
use super::cells::{Across, NONE, NavigationMesh};
use super::crossed::{Crossed, with_rounding};
use super::node::{Bent, Goal, Node, Waiting};
use super::sight::{below, crossing_of, seen, snapped};
use crate::geometry::{Point, Vector};

/// How near to a vertex a ray meets it, in roundings of the mesh.
const SNAP: f64 = 10.0;

/// Search nodes between two questions whether to keep going.
const NODES_PER_LOOK: usize = 4096;

/// A place on a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshPoint {
    /// A cell that holds it.
    pub cell: usize,
    /// Where it is in the cell's plane.
    pub point: Point,
}

/// A shortest path.
#[derive(Debug, Clone, PartialEq)]
pub struct Geodesic {
    /// What it costs.
    pub cost: f64,
    /// Where it begins, where it enters each cell or bends, and where it ends; between two of them it is straight
    /// and stays in the cell of the first. A place on a seam has the cell entered.
    pub places: Vec<MeshPoint>,
    /// For each place, how far planes were shifted since the start.
    pub shifts: Vec<Vector>,
}

/// The cheapest path from one of `starts` to one of `goals`, or `None` if walls part them all, or `keep_going`,
/// asked every few thousand steps, said no.
///
/// `images` are points such that going from a place of any cell to a goal costs at least as much as going straight
/// to the nearest of them in the cell's plane: the goals themselves in all shifts that count; none to search blindly.
///
/// # Reference
/// Cui, Harabor and Grastien, *Compromise-free pathfinding on a navigation mesh*, IJCAI 2017 (Polyanya); here on
/// meshes that may wrap round.
pub fn geodesic(
    mesh: &NavigationMesh,
    starts: &[MeshPoint],
    goals: &[MeshPoint],
    measure: Measure,
    images: &[Point],
    keep_going: &dyn Fn() -> bool,
) -> Option<Geodesic> {
    let reached = mesh.reached_from(starts.iter().map(|start| start.cell));
    // Without a way the search would go round and round.
    let goals: Vec<MeshPoint> = goals.iter().copied().filter(|goal| reached[goal.cell]).collect();
    if goals.is_empty() {
        return None;
    }
    let mut search = Search {
        mesh,
        measure,
        images,
        to_go: vec![f64::NAN; mesh.len()],
        goals_in: vec![Vec::new(); mesh.len()],
        nodes: Vec::new(),
        waiting: BinaryHeap::new(),
        costs: vec![f64::INFINITY; mesh.sides.len()],
        turned: vec![[f64::INFINITY; 2]; mesh.sides.len()],
        crossed: HashMap::new(),
    };
    for goal in &goals {
        search.goals_in[goal.cell].push(goal.point);
    }
    for start in starts {
        search.start(start);
    }
    // No shortest path is longer than one that goes round every cell; a search beyond that lost its way by rounding.
    let longest: f64 = (0..mesh.len())
        .flat_map(|cell| {
            let sides = mesh.sides(cell);
            (0..sides.len()).map(move |i| measure.of(sides[(i + 1) % sides.len()].from - sides[i].from))
        })
        .sum();
    let mut looks = 0_usize;
    while let Some(Waiting { node, goal, estimate }) = search.waiting.pop() {
        if let Some(goal) = goal {
            return Some(search.path(node, goal, estimate));
        }
        if estimate > longest || (looks.is_multiple_of(NODES_PER_LOOK) && !keep_going()) {
            return None;
        }
        looks += 1;
        search.expand(node);
    }
    None
}

struct Search<'a> {
    mesh: &'a NavigationMesh,
    measure: Measure,
    images: &'a [Point],
    /// Least cost from each cell to a goal; NaN until asked for.
    to_go: Vec<f64>,
    goals_in: Vec<Vec<Point>>,
    nodes: Vec<Node>,
    waiting: BinaryHeap<Waiting>,
    /// Least known cost to bend at each vertex.
    costs: Vec<f64>,
    /// Least cost at which each side was crossed right beside a bend at its right and its left end: going round a vertex
    /// ends there.
    turned: Vec<[f64; 2]>,
    /// What was pushed beyond each side from each bend.
    crossed: HashMap<(u32, u32), Crossed>,
}

/// What of a cell is seen from the last bend through a stretch of one side.
enum View {
    /// All of it: the bend lies on the stretch.
    All,
    /// What lies between two rays.
    Between { right: Vector, left: Vector },
    /// Nothing, for the bend lies on the side's line; the path comes from the right end, or the left.
    EdgeOn(Bent),
}

impl Search<'_> {
    fn start(&mut self, start: &MeshPoint) {
        let place = start.point;
        self.nodes.push(Node {
            cell: start.cell as u32,
            side: NONE,
            left: place,
            right: place,
            left_vertex: NONE,
            right_vertex: NONE,
            root: place,
            root_vertex: NONE,
            cost: 0.0,
            parent: NONE,
            bent: Bent::No,
        });
        let node = self.nodes.len() as u32 - 1;
        let estimate = self.least_to_go(start.cell);
        self.waiting.push(Waiting { estimate, node, goal: None });
    }

    /// Least cost from a place of `cell` to a goal.
    fn least_to_go(&mut self, cell: usize) -> f64 {
        if self.to_go[cell].is_nan() {
            let sides = self.mesh.sides(cell);
            let (mut low, mut high) = (sides[0].from, sides[0].from);
            for side in sides {
                low = Point::new(low.x.min(side.from.x), low.y.min(side.from.y));
                high = Point::new(high.x.max(side.from.x), high.y.max(side.from.y));
            }
            let nearest = self.images.iter().map(|image| self.measure.between_box_and(low, high, *image));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            self.to_go[cell] = if nearest.is_finite() { nearest } else { 0.0 };
        }
        self.to_go[cell]
    }

    fn expand(&mut self, index: u32) {
        let node = self.nodes[index as usize];
        if node.root_vertex != NONE && node.cost > with_rounding(self.costs[node.root_vertex as usize]) {
            return;
        }
        let view = if node.side == NONE { View::All } else { view(&node) };
        self.look_for_goals(index, &node, &view);

        let (cell, begin) = (node.cell as usize, self.mesh.begins[node.cell as usize] as usize);
        let count = self.mesh.begins[cell + 1] as usize - begin;
        let skip = if node.side == NONE { 0 } else { 1 };
        let first = if node.side == NONE { 0 } else { node.side as usize - begin };
        for i in skip..count {
            let side = begin + (first + i) % count;
            let Some(across) = self.mesh.sides[side].across else { continue };
            let (p, q) = (self.mesh.sides[side].from, self.mesh.sides[self.mesh.next(cell, side)].from);
            let (seen_from, seen_to) = match &view {
                View::All => (0.0, 1.0),
                View::EdgeOn(Bent::Right) => (1.0, 1.0),
                View::EdgeOn(_) => (0.0, 0.0),
                View::Between { right, left } => {
                    let (from, to) = seen(&node.root, right, left, p, q);
                    // A ray that all but meets a vertex meets it: there paths may bend.
                    let near = SNAP * self.mesh.rounding / (q - p).length_squared().sqrt();
                    (snapped(from, near), snapped(to, near))
                }
            };
            let stretch = |from: f64, to: f64| Stretch { side, p, q, from, to, across };
            if seen_from > 0.0 {
                self.bend(index, &node, Bent::Right, &stretch(0.0, seen_from));
            }
            if seen_to > seen_from {
                let seen = stretch(seen_from, seen_to);
                self.push(index, &node, &seen, (node.root, node.root_vertex, node.cost), Bent::No);
            }
            if seen_to < 1.0 {
                self.bend(index, &node, Bent::Left, &stretch(seen_to, 1.0));
            }
        }
    }

    fn look_for_goals(&mut self, index: u32, node: &Node, view: &View) {
        for i in 0..self.goals_in[node.cell as usize].len() {
            let goal = self.goals_in[node.cell as usize][i];
            let bent = match view {
                View::All => Bent::No,
                View::EdgeOn(bent) => *bent,
                View::Between { right, left } => {
                    let ray = goal - node.root;
                    if below(right.cross(ray), right, &ray) {
                        Bent::Right
                    } else if below(-left.cross(ray), left, &ray) {
                        Bent::Left
                    } else {
                        Bent::No
                    }
                }
            };
            let cost = match self.bend_at(node, bent) {
                None if bent == Bent::No => node.cost + self.measure.of(goal - node.root),
                None => continue,
                Some((point, _, cost)) => cost + self.measure.of(goal - point),
            };
            self.waiting.push(Waiting {
                estimate: cost,
                node: index,
                goal: Some(Goal { point: goal, bent }),
            });
        }
    }

    /// Where a path that bends at an end of the node's stretch does so, at which vertex and at what cost; `None`
    /// where it cannot.
    fn bend_at(&self, node: &Node, bent: Bent) -> Option<(Point, u32, f64)> {
        let (point, vertex) = match bent {
            Bent::No => return None,
            Bent::Left => (node.left, node.left_vertex),
            Bent::Right => (node.right, node.right_vertex),
        };
        let can = vertex != NONE && self.mesh.bends[vertex as usize];
        can.then(|| (point, vertex, node.cost + self.measure.of(point - node.root)))
    }

    fn bend(&mut self, index: u32, node: &Node, bent: Bent, stretch: &Stretch) {
        let Some((point, vertex, cost)) = self.bend_at(node, bent) else { return };
        let known = &mut self.costs[vertex as usize];
        if cost <= with_rounding(*known) {
            *known = known.min(cost);
            self.push(index, node, stretch, (point, vertex, cost), bent);
        }
    }

    /// A node beyond a stretch of a side of the node's cell.
    fn push(
        &mut self,
        parent: u32,
        node: &Node,
        stretch: &Stretch,
        (root, root_vertex, cost): (Point, u32, f64),
        bent: Bent,
    ) {
        let Stretch { side, from, to, across, .. } = *stretch;
        let cell = node.cell as usize;
        let (right, right_vertex) = stretch.end(from, self.mesh.vertices[side], NONE);
        let (left, left_vertex) = stretch.end(to, NONE, self.mesh.vertices[self.mesh.next(cell, side)]);
        if (left - right).length_squared() == 0.0 {
            return;
        }
        if root == left || root == right {
            let turned = &mut self.turned[side][usize::from(root == left)];
            if with_rounding(cost) >= *turned {
                return;
            }
            *turned = cost;
        }
        // Paths of the same cost to one bend see the same beyond it: without this they would double at every obstacle that can
        // be passed on either side at the same cost.
        if root_vertex != NONE {
            let crossed = self.crossed.entry((side as u32, root_vertex)).or_default();
            if !crossed.is_more(cost, [from, to]) {
                return;
            }
        }
        let next = Node {
            cell: across.cell as u32,
            side: self.mesh.begins[across.cell] + across.side as u32,
            left: left + across.shift,
            right: right + across.shift,
            left_vertex,
            right_vertex,
            root: root + across.shift,
            root_vertex,
            cost,
            parent,
            bent,
        };
        let to_side = self.measure.to_line(next.root, next.left, next.right);
        let estimate = cost + to_side + self.least_to_go(across.cell);
        self.nodes.push(next);
        self.waiting.push(Waiting { estimate, node: self.nodes.len() as u32 - 1, goal: None });
    }

    /// The path to `goal` in the cell of `node`, followed back.
    fn path(&self, node: u32, goal: Goal, cost: f64) -> Geodesic {
        let mut places = vec![(goal.point, self.nodes[node as usize].cell, Vector::default())];
        let mut target = goal.point;
        let mut bent = goal.bent;
        let mut at = node;
        loop {
            let node = self.nodes[at as usize];
            if bent != Bent::No {
                target = if bent == Bent::Left { node.left } else { node.right };
                places.push((target, node.cell, Vector::default()));
            }
            if node.side == NONE {
                places.push((node.root, node.cell, Vector::default()));
                break;
            }
            let enters = crossing_of(node.root, target, node.left, node.right);
            // The side knows the way back, out of the cell entered.
            let back =
                self.mesh.sides[node.side as usize].across.map_or(Vector::default(), |across| across.shift);
            places.push((enters, node.cell, -back));
            target = target + back;
            bent = node.bent;
            at = node.parent;
        }
        places.reverse();
        let mut shifted = Vector::default();
        let shifts = places.iter().map(|(_, _, shift)| {
            shifted = shifted + *shift;
            shifted
        });
        Geodesic {
            cost,
            shifts: shifts.collect(),
            places: places.iter().map(|&(point, cell, _)| MeshPoint { cell: cell as usize, point }).collect(),
        }
    }
}

/// A stretch of a side from `p` to `q`, as shares of it.
struct Stretch {
    side: usize,
    p: Point,
    q: Point,
    from: f64,
    to: f64,
    across: Across,
}

impl Stretch {
    /// The place at `share`, and its vertex: `at_p` at 0, `at_q` at 1.
    fn end(&self, share: f64, at_p: u32, at_q: u32) -> (Point, u32) {
        if share <= 0.0 {
            (self.p, at_p)
        } else if share >= 1.0 {
            (self.q, at_q)
        } else {
            (self.p.lerp(self.q, share), NONE)
        }
    }
}

fn view(node: &Node) -> View {
    let side = node.right - node.left;
    let off = side.cross(node.root - node.left);
    if below(off, &side, &(node.root - node.left)) {
        return View::Between { right: node.right - node.root, left: node.left - node.root };
    }
    let along = side.dot(node.root - node.left);
    if along < 0.0 {
        View::EdgeOn(Bent::Left)
    } else if along > side.length_squared() {
        View::EdgeOn(Bent::Right)
    } else {
        View::All
    }
}
