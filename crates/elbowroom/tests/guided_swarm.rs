//! The modified lbest swarm: what it draws are paths, and over a grid its best is D*'s.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a judge that fails may panic")]

use std::collections::HashSet;

use elbowroom::grid::Grid;
use elbowroom::search::{Dstar, Graph, Progress, Until, dijkstra};
use elbowroom::swarm::{DrawnPaths, GuidedSwarmError, GuidedSwarmSettings, Terrain, draw_paths};

/// A grid with blocked cells, eight neighbours.
struct Map {
    grid: Grid,
    blocked: Vec<bool>,
}

impl Map {
    fn parse(rows: &[&str]) -> Self {
        let side = |n: usize| [0.0, (n - 1) as f64];
        let grid = Grid::new(side(rows[0].len()), side(rows.len()), 1.0).unwrap();
        let blocked = rows.iter().flat_map(|row| row.bytes().map(|b| b == b'#')).collect();
        Self { grid, blocked }
    }
}

impl Graph for Map {
    fn len(&self) -> usize {
        self.grid.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        for (cell, cost) in self.grid.neighbours(node) {
            let open = !self.blocked[cell] && !self.blocked[node];
            visit(cell, if open { cost } else { f64::INFINITY });
        }
    }
}

fn draw(
    map: &Map,
    start: usize,
    goal: usize,
    settings: &GuidedSwarmSettings,
    seed: u64,
) -> Option<DrawnPaths> {
    let mut field = Dstar::new(map.len());
    field.insert_goal(goal, 0.0).unwrap();
    assert_eq!(field.expand(map, Until::WholeField, usize::MAX), Progress::Done);
    let terrain = Terrain {
        graph: map,
        cost_to_go: &|node| field.cost_to_go(node),
        distance: &|node| map.grid.point(node).distance(map.grid.point(goal)),
        is_goal: &|node| node == goal,
    };
    draw_paths(&terrain, start, settings, seed, &|| true)
}

fn cost_of(map: &Map, path: &[usize]) -> f64 {
    path.windows(2)
        .map(|pair| {
            let step = map.grid.neighbours(pair[0]).find(|&(cell, _)| cell == pair[1]);
            step.expect("consecutive nodes are neighbours").1
        })
        .sum()
}

/// Random maps, small so that the optimum is found often enough to compare.
fn random_map(seed: u64) -> Map {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let mut map = Map::parse(&["............"; 12]);
    for blocked in &mut map.blocked {
        *blocked = next() % 4 == 0;
    }
    map
}

#[test]
fn paths_are_paths_and_never_better_than_the_optimum() {
    let settings = GuidedSwarmSettings { candidates: 60, ..Default::default() };
    let (mut reached, mut optimal) = (0, 0);
    for seed in 0..500 {
        let mut map = random_map(seed);
        let (start, goal) = (0, map.len() - 1);
        map.blocked[start] = false;
        map.blocked[goal] = false;
        let best = dijkstra(&map, &[(goal, 0.0)]).unwrap()[start];
        let Some(drawn) = draw(&map, start, goal, &settings, seed) else {
            assert!(best.is_infinite(), "a way of cost {best} was not walked");
            continue;
        };
        reached += 1;
        assert_eq!(drawn.candidates, 60);
        let different: HashSet<_> = drawn.paths.iter().collect();
        assert_eq!(different.len(), drawn.paths.len(), "no path twice");
        for path in &drawn.paths {
            assert_eq!((path[0], path[path.len() - 1]), (start, goal));
            assert!(path.iter().all(|&node| !map.blocked[node]));
            let unique: HashSet<_> = path.iter().collect();
            assert_eq!(unique.len(), path.len(), "no place twice");
            assert!((cost_of(&map, path) - drawn.cost).abs() < 1e-9);
        }
        assert!(drawn.cost >= best - 1e-9);
        optimal += usize::from(drawn.cost <= best + 1e-9);
    }
    assert!(reached > 300, "{reached} maps had a way");
    assert!(optimal * 100 >= reached * 90, "{optimal} of {reached} optimal");
}

