//! D* against Dijkstra's algorithm, bit for bit, on random graphs that change.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

mod lattice;

use elbowroom::search::{Dstar, GoalError, Graph, NodeState, Progress, Until, dijkstra};
use lattice::Lattice;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

const ALL: usize = usize::MAX;

/// A graph whose costs can be changed.
enum World {
    /// Eight neighbours, corners may be cut; a step costs its length times the mean weight of its two cells.
    Cells { columns: usize, weights: Vec<f64>, blocked: Vec<bool>, usual_step: Option<f64> },
    /// Any graph: each node's neighbours with the number of the edge, and the cost of each edge.
    Network { neighbours: Vec<Vec<(usize, usize)>>, costs: Vec<f64>, usual_step: Option<f64> },
}

impl Graph for World {
    fn len(&self) -> usize {
        match self {
            Self::Cells { weights, .. } => weights.len(),
            Self::Network { neighbours, .. } => neighbours.len(),
        }
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        match self {
            Self::Cells { columns, weights, blocked, .. } => {
                let (x, y) = (node % columns, node / columns);
                let rows = weights.len() / columns;
                for row in y.saturating_sub(1)..=(y + 1).min(rows - 1) {
                    for column in x.saturating_sub(1)..=(x + 1).min(columns - 1) {
                        let other = row * columns + column;
                        if other == node {
                            continue;
                        }
                        let length = if row == y || column == x { 1.0 } else { std::f64::consts::SQRT_2 };
                        let free = !blocked[node] && !blocked[other];
                        let cost = length * (0.5 * (weights[node] + weights[other]));
                        visit(other, if free { cost } else { f64::INFINITY });
                    }
                }
            }
            Self::Network { neighbours, costs, .. } => {
                for &(other, edge) in &neighbours[node] {
                    visit(other, costs[edge]);
                }
            }
        }
    }

    fn usual_step(&self) -> Option<f64> {
        let (Self::Cells { usual_step, .. } | Self::Network { usual_step, .. }) = self;
        *usual_step
    }
}

struct Random(ChaCha8Rng);

