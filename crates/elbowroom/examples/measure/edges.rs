use elbowroom::arm::Posture;
use elbowroom::path::straight_move_is_free;
use elbowroom::scene::parse;
use serde_json::json;

use super::{Outcome, runs};

/// Straight moves between the configurations of neighbouring grid points in one posture, certified: for two links. For
/// more, between configurations of a fixed sequence.
pub(crate) fn measure(file: &str, runs: usize) -> Outcome {
    let scene = parse(&std::fs::read_to_string(file)?, file)?.scene;
    if let Ok(two_link) = scene.two_link() {
        let (arm, grid) = (two_link.arm(), two_link.grid());
        let mut moves = Vec::new();
        for posture in Posture::ALL {
            for cell in 0..grid.len() {
                let at = |cell: usize| {
                    let found = arm.inverse(grid.point(cell), posture).ok()?;
                    found.first().copied()
                };
                let Some(from) = at(cell) else { continue };
                let (column, row) = (cell % grid.columns(), cell / grid.columns());
                for (dx, dy) in [(1, 0), (0, 1), (1, 1)] {
                    if column + dx < grid.columns() && row + dy < grid.rows() {
                        let other = (row + dy) * grid.columns() + column + dx;
                        moves.extend(at(other).map(|to| (from, to)));
                    }
                }
            }
        }
        let (times, free) = runs::times(runs, || {
            moves.iter().filter(|(from, to)| straight_move_is_free(&scene, from, to)).count()
        });
        return Ok(json!({ "times_ms": times, "moves": moves.len(), "free": free }));
    }
    let joints = scene.arm().links();
    // Kronecker's sequence: spread evenly, the same everywhere.
    let at = |i: usize, spread: f64, around: f64| -> Vec<f64> {
        (0..joints)
            .map(|j| around + spread * (((i * (2 * j + 3)) as f64 * 0.618_033_988_75).fract() - 0.5))
            .collect()
    };
    let moves: Vec<(Vec<f64>, Vec<f64>)> = (0..20_000)
        .map(|i| {
            let from = at(i, 3.0, 0.0);
            let to = from.iter().zip(at(i + 7, 0.2, 0.0)).map(|(a, b)| a + b).collect();
            (from, to)
        })
        .collect();
    let (times, free) = runs::times(runs, || {
        moves.iter().filter(|(from, to)| straight_move_is_free(&scene, from, to)).count()
    });
    Ok(json!({ "times_ms": times, "moves": moves.len(), "free": free }))
}
