//! Judges a straight move of the joints from start to goal of a scene's first task, in four seconds:
//! `cargo run --release --example check -- SCENE`.

use std::error::Error;
use std::io::Write;

use elbowroom::parse;
use elbowroom::scene::Place;
use elbowroom::trajectory::{Samples, interpolate};
use elbowroom::verify::{Trajectory, VerifySettings};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: check SCENE")?;
    let scene = parse(&std::fs::read_to_string(&file)?, &file)?.scene;
    let task = scene.tasks().first().ok_or("the scene has no task")?;
    let near = vec![0.5; scene.arm().links()];
    let at = |place: &Place| match place {
        Place::Configuration(q) => Some(q.clone()),
        Place::Tip(tip) => scene.arm().inverse_near(*tip, &near),
    };
    let (start, goal) = (at(&task.start).ok_or("start")?, at(&task.goal).ok_or("goal")?);
    // At rest at both ends: what lies between the rows is a quintic.
    let at_rest = vec![vec![0.0; near.len()]; 2];
    let rows = Samples {
        times: vec![0.0, 4.0],
        positions: vec![start.to_vec(), goal.to_vec()],
        velocities: Some(at_rest.clone()),
        accelerations: Some(at_rest),
    };
    let motion = interpolate(&rows)?.motion;
    let mut out = std::io::stdout();
    match Trajectory::certify(&scene, motion, &VerifySettings::default()) {
        Ok(_) => writeln!(out, "safe: proved for the whole motion")?,
        Err(verdict) => {
            for violation in &verdict.violations {
                writeln!(out, "not safe: {violation}")?;
            }
        }
    }
    Ok(())
}