impl Random {
    fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }

    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    /// Small whole costs, where ties abound, or any from a thousandth to a thousand.
    fn cost(&mut self) -> f64 {
        if self.chance(0.5) { (1 + self.below(4)) as f64 } else { libm::exp(6.9 * (2.0 * self.unit() - 1.0)) }
    }

    /// None, a step that is usual, or any, however wrong: it must change nothing.
    fn usual_step(&mut self) -> Option<f64> {
        match self.below(6) {
            0..2 => None,
            2..4 => Some(1.0),
            4 => Some(libm::exp(60.0 * (2.0 * self.unit() - 1.0))),
            _ => Some([0.0, -1.0, 1e-300, 5e-324, 1e300, f64::INFINITY, f64::NAN][self.below(7)]),
        }
    }

    fn cells(&mut self, columns: usize, rows: usize) -> World {
        let (density, weighted) = (0.7 * self.unit(), self.chance(0.3));
        let len = columns * rows;
        World::Cells {
            columns,
            weights: (0..len).map(|_| if weighted { self.cost() } else { 1.0 }).collect(),
            blocked: (0..len).map(|_| self.chance(density)).collect(),
            usual_step: self.usual_step(),
        }
    }

    fn network(&mut self, len: usize) -> World {
        let mut world = World::Network {
            neighbours: vec![Vec::new(); len],
            costs: Vec::new(),
            usual_step: self.usual_step(),
        };
        let (edges, blocked) = (self.below(3 * len), 0.5 * self.unit());
        for _ in 0..edges {
            let (a, b) = (self.below(len), self.below(len));
            let cost = if self.chance(blocked) { f64::INFINITY } else { self.cost() };
            let World::Network { neighbours, costs, .. } = &mut world else { unreachable!() };
            if a != b && neighbours[a].iter().all(|&(other, _)| other != b) {
                neighbours[a].push((b, costs.len()));
                neighbours[b].push((a, costs.len()));
                costs.push(cost);
            }
        }
        world
    }

    fn world(&mut self) -> World {
        match self.below(100) {
            0..25 => {
                let len = 2 + self.below(60);
                self.network(len)
            }
            25 => {
                let (columns, rows) = (40 + self.below(30), 40 + self.below(30));
                self.cells(columns, rows)
            }
            _ => {
                let (columns, rows) = (1 + self.below(16), 2 + self.below(15));
                self.cells(columns, rows)
            }
        }
    }

    /// Changes the world here and there, and says where.
    fn change(&mut self, world: &mut World, start: usize, goals: &[(usize, f64)]) -> Vec<usize> {
        let len = world.len();
        let count = if self.chance(0.7) { 1 + self.below(4) } else { 1 + self.below(len) };
        let mut nodes: Vec<usize> = (0..count).map(|_| self.below(len)).collect();
        let (kind, coin) = (self.below(6), self.chance(0.5));
        match kind {
            0 => nodes = goals.iter().map(|goal| goal.0).collect(),
            1 => {
                nodes.clear();
                world.neighbours(start, |node, _| nodes.push(node));
            }
            2 => nodes = (0..len).collect(),
            _ => {}
        }
        match world {
            World::Cells { weights, blocked, .. } => {
                for &node in &nodes {
                    match kind {
                        // Goals, a ring around the start: all blocked or all freed.
                        0 | 1 => blocked[node] = coin,
                        2 => blocked[node] = self.chance(0.3),
                        3 => weights[node] = self.cost(),
                        _ => blocked[node] = !blocked[node],
                    }
                }
                nodes
            }
            World::Network { neighbours, costs, .. } => {
                let mut ends = Vec::new();
                for a in nodes {
                    for &(b, edge) in &neighbours[a] {
                        if kind < 2 || self.chance(0.5) {
                            let block = if kind < 2 { coin } else { self.chance(0.3) };
                            costs[edge] = if block { f64::INFINITY } else { self.cost() };
                            // One end of a changed edge has to do, whichever it is.
                            ends.push(if self.chance(0.5) { a } else { b });
                        }
                    }
                }
                ends
            }
        }
    }
}

/// The way from `node` costs its cost-to-go, added up from the goal as the search does, and ends at a goal.
fn assert_path(world: &World, dstar: &Dstar, goals: &[(usize, f64)], node: usize) {
    let path = dstar.path(node).unwrap();
    let goal = *path.last().unwrap();
    let mut cost = goals.iter().find(|&&(node, _)| node == goal).unwrap().1;
    for step in path.windows(2).rev() {
        let mut length = None;
        world.neighbours(step[1], |other, cost| {
            if other == step[0] {
                length = Some(cost);
            }
        });
        cost += length.unwrap();
    }
    assert_eq!(path[0], node);
    assert_eq!(cost.to_bits(), dstar.cost_to_go(node).to_bits());
}

/// The field is Dijkstra's, meets Bellman's equation (which has one solution), and its pointers lead to goals.
fn assert_field(world: &World, dstar: &Dstar, goals: &[(usize, f64)]) {
    let judge = dijkstra(world, goals).unwrap();
    for (node, &cost) in judge.iter().enumerate() {
        assert_eq!(cost.to_bits(), dstar.cost_to_go(node).to_bits(), "node {node}");

        let mut least =
            goals.iter().filter(|goal| goal.0 == node).fold(f64::INFINITY, |l, goal| l.min(goal.1));
        let mut through_next = None;
        world.neighbours(node, |other, step| {
            let through = dstar.cost_to_go(other) + step;
            least = least.min(through);
            if dstar.next(node) == Some(other) {
                through_next = Some(through);
            }
        });
        assert_eq!(cost, least);
        match dstar.next(node) {
            Some(_) => assert_eq!(through_next, Some(cost)),
            None if cost < f64::INFINITY => assert!(goals.contains(&(node, cost))),
            None => assert_eq!(dstar.path(node), None),
        }
        assert_ne!(dstar.state(node), NodeState::Open);
    }
}

