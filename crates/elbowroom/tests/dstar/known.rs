//! Small maps whose distances are known.

use super::*;

fn free(columns: usize, rows: usize) -> World {
    let len = columns * rows;
    World::Cells { columns, weights: vec![1.0; len], blocked: vec![false; len], usual_step: Some(1.0) }
}

pub(crate) fn set_blocked(world: &mut World, nodes: &[usize], to: bool) {
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
