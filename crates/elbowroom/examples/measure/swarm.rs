use elbowroom::swarm::{Bounds, Neighbourhood, SwarmSettings, minimise};
use serde_json::json;

use super::{Outcome, runs};

const DIMENSIONS: usize = 30;

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

/// 50 particles, 300 iterations on the 30-D sphere, with the coefficients that the peers are given too.
pub(crate) fn measure(runs: usize) -> Outcome {
    let bounds = Bounds::new(&[[-5.12, 5.12]; DIMENSIONS])?;
    let settings = SwarmSettings {
        particles: 50,
        iterations: 300,
        first_inertia: 0.729,
        last_inertia: 0.729,
        c_personal: 1.494,
        c_neighbour: 1.494,
        ..SwarmSettings::default()
    };
    let mut report = serde_json::Map::new();
    for (name, neighbourhood) in [("global", Neighbourhood::Global), ("ring", Neighbourhood::Ring { k: 2 })] {
        let settings = SwarmSettings { neighbourhood, ..settings };
        let mut bests = Vec::new();
        let (times, last) = runs::times(runs, || {
            minimise(sphere, &bounds, &settings, bests.len() as u64).map(|found| bests.push(found.value))
        });
        last?;
        report.insert(name.to_owned(), json!({ "times_ms": times, "best": bests }));
    }
    Ok(report.into())
}