fn distinct_goals(random: &mut Random, len: usize) -> Vec<(usize, f64)> {
    let mut goals: Vec<(usize, f64)> = Vec::new();
    for _ in 0..1 + random.below(3) {
        let node = random.below(len);
        if goals.iter().all(|goal| goal.0 != node) {
            goals.push((node, if random.chance(0.5) { 0.0 } else { 5.0 * random.unit() }));
        }
    }
    goals
}

#[test]
fn equals_dijkstra_on_random_maps_after_every_change() {
    let mut random = Random::new(20_260_101);
    let (mut fields, mut unreachable, mut raised, mut lowered, mut cut, mut joined) = (0, 0, 0, 0, 0, 0);
    for _ in 0..10_000 {
        let mut world = random.world();
        let start = random.below(world.len());
        let goals = distinct_goals(&mut random, world.len());
        let mut dstar = Dstar::new(world.len());
        for &(node, cost) in &goals {
            dstar.insert_goal(node, cost).unwrap();
        }
        let mut before = None;
        for batch in 0..2 + random.below(6) {
            // Not always from a finished field: changes may come while an earlier one is being repaired.
            for _ in 0..if batch == 0 { 0 } else { 1 + random.below(2) } {
                let nodes = random.change(&mut world, start, &goals);
                dstar.changed(&world, nodes);
                if random.chance(0.3) {
                    dstar.expand(&world, Until::WholeField, random.below(20));
                }
            }
            let now = if random.chance(0.6) {
                assert_eq!(dstar.expand(&world, Until::Settled(start), ALL), Progress::Done);
                let judge = dijkstra(&world, &goals).unwrap();
                let cost = dstar.cost_to_go(start);
                for (node, &best) in judge.iter().enumerate() {
                    if node == start || dstar.cost_to_go(node) < cost {
                        assert_eq!(dstar.cost_to_go(node).to_bits(), best.to_bits());
                    } else {
                        // Of the others it is known that they are no nearer.
                        assert!(best >= cost);
                    }
                }
                cost
            } else {
                dijkstra(&world, &goals).unwrap()[start]
            };
            if now < f64::INFINITY && dstar.cost_to_go(start) == now && random.chance(0.2) {
                dstar.expand(&world, Until::Settled(start), ALL);
                assert_path(&world, &dstar, &goals, start);
            }
            if random.chance(0.7) {
                assert_eq!(dstar.expand(&world, Until::WholeField, ALL), Progress::Done);
                assert_field(&world, &dstar, &goals);
                let node = random.below(world.len());
                if dstar.cost_to_go(node) < f64::INFINITY {
                    assert_path(&world, &dstar, &goals, node);
                }
                fields += 1;
            }
            unreachable += usize::from(now == f64::INFINITY);
            if let Some(before) = before {
                raised += usize::from(now > before && now < f64::INFINITY);
                lowered += usize::from(now < before && before < f64::INFINITY);
                cut += usize::from(now == f64::INFINITY && before < f64::INFINITY);
                joined += usize::from(now < f64::INFINITY && before == f64::INFINITY);
            }
            before = Some(now);
        }
    }
    let counts = [fields, unreachable, raised, lowered, cut, joined];
    assert!(counts.iter().all(|&count| count > 1_500), "cases that occurred: {counts:?}");
}

/// Every edge, from its lesser end, with its cost.
fn edges(world: &World) -> Vec<(usize, usize, f64)> {
    let mut edges = Vec::new();
    for a in 0..world.len() {
        world.neighbours(a, |b, cost| edges.extend((a < b).then_some((a, b, cost))));
    }
    edges
}

