use std::error::Error;

use elbowroom::grid::Grid;
use elbowroom::scene::{Scene, parse};

/// The scene in a file, with `points` along each side of its grid.
pub(crate) fn load(file: &str, points: usize) -> Result<Scene, Box<dyn Error>> {
    let scene = parse(&std::fs::read_to_string(file)?, file)?.scene;
    let (low, columns) = (scene.grid().origin(), scene.grid().columns());
    let side = scene.grid().step() * (columns - 1) as f64;
    let step = side / (points - 1) as f64;
    let grid = Grid::new([low.x, low.x + side], [low.y, low.y + side], step)?;
    if grid.len() != points * points {
        return Err(format!("{file}: the grid is no square of {points} points a side").into());
    }
    Ok(scene.with_grid(grid))
}
