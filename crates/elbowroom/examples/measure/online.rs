use std::f64::consts::TAU;
use std::time::Instant;

use elbowroom::free_space::{FreeSpace, configurations};
use elbowroom::geometry::{Point, Shape, Vector};
use elbowroom::online::{NoRoute, Roadmap, Route, Upkeep};
use elbowroom::scene::{Obstacle, Scene, Task};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use serde_json::{Value, json};

use super::{Outcome, scenes};

/// Radius of the discs that are added to a scene with fewer obstacles than are to move (m).
const RADIUS: f64 = 0.02;

/// How far from where it was at first an obstacle may wander (m).
const WANDER: f64 = 0.08;

/// The parts of an update that are measured, in the order they come.
const PARTS: [&str; 5] = ["refill", "map", "update", "path", "scratch"];

/// Obstacles that move by a cell each per update, `moving` of them, while the arm follows its way to the first task's goal:
/// an update of the roadmap and the path after it, against a roadmap from scratch, which has to have the same cost.
///
/// `each` in place of a number moves one obstacle after the other, one per update. Every `compare`th update is also done
/// from scratch.
///
/// The whole is done `runs` times over, every time the same, and of each time taken the least counts: what is left is the
/// work, without what else the machine was doing.
pub(crate) fn measure(
    [file, moving, upkeep]: [&str; 3],
    points: usize,
    [updates, compare, runs]: [usize; 3],
) -> Outcome {
    let (mut found, mut times) = follow([file, moving, upkeep], points, [updates, compare])?;
    for _ in 1..runs {
        let (_, again) = follow([file, moving, upkeep], points, [updates, compare])?;
        for (times, again) in times.iter_mut().zip(again) {
            times.iter_mut().zip(again).for_each(|(time, again)| *time = time.min(again));
        }
    }
    let both = times[2].iter().zip(&times[3]).map(|(update, path)| update + path).collect();
    found["update_and_path_ms"] = spread(both);
    for (part, times) in PARTS.into_iter().zip(times) {
        found[format!("{part}_ms")] = spread(times);
    }
    Ok(found)
}

/// The times that each part took (ms), in the order of [`PARTS`].
type Times = [Vec<f64>; 5];

fn follow(
    [file, moving, upkeep]: [&str; 3],
    points: usize,
    [updates, compare]: [usize; 2],
) -> Result<(Value, Times), Box<dyn std::error::Error>> {
    let scene = scenes::load(file, points)?;
    let task = scene.tasks().first().ok_or("the scene has no task")?.clone();
    let upkeep = match upkeep {
        "cheaper" => Upkeep::Cheaper,
        "repair" => Upkeep::Repair,
        "anew" => Upkeep::Anew,
        _ => return Err("upkeep is cheaper, repair or anew".into()),
    };
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let mut unit = move || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let one_by_one = moving == "each";
    let mut obstacles = scene.obstacles().to_vec();
    let moving = if one_by_one { obstacles.len() } else { moving.parse()? };
    let [_, reach] = scene.arm().reach();
    while obstacles.len() < moving {
        let away = Vector::polar(reach * (0.3 + 0.7 * unit()), TAU * unit());
        obstacles.push(Obstacle::still(Shape::circle(scene.arm().base() + away, RADIUS)?));
    }
    let scene = scene.with_obstacles(obstacles)?;
    let mut headings: Vec<f64> = (0..moving).map(|_| TAU * unit()).collect();
    let first_at: Vec<Point> = scene.obstacles().iter().map(middle).collect();
    let home = configurations(scene.two_link()?, &task.start)?[0];
    let mut roadmap = Roadmap::new(scene, &task)?.with_upkeep(upkeep);
    let mut q = home;
    let mut route = roadmap.path_from(&q);
    let mut times: Times = Default::default();
    let (mut routes, mut anew, mut nodes, mut cells, mut most_expansions) = (0, 0, 0, 0, 0);
    for update in 0..updates {
        let mut obstacles = roadmap.scene().obstacles().to_vec();
        for (index, heading) in headings.iter_mut().enumerate() {
            if one_by_one && index != update % moving {
                continue;
            }
            *heading += 0.6 * (unit() - 0.5);
            let moved = shifted(&obstacles[index], Vector::polar(roadmap.scene().grid().step(), *heading));
            if middle(&moved).distance(first_at[index]) > WANDER {
                *heading += TAU / 2.0;
            } else {
                obstacles[index] = moved;
            }
        }
        let before = roadmap.scene().obstacles().to_vec();
        let mut space = roadmap.space().clone();
        let begun = roadmap.expansions();
        let updated = timed(&mut times[2], || roadmap.move_obstacles(obstacles))?;
        let now = roadmap.scene().two_link()?;
        timed(&mut times[0], || space.refill(&before, now));
        route = timed(&mut times[3], || roadmap.path_from(&q));
        let begun = if updated.repaired.is_none() { 0 } else { begun };
        most_expansions = most_expansions.max(roadmap.expansions() - begun);
        (nodes, cells) = (nodes + updated.repaired.unwrap_or(0), cells + updated.cells);
        anew += usize::from(updated.repaired.is_none());
        routes += usize::from(route.is_ok());
        if update.is_multiple_of(compare) {
            let scene = roadmap.scene().clone();
            let now = scene.two_link()?;
            let map = timed(&mut times[1], || FreeSpace::of(now));
            assert!(map == *roadmap.space() && map == space, "the maps differ");
            let judge = timed(&mut times[4], || from_scratch(scene.clone(), &task, &q))?;
            assert_eq!(cost(&judge), cost(&route), "the costs differ");
        }
        q = match &route {
            Ok(route) if route.path.0.len() > 2 => [route.path.0[1][0], route.path.0[1][1]],
            _ => home,
        };
    }
    drop(route);
    let found = json!({
        "updates": updates, "routes": routes, "anew": anew, "most_expansions": most_expansions,
        "nodes": nodes / updates, "cells": cells / updates,
    });
    Ok((found, times))
}

