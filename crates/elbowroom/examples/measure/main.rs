//! Measures one piece of the core's work and prints JSON: what `make bench` sets beside the peers.
//!
//! `measure map SCENE POINTS RUNS OUT`, `measure field MASK POINTS GOAL RUNS OUT`, `measure repair SCENE POINTS RUNS`,
//! `measure plan SCENE TASK POINTS PLANNER OBJECTIVE RUNS`, `measure edges SCENE RUNS`, `measure swarm RUNS`,
//! `measure timing SCENE VIAS RUNS`,
//! `measure online SCENE POINTS MOVING UPKEEP UPDATES COMPARE RUNS`,
//! `measure repaired SCENE POINTS MOVES`, `measure replan SCENE POINTS MOVING SECONDS DEADLINE_MS RUNS`.
//! Times are of the wall (ms), set-up and answers' files left out; `RAYON_NUM_THREADS` says how many cores.

mod edges;
mod field;
#[path = "../../tests/lattice/mod.rs"]
#[expect(dead_code, reason = "shared with tests")]
mod lattice;
mod map;
mod online;
mod plan;
mod repair;
mod replan;
mod runs;
mod scenes;
mod swarm;
mod timing;

use std::error::Error;
use std::io::Write;

type Outcome = Result<serde_json::Value, Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut found = match arguments[..] {
        ["map", scene, points, runs, out] => map::measure(scene, points.parse()?, runs.parse()?, out)?,
        ["field", mask, points, goal, runs, out] => {
            field::measure(mask, points.parse()?, goal.parse()?, runs.parse()?, out)?
        }
        ["repair", scene, points, runs] => repair::measure(scene, points.parse()?, runs.parse()?)?,
        ["plan", scene, task, points, planner, objective, runs] => {
            plan::measure([scene, task, points, planner, objective], runs.parse()?)?
        }
        ["edges", scene, runs] => edges::measure(scene, runs.parse()?)?,
        ["online", scene, points, moving, upkeep, updates, compare, runs] => {
            let counts = [updates.parse()?, compare.parse()?, runs.parse()?];
            online::measure([scene, moving, upkeep], points.parse()?, counts)?
        }
        ["repaired", scene, points, moves] => online::repaired(scene, points.parse()?, moves.parse()?)?,
        ["replan", scene, points, moving, seconds, deadline, runs] => {
            let deadline = if deadline == "none" { None } else { Some(deadline.parse()?) };
            let (moving, seconds, runs) = (moving.parse()?, seconds.parse()?, runs.parse()?);
            replan::measure(scene, points.parse()?, &replan::Run { moving, seconds, deadline, runs })?
        }
        ["swarm", runs] => swarm::measure(runs.parse()?)?,
        ["timing", scene, vias, runs] => timing::measure(scene, vias, runs.parse()?)?,
        _ => return Err("usage: see the head of examples/measure/main.rs".into()),
    };
    found["peak_mib"] = peak_memory().into();
    writeln!(std::io::stdout(), "{found}")?;
    Ok(())
}

/// The most memory this process ever held (MiB), where the system tells: on Linux.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok().map(|kib: f64| kib / 1024.0)
}