#[test]
fn it_steps_back_from_dead_points() {
    // The straight way to the goal runs into a sack; Euclid pulls in, nothing else does with these weights.
    let map = Map::parse(
        &[".........", ".######..", "......#..", "......#.G", "......#..", ".######..", "........."]
            .map(|row| if row.contains('G') { "......#.." } else { row }),
    );
    let (start, goal) = (map.grid.cell(1, 3), map.grid.cell(8, 3));
    let euclid_only =
        GuidedSwarmSettings { c_dstar: 0.0, c_euclid: 50.0, candidates: 40, ..Default::default() };
    let drawn = draw(&map, start, goal, &euclid_only, 7).unwrap();
    assert!(drawn.dead_points > 0, "some candidate filled the sack and had to step back");
    assert_eq!(drawn.candidates, 40, "and all of them arrived");
}

#[test]
fn one_seed_one_result_and_other_seeds_others() {
    let map = Map::parse(&["...................."; 20]);
    let settings = GuidedSwarmSettings { candidates: 20, ..Default::default() };
    let (start, goal) = (0, map.grid.cell(19, 8));
    let once = draw(&map, start, goal, &settings, 11).unwrap();
    assert_eq!(once, draw(&map, start, goal, &settings, 11).unwrap());
    assert_ne!(once.paths, draw(&map, start, goal, &settings, 12).unwrap().paths);
    assert!(once.paths.len() > 1, "many shortest paths on an open map");
}

#[test]
fn start_on_the_goal_is_a_path_of_one_node() {
    let map = Map::parse(&["...", "...", "..."]);
    let drawn = draw(&map, 4, 4, &GuidedSwarmSettings::default(), 0).unwrap();
    assert_eq!((drawn.cost, drawn.paths), (0.0, vec![vec![4]]));
}

#[test]
fn no_way_and_a_stop_give_nothing() {
    let map = Map::parse(&[".#.", ".#.", ".#."]);
    assert_eq!(draw(&map, 0, 2, &GuidedSwarmSettings::default(), 0), None);

    let open = Map::parse(&["...", "...", "..."]);
    let terrain = Terrain {
        graph: &open,
        cost_to_go: &|node| open.grid.point(node).distance(open.grid.point(8)),
        distance: &|_| 0.0,
        is_goal: &|node| node == 8,
    };
    assert_eq!(draw_paths(&terrain, 0, &GuidedSwarmSettings::default(), 0, &|| false), None);
}

#[test]
fn settings_are_checked() {
    let ok = GuidedSwarmSettings::default();
    assert_eq!(ok.check(), Ok(()));
    let none = GuidedSwarmSettings { candidates: 0, ..ok };
    assert_eq!(none.check(), Err(GuidedSwarmError::Candidates { found: 0 }));
    let bad = GuidedSwarmSettings { c_dstar: f64::NAN, ..ok };
    assert!(matches!(bad.check(), Err(GuidedSwarmError::Coefficient { name: "c_dstar", .. })));
    let negative = GuidedSwarmSettings { v_max: Some(-1.0), ..ok };
    assert!(matches!(negative.check(), Err(GuidedSwarmError::Coefficient { name: "v_max", .. })));
}

#[test]
fn speed_limit_weakens_the_pulls() {
    // With no speed at all the least cost-to-go among the neighbours is always next: greedy descent of h.
    let map = Map::parse(&["..........", "..####....", "..........", ".........."]);
    let settings = GuidedSwarmSettings { v_max: Some(0.0), candidates: 5, ..Default::default() };
    let drawn = draw(&map, 0, map.len() - 1, &settings, 3).unwrap();
    assert_eq!(drawn.paths.len(), 1, "nothing random is left");
}