/// One obstacle after the other moves by a cell and back again: the cost-to-go repaired to the path of the first task, and
/// everywhere, each against a roadmap from scratch. That the fields are equal, to the last bit, is examined outside the
/// times.
pub(crate) fn repaired(file: &str, points: usize, moves: usize) -> Outcome {
    let scene = scenes::load(file, points)?;
    let task = scene.tasks().first().ok_or("the scene has no task")?.clone();
    let q = configurations(scene.two_link()?, &task.start)?[0];
    let home = scene.obstacles().to_vec();
    let mut found = serde_json::Map::new();
    for to_path in [true, false] {
        let work = |roadmap: &mut Roadmap| {
            if to_path { drop(roadmap.path_from(&q)) } else { drop(roadmap.whole_field()) }
        };
        let mut roadmap = Roadmap::new(scene.clone(), &task)?.with_upkeep(Upkeep::Repair);
        work(&mut roadmap);
        let (mut repairs, mut rebuilds) = (Vec::new(), Vec::new());
        for index in 0..moves {
            let mut obstacles = home.clone();
            let which = (index / 2) % home.len();
            if index % 2 == 0 {
                let way = Vector::polar(scene.grid().step(), TAU * 0.618 * (index / 2) as f64);
                obstacles[which] = shifted(&obstacles[which], way);
            }
            let now = scene.with_obstacles(obstacles.clone())?;
            timed(&mut repairs, || {
                let moved = roadmap.move_obstacles(obstacles);
                work(&mut roadmap);
                moved
            })?;
            let fresh = timed(&mut rebuilds, || {
                Roadmap::new(now, &task).map(|mut fresh| {
                    work(&mut fresh);
                    fresh
                })
            });
            let mut fresh = fresh?;
            if to_path {
                assert_eq!(cost(&roadmap.path_from(&q)), cost(&fresh.path_from(&q)), "the costs differ");
            } else {
                assert!(roadmap.whole_field() == fresh.whole_field(), "the fields differ");
            }
        }
        let mut ratios: Vec<f64> = repairs.iter().zip(&rebuilds).map(|(a, b)| b / a).collect();
        ratios.sort_by(f64::total_cmp);
        let name = if to_path { "to_path" } else { "whole_field" };
        let median = ratios.get(ratios.len() / 2);
        found.insert(
            name.into(),
            json!({ "repair_ms": spread(repairs), "rebuild_ms": spread(rebuilds),
                "times_as_fast": { "median": median, "least": ratios.first() } }),
        );
    }
    Ok(found.into())
}

fn from_scratch(scene: Scene, task: &Task, q: &[f64; 2]) -> Result<Result<Route, NoRoute>, String> {
    let mut roadmap = Roadmap::new(scene, task).map_err(|error| error.to_string())?;
    Ok(roadmap.path_from(q))
}

fn cost(route: &Result<Route, NoRoute>) -> Result<u64, NoRoute> {
    route.as_ref().map(|route| route.cost.to_bits()).map_err(|error| *error)
}

fn timed<T>(times: &mut Vec<f64>, work: impl FnOnce() -> T) -> T {
    let begun = Instant::now();
    let answer = work();
    times.push(begun.elapsed().as_secs_f64() * 1e3);
    answer
}

/// Median, 99.9th hundredth and worst.
pub(crate) fn spread(mut times: Vec<f64>) -> Value {
    times.sort_by(f64::total_cmp);
    let at =
        |share: f64| times.get(((times.len() as f64 * share) as usize).min(times.len().saturating_sub(1)));
    json!({ "median": at(0.5), "p99": at(0.99), "p99_9": at(0.999), "worst": times.last() })
}

fn middle(obstacle: &Obstacle) -> Point {
    obstacle.shape.vertices()[0]
}

fn shifted(obstacle: &Obstacle, by: Vector) -> Obstacle {
    Obstacle { shape: obstacle.shape.shifted(by), ..obstacle.clone() }
}