#[test]
fn equals_dijkstra_when_told_step_by_step() {
    let mut random = Random::new(20_261_123);
    let (mut told, mut untold, mut within) = (0, 0, 0);
    for _ in 0..6_000 {
        let mut world = random.world();
        let start = random.below(world.len());
        let goals = distinct_goals(&mut random, world.len());
        let mut dstar = Dstar::new(world.len());
        for &(node, cost) in &goals {
            dstar.insert_goal(node, cost).unwrap();
        }
        for _ in 0..2 + random.below(6) {
            if random.chance(0.5) {
                dstar.expand(&world, Until::WholeField, random.below(40));
            }
            if random.chance(0.1) {
                dstar.begin_again();
                assert_eq!(dstar.expansions(), 0);
            }
            let before = edges(&world);
            random.change(&mut world, start, &goals);
            let mut changes: Vec<_> =
                before.iter().zip(edges(&world)).filter(|(old, new)| old.2 != new.2).collect();
            if random.chance(0.5) {
                changes.reverse();
            }
            for (_, (a, b, cost)) in changes {
                let shorter = |x: usize, y: usize| dstar.cost_to_go(x) + cost < dstar.cost_to_go(y);
                let on_way = dstar.next(a) == Some(b) || dstar.next(b) == Some(a);
                if !on_way && !shorter(a, b) && !shorter(b, a) {
                    untold += 1;
                    continue;
                }
                told += 1;
                let (a, b) = if random.chance(0.5) { (a, b) } else { (b, a) };
                // What is told too low off the ways known is found out when it is looked at.
                dstar.step_changed(
                    a,
                    b,
                    if !on_way && random.chance(0.3) { 0.5 * cost.min(1.0) } else { cost },
                );
            }
            let judge = dijkstra(&world, &goals).unwrap();
            if random.chance(0.5) {
                let cost = 20.0 * random.unit();
                assert_eq!(dstar.expand(&world, Until::Within(cost), ALL), Progress::Done);
                for (node, &best) in judge.iter().enumerate() {
                    if best <= cost || dstar.cost_to_go(node) <= cost {
                        assert_eq!(dstar.cost_to_go(node).to_bits(), best.to_bits());
                        within += 1;
                    }
                }
            }
            if random.chance(0.7) {
                assert_eq!(dstar.expand(&world, Until::WholeField, ALL), Progress::Done);
                assert_field(&world, &dstar, &goals);
            }
        }
    }
    assert!(told > 100_000 && untold > 100_000 && within > 100_000, "{told} {untold} {within}");
}

fn with_usual_step(mut world: World, step: Option<f64>) -> World {
    let (World::Cells { usual_step, .. } | World::Network { usual_step, .. }) = &mut world;
    *usual_step = step;
    world
}

#[test]
fn buckets_give_the_field_and_the_pointers_of_the_heap() {
    let mut random = Random::new(4);
    for _ in 0..5_000 {
        let mut world = random.world();
        let goals = distinct_goals(&mut random, world.len());
        let expanded = |world: &World| {
            let mut dstar = Dstar::new(world.len());
            goals.iter().for_each(|&(node, cost)| dstar.insert_goal(node, cost).unwrap());
            assert_eq!(dstar.expand(world, Until::WholeField, ALL), Progress::Done);
            dstar
        };
        let by_buckets = expanded(&world);
        world = with_usual_step(world, None);
        let by_heap = expanded(&world);
        let bits = |field: &[f64]| field.iter().map(|cost| cost.to_bits()).collect::<Vec<_>>();
        let judge = bits(&dijkstra(&world, &goals).unwrap());
        assert_eq!(bits(&by_buckets.field()), judge);
        assert_eq!(bits(&by_heap.field()), judge);
        for node in 0..world.len() {
            assert_eq!(by_buckets.next(node), by_heap.next(node));
            assert_eq!(by_buckets.state(node), by_heap.state(node));
        }
    }
}

/// The neighbours of a node and the bits of what the steps there cost, in the order of their numbers.
fn seen_from(graph: &impl Graph, node: usize) -> Vec<(usize, u64)> {
    let mut seen = Vec::new();
    graph.neighbours(node, |other, cost| seen.push((other, cost.to_bits())));
    seen.sort_unstable();
    seen
}

