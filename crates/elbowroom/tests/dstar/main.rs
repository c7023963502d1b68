//! D* against Dijkstra's algorithm, bit for bit, on random graphs that change.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

mod known;
#[path = "../lattice/mod.rs"]
mod lattice;
mod world;

use elbowroom::search::{
    Dstar, GoalError, Graph, NodeState, PlateauSettings, Progress, Until, dijkstra, plateaus,
};
use known::set_blocked;
use lattice::Lattice;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use world::{Random, World};

const ALL: usize = usize::MAX;

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

/// The cost-to-go to `goal` of all nodes.
fn field_to(lattice: &Lattice, goal: usize) -> Dstar {
    let mut field = Dstar::new(lattice.len());
    field.insert_goal(goal, 0.0).unwrap();
    assert_eq!(field.expand(lattice, Until::WholeField, ALL), Progress::Done);
    field
}

#[test]
fn plateaus_lie_on_both_ways_round_an_obstacle_and_nowhere_else() {
    let settings = PlateauSettings { within: 0.5, stretch: 0.02, drop: 0.05 };
    let (columns, rows) = (81_usize, 61);
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..200 {
        // A wall in the middle, nearer to the lower rim: below it is shorter.
        let mut draw = |low: usize, count: u64| low + (rng.next_u64() % count) as usize;
        let (left, width, low, high) = (draw(35, 5), draw(4, 8), draw(18, 8), draw(33, 8));
        let is_wall = |node: usize| {
            let (x, y) = (node % columns, node / columns);
            (left..left + width).contains(&x) && (low..=high).contains(&y)
        };
        let lattice = Lattice::new(columns, 1.0, (0..columns * rows).map(|node| !is_wall(node)).collect());
        let [start, goal] = [10, 70].map(|x| 25 * columns + x);
        let [from_start, to_goal] = [start, goal].map(|end| field_to(&lattice, end));
        let least = to_goal.cost_to_go(start);
        let pieces = plateaus(&lattice, &from_start, &to_goal, least, &settings, &|| true).unwrap();
        let cost = |node: usize| from_start.cost_to_go(node) + to_goal.cost_to_go(node);
        // Beside the wall, where ways have to choose a side.
        let beside = |node: &usize| (left..left + width).contains(&(node % columns));
        let sides = |of_side: fn(usize, usize, usize) -> bool| {
            let nodes = pieces.iter().flatten().filter(|node| beside(node));
            nodes
                .filter(|&&node| of_side(node / columns, low, high))
                .map(|&node| cost(node))
                .fold(f64::INFINITY, f64::min)
        };
        let (below, above) = (sides(|y, low, _| y < low), sides(|y, _, high| y > high));
        // What the shortest way on either side costs, where the other is blocked.
        let blocked = |blocked_rows: std::ops::Range<usize>| {
            let is_free = |node: usize| {
                let is_blocked = node % columns == left && blocked_rows.contains(&(node / columns));
                !is_wall(node) && !is_blocked
            };
            let one_way = Lattice::new(columns, 1.0, (0..columns * rows).map(is_free).collect());
            field_to(&one_way, goal).cost_to_go(start)
        };
        for (found, known) in [(below, blocked(high..rows)), (above, blocked(0..low + 1))] {
            assert!(
                known > (1.0 + settings.within) * least || (found - known).abs() < 1e-9,
                "{found}, {known}"
            );
        }
        // The way there and on has no bend, as far as is looked.
        for &node in pieces.iter().flatten() {
            assert!(cost(node) <= (1.0 + settings.within) * least);
        }
        assert!(pieces.windows(2).all(|pair| cost(pair[0][0]) <= cost(pair[1][0])));
    }
}
