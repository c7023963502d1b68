use elbowroom::free_space::FreeSpace;
use elbowroom::geometry::Vector;
use elbowroom::scene::{Place, Scene, TwoLinkError};
use elbowroom::search::{Graph, Progress, Until};
use serde_json::json;

use super::field::from_scratch;
use super::lattice::Lattice;
use super::{Outcome, runs, scenes};

/// D* over the union of both maps after one obstacle moved by a cell, against D* from scratch, obstacle by
/// obstacle, for the first task. The maps themselves are not part of the times.
pub(crate) fn measure(file: &str, points: usize, runs: usize) -> Outcome {
    let scene = scenes::load(file, points)?;
    let task = scene.tasks().first().ok_or("the scene has no task")?;
    let [start, goal] = [&task.start, &task.goal].map(|place| cell_of(&scene, place));
    let (start, goal) = (start.ok_or("no tip start")?, goal.ok_or("no tip goal")?);
    let before = union(&scene)?;
    let field = from_scratch(&before, goal)?;
    let mut found = Vec::new();
    for obstacle in 0..scene.obstacles().len() {
        let after = union(&moved(&scene, obstacle)?)?;
        if !after.is_free(goal) {
            continue;
        }
        let changed: Vec<usize> =
            (0..after.len()).filter(|&cell| before.is_free(cell) != after.is_free(cell)).collect();
        let repaired = |until: Until| {
            // The copy to repair is made outside the time.
            let mut copies: Vec<_> = (0..runs + 1).map(|_| field.clone()).collect();
            runs::times(runs.min(copies.len()), || {
                let mut field = copies.pop().unwrap_or_else(|| field.clone());
                field.changed(&after, changed.iter().copied());
                let progress = field.expand(&after, until, usize::MAX);
                assert_eq!(progress, Progress::Done);
                field
            })
        };
        let (whole_ms, whole) = repaired(Until::WholeField);
        let (settled_ms, settled) = repaired(Until::Settled(start));
        let (scratch_ms, scratch) = runs::times(runs, || from_scratch(&after, goal));
        let scratch = scratch?;
        let equal =
            whole.field() == scratch.field() && settled.cost_to_go(start) == scratch.cost_to_go(start);
        found.push(json!({
            "obstacle": obstacle, "changed": changed.len(), "equal": equal,
            "whole_ms": whole_ms, "settled_ms": settled_ms, "scratch_ms": scratch_ms,
            "expansions": whole.expansions() - field.expansions(),
            "cost": scratch.cost_to_go(start),
        }));
    }
    Ok(json!({ "obstacles": found, "free": (0..before.len()).filter(|&cell| before.is_free(cell)).count() }))
}

/// Where the tip may stand in some posture.
fn union(scene: &Scene) -> Result<Lattice, TwoLinkError> {
    let space = FreeSpace::of(scene.two_link()?);
    let free = (0..scene.grid().len()).map(|cell| space.union_is_free(cell)).collect();
    Ok(Lattice::new(scene.grid().columns(), 1.0, free))
}

/// The scene with one obstacle a grid step to the right.
fn moved(scene: &Scene, obstacle: usize) -> Result<Scene, Box<dyn std::error::Error>> {
    let mut obstacles = scene.obstacles().to_vec();
    obstacles[obstacle].shape = obstacles[obstacle].shape.shifted(Vector::new(scene.grid().step(), 0.0));
    Ok(scene.with_obstacles(obstacles)?)
}

fn cell_of(scene: &Scene, place: &Place) -> Option<usize> {
    match place {
        Place::Tip(point) => scene.grid().nearest(*point),
        Place::Configuration(_) => None,
    }
}