#[test]
fn a_lattice_is_a_map_of_cells() {
    let mut random = Random::new(5);
    for _ in 0..300 {
        let (columns, rows) = (1 + random.below(9), 1 + random.below(9));
        let density = random.unit();
        let free: Vec<bool> = (0..columns * rows).map(|_| random.chance(density)).collect();
        let mut world = World::Cells {
            columns,
            weights: vec![1.0; free.len()],
            blocked: free.iter().map(|free| !free).collect(),
            usual_step: None,
        };
        let mut lattice = Lattice::new(columns, 1.0, free);
        for _ in 0..5 {
            for node in 0..world.len() {
                assert_eq!(seen_from(&lattice, node), seen_from(&world, node));
            }
            let (node, blocked) = (random.below(world.len()), random.chance(0.5));
            set_blocked(&mut world, &[node], blocked);
            lattice.set_free(node, !blocked);
            assert_eq!(lattice.is_free(node), !blocked);
        }
    }
    assert!(Lattice::new(0, 1.0, vec![true; 3]).is_empty());
    let mut row = Lattice::new(2, 1.0, vec![true; 3]);
    row.set_free(2, false);
    assert!(row.len() == 2 && !row.is_free(2));
}

#[test]
fn pauses_change_nothing() {
    let mut random = Random::new(2);
    for _ in 0..500 {
        let mut world = random.world();
        let start = random.below(world.len());
        let goals = distinct_goals(&mut random, world.len());
        let mut whole = Dstar::new(world.len());
        for &(node, cost) in &goals {
            whole.insert_goal(node, cost).unwrap();
        }
        let mut paused = whole.clone();
        for _ in 0..4 {
            let until = if random.chance(0.5) { Until::WholeField } else { Until::Settled(start) };
            assert_eq!(whole.expand(&world, until, ALL), Progress::Done);
            loop {
                let (budget, before) = (random.below(8), paused.expansions());
                match paused.expand(&world, until, budget) {
                    Progress::Done => break,
                    Progress::Paused => assert_eq!(paused.expansions(), before + budget),
                }
            }
            assert_eq!(whole.expansions(), paused.expansions());
            for node in 0..world.len() {
                assert_eq!(whole.cost_to_go(node).to_bits(), paused.cost_to_go(node).to_bits());
                assert_eq!(whole.next(node), paused.next(node));
                assert_eq!(whole.state(node), paused.state(node));
            }
            let nodes = random.change(&mut world, start, &goals);
            whole.changed(&world, nodes.iter().copied());
            paused.changed(&world, nodes);
        }
    }
}

#[test]
fn goals_come_and_change_their_cost() {
    let mut random = Random::new(3);
    for _ in 0..1_000 {
        let mut world = random.world();
        let mut dstar = Dstar::new(world.len());
        let mut goals: Vec<(usize, f64)> = Vec::new();
        for _ in 0..6 {
            let (node, cost) = (random.below(world.len()), 20.0 * random.unit());
            goals.retain(|goal| goal.0 != node);
            goals.push((node, cost));
            dstar.insert_goal(node, cost).unwrap();
            if random.chance(0.5) {
                let nodes = random.change(&mut world, node, &goals);
                dstar.changed(&world, nodes);
            }
            if random.chance(0.7) {
                assert_eq!(dstar.expand(&world, Until::WholeField, ALL), Progress::Done);
                assert_field(&world, &dstar, &goals);
            }
        }
    }
}

fn free(columns: usize, rows: usize) -> World {
    let len = columns * rows;
    World::Cells { columns, weights: vec![1.0; len], blocked: vec![false; len], usual_step: Some(1.0) }
}

fn set_blocked(world: &mut World, nodes: &[usize], to: bool) {
    let World::Cells { blocked, .. } = world else { unreachable!() };
    for &node in nodes {
        blocked[node] = to;
    }
}

#[test]
fn an_open_map_has_the_octile_distances() {
    for (columns, rows) in [(1, 2), (2, 2), (7, 7), (40, 13), (5, 90), (1, 200)] {
        let world = free(columns, rows);
        let mut dstar = Dstar::new(world.len());
        dstar.insert_goal(world.len() - 1, 0.0).unwrap();
        dstar.expand(&world, Until::WholeField, ALL);
        for node in 0..world.len() {
            let (x, y) = (columns - 1 - node % columns, rows - 1 - node / columns);
            let octile = x.min(y) as f64 * std::f64::consts::SQRT_2 + x.abs_diff(y) as f64;
            assert!((dstar.cost_to_go(node) - octile).abs() < 1e-11);
        }
        // Each node is expanded once: nothing is queued twice.
        assert_eq!(dstar.expansions(), world.len());
    }
}

