//! Keeps an arm going to the goal of a scene's first task among obstacles that move, replanned 50 times a second in simulated
//! time: `cargo run --release --example replan -- SCENE`.

use std::error::Error;
use std::io::Write;

use elbowroom::online::{Decision, Replanner, World, goal_configurations};
use elbowroom::parse;
use elbowroom::trajectory::State;

/// Time between two updates (s).
const PERIOD: f64 = 0.02;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: replan SCENE")?;
    let scene = parse(&std::fs::read_to_string(&file)?, &file)?.scene;
    let task = scene.tasks().first().ok_or("the scene has no task")?.clone();
    let start = *goal_configurations(&scene, &task.start)?.first().ok_or("the start is not free")?;
    let mut replanner = Replanner::new(scene.clone(), start, &task.goal, 0)?;
    let mut world = World::new(scene);
    let mut state = State::rest(&start);
    let mut out = std::io::stdout();
    for step in 0..1500 {
        let now = PERIOD * f64::from(step);
        let update = replanner.update(&world.seen_from(&state.position), now, &state, &|| true)?;
        match update.decision {
            Decision::New(trajectory) => {
                writeln!(out, "{now:5.2} s: another motion, until {:.2} s", trajectory.motion().end())?;
            }
            Decision::Stop(_) => writeln!(out, "{now:5.2} s: nothing is proved to be safe, braking")?,
            _ => {}
        }
        if replanner.is_at_goal(&state) {
            writeln!(out, "{now:5.2} s: at the goal")?;
            break;
        }
        state = replanner.motion().at(now + PERIOD);
        world.advance(now + PERIOD, &state.position);
    }
    Ok(())
}
