use elbowroom::arm::Posture;
use elbowroom::free_space::FreeSpace;
use serde_json::json;

use super::{Outcome, runs, scenes};

/// The maps of both postures; writes a byte a point, 1 for free, elbow-up first; `-` for no file.
pub(crate) fn measure(file: &str, points: usize, runs: usize, out: &str) -> Outcome {
    let scene = scenes::load(file, points)?;
    let scene = scene.two_link()?;
    let (times, space) = runs::times(runs, || FreeSpace::of(scene));
    if out != "-" {
        let bytes: Vec<u8> = Posture::ALL
            .iter()
            .flat_map(|&posture| (0..scene.grid().len()).map(move |cell| (posture, cell)))
            .map(|(posture, cell)| u8::from(space.map(posture).is_free(cell)))
            .collect();
        std::fs::write(out, bytes)?;
    }
    Ok(json!({ "times_ms": times }))
}