#[test]
fn a_wall_is_walked_around_and_a_blocked_goal_has_no_way() {
    // 5 columns, 5 rows; a wall in column 2 that leaves row 4 open; from (0, 0) to (4, 0).
    let mut world = free(5, 5);
    let mut dstar = Dstar::new(25);
    dstar.insert_goal(4, 0.0).unwrap();
    let around = 4.0 + 4.0 * std::f64::consts::SQRT_2;
    let steps: [(&[usize], bool, f64); 7] = [
        (&[], false, 4.0),
        (&[2, 7, 12, 17], true, around),
        (&[22], true, f64::INFINITY),
        (&[22], false, around),
        (&[4], true, f64::INFINITY),
        (&[2, 7, 12, 17], false, f64::INFINITY),
        (&[4], false, 4.0),
    ];
    for (nodes, blocked, expected) in steps {
        set_blocked(&mut world, nodes, blocked);
        dstar.changed(&world, nodes.iter().copied());
        assert_eq!(dstar.expand(&world, Until::Settled(0), ALL), Progress::Done);
        let cost = dstar.cost_to_go(0);
        assert!(cost == expected || (cost - expected).abs() < 1e-12, "{cost} is not {expected}");
        assert_eq!(dstar.path(0).is_some(), expected < f64::INFINITY);
        assert_eq!(dstar.cost_to_go(4), 0.0);
    }
}

#[test]
fn a_change_behind_the_start_costs_little() {
    // Goal in one corner of 101 x 101, a cell blocked and freed in the opposite one.
    let mut world = free(101, 101);
    let mut dstar = Dstar::new(world.len());
    dstar.insert_goal(0, 0.0).unwrap();
    dstar.expand(&world, Until::WholeField, ALL);
    for blocked in [true, false] {
        let before = dstar.expansions();
        set_blocked(&mut world, &[95 * 101 + 95], blocked);
        dstar.changed(&world, [95 * 101 + 95]);
        dstar.expand(&world, Until::WholeField, ALL);
        assert!(dstar.expansions() - before < 100);
        assert_field(&world, &dstar, &[(0, 0.0)]);
    }
}

#[test]
fn goals_that_make_no_sense_are_refused() {
    let world = free(2, 2);
    let mut dstar = Dstar::new(4);
    assert_eq!(dstar.insert_goal(4, 0.0), Err(GoalError::Node { node: 4, len: 4 }));
    assert_eq!(dijkstra(&world, &[(usize::MAX, 0.0)]), Err(GoalError::Node { node: usize::MAX, len: 4 }));
    for cost in [-1.0, f64::INFINITY, f64::NAN, -5e-324] {
        assert!(matches!(dstar.insert_goal(1, cost), Err(GoalError::Cost { node: 1, .. })));
        assert!(matches!(dijkstra(&world, &[(1, cost)]), Err(GoalError::Cost { node: 1, .. })));
    }
    // Refused goals leave no trace; without goals there is no way, and numbers beyond the last node are no nodes.
    assert_eq!(dstar.expand(&world, Until::Settled(9), ALL), Progress::Done);
    dstar.changed(&world, [4, usize::MAX]);
    assert!((0..6).all(|node| dstar.path(node).is_none() && dstar.next(node).is_none()));
    assert!((0..6).all(|node| dstar.state(node) == NodeState::New));
    assert_eq!(dijkstra(&world, &[]).unwrap(), [f64::INFINITY; 4]);

    dstar.insert_goal(0, -0.0).unwrap();
    assert_eq!((dstar.state(0), dstar.state(1)), (NodeState::Open, NodeState::New));
    dstar.expand(&world, Until::WholeField, ALL);
    assert_eq!(dstar.field(), [0.0, 1.0, 1.0, std::f64::consts::SQRT_2]);
    assert_eq!(dstar.state(3), NodeState::Closed);

    let nothing = World::Network { neighbours: Vec::new(), costs: Vec::new(), usual_step: None };
    assert_eq!(Dstar::new(0).expand(&nothing, Until::WholeField, ALL), Progress::Done);
}
