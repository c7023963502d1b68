//! Plans the first task of a scene file and prints what came of it: `cargo run --release --example plan -- SCENE`.

use std::error::Error;
use std::io::Write;

use elbowroom::planners::default_for;
use elbowroom::planning::{Objective, PlanSettings, Unwatched};
use elbowroom::{parse, plan};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: plan SCENE")?;
    let scene = parse(&std::fs::read_to_string(&file)?, &file)?.scene;
    let task = scene.tasks().first().ok_or("the scene has no task")?;
    let settings = PlanSettings { objective: Objective::Time, ..PlanSettings::default() };
    let plan = plan(&scene, task, &*default_for(scene.arm()), &settings, &Unwatched)?;
    let mut out = std::io::stdout();
    writeln!(out, "{}: {:.2} s, proved to be safe", task.name, plan.trajectory().motion().duration())?;
    if let Some(least) = plan.trajectory().verdict().least_clearance {
        writeln!(out, "least clearance {:.1} mm, at {:.2} s", 1e3 * least.distance, least.time)?;
    }
    if let Some(gap) = plan.gap() {
        writeln!(out, "no motion is faster by more than {:.0} %", 100.0 * gap / (1.0 + gap))?;
    }
    Ok(())
}
