//! The grid: how many points, where they are, who neighbours whom, and which shapes are refused.

use elbowroom::geometry::Point;
use elbowroom::grid::{Grid, GridError, MAX_POINTS};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn both_ends_belong_to_it_where_the_step_divides_the_range() {
    // Ends as a scene file writes them: decimal numbers, none of them exact in binary.
    for step_text in ["0.1", "0.01", "0.005", "0.3", "0.7", "0.025", "2.5"] {
        let step: f64 = step_text.parse().unwrap();
        let thousandths = (step * 1000.0).round() as i64;
        for first in (-30_000..=30_000).step_by(1_100).chain([100, -100, 300, 700, 1_100]) {
            for steps in (0..40).chain([99, 100, 999, 1000, 4999]) {
                let [min, max] =
                    [first, first + steps * thousandths].map(|n| format!("{n}e-3").parse::<f64>().unwrap());
                let grid = Grid::new([min, max], [0.0, 0.0], step).unwrap();
                assert_eq!(grid.columns() as i64, steps + 1, "{min} to {max} by {step}");
                assert_eq!((grid.rows(), grid.len()), (1, grid.columns()));
                assert!((grid.x(grid.columns() - 1) - max).abs() < 1e-11);
            }
        }
    }
}

#[test]
fn a_step_that_does_not_divide_the_range_stays_inside() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..20_000 {
        let step = 0.01 + unit(&mut rng);
        let steps = (rng.next_u64() % 200) as f64;
        let min = 20.0 * unit(&mut rng) - 10.0;
        // Short of the next point by a thousandth of a step or more.
        let max = min + (steps + 0.999 * unit(&mut rng)) * step;
        let grid = Grid::new([0.0, 1.0], [min, max], step).unwrap();
        assert!(grid.rows() as f64 == steps + 1.0 || max - min < steps * step);
        assert!(grid.y(grid.rows() - 1) <= max + 1e-12);
        assert!(grid.y(grid.rows()) > max);
    }
}

#[test]
fn the_nearest_cell_of_a_point_is_the_cell_it_belongs_to() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..2_000 {
        let step = 0.001 + unit(&mut rng);
        let origin = [100.0 * unit(&mut rng) - 50.0, 100.0 * unit(&mut rng) - 50.0];
        let size = [unit(&mut rng), unit(&mut rng)].map(|u| 30.0 * u * step);
        let grid =
            Grid::new([origin[0], origin[0] + size[0]], [origin[1], origin[1] + size[1]], step).unwrap();
        assert_eq!(grid.origin(), grid.point(0));
        for cell in 0..grid.len() {
            let point = grid.point(cell);
            let (column, row) = grid.column_row(cell);
            assert_eq!(grid.cell(column, row), cell);
            assert_eq!(point, Point::new(grid.x(column), grid.y(row)));
            assert_eq!(grid.nearest(point), Some(cell));
            let off = [0, 1].map(|_| 0.98 * (unit(&mut rng) - 0.5) * step);
            assert_eq!(grid.nearest(Point::new(point.x + off[0], point.y + off[1])), Some(cell));
        }
        let corner = grid.point(grid.len() - 1);
        assert_eq!(grid.nearest(Point::new(corner.x + 0.51 * step, corner.y)), None);
        assert_eq!(grid.nearest(Point::new(origin[0], origin[1] - 0.51 * step)), None);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308] {
            assert_eq!(grid.nearest(Point::new(bad, corner.y)), None);
        }
    }
}

#[test]
fn neighbours_are_those_one_step_away_at_their_distance() {
    for (columns, rows) in [(1, 1), (1, 5), (2, 2), (5, 1), (3, 4), (9, 7)] {
        let step = 0.3;
        let grid =
            Grid::new([0.0, (columns - 1) as f64 * step], [-1.0, -1.0 + (rows - 1) as f64 * step], step)
                .unwrap();
        assert_eq!((grid.columns(), grid.rows()), (columns, rows));
        let cost = |a: usize, b: usize| {
            let found: Vec<f64> =
                grid.neighbours(a).filter(|&(cell, _)| cell == b).map(|(_, cost)| cost).collect();
            assert!(found.len() < 2);
            found.first().copied()
        };
        for a in 0..grid.len() {
            for b in 0..grid.len() {
                let distance = grid.point(a).distance(grid.point(b));
                match cost(a, b) {
                    Some(there) => {
                        assert!((there - distance).abs() < 1e-12);
                        assert_eq!(Some(there), cost(b, a));
                    }
                    None => assert!(a == b || distance > 1.5 * step),
                }
            }
        }
    }
}

#[test]
fn shapes_that_make_no_grid_are_refused() {
    let fine = [0.0, 1.0];
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(Grid::new(fine, fine, step), Err(GridError::Step { .. })), "{step}");
    }
    let ranges = [
        [1.0, 0.0],
        [f64::NAN, 1.0],
        [0.0, f64::NAN],
        [0.0, f64::INFINITY],
        [f64::NEG_INFINITY, 0.0],
        [f64::INFINITY, f64::INFINITY],
        [-1e308, 1e308],
    ];
    for range in ranges {
        assert!(matches!(Grid::new(range, fine, 0.1), Err(GridError::Range { axis: 'x', .. })), "{range:?}");
        assert!(matches!(Grid::new(fine, range, 0.1), Err(GridError::Range { axis: 'y', .. })), "{range:?}");
    }
    for (range, step) in
        [([0.0, 1e308], 0.1), (fine, 1e-300), (fine, 5e-324), (fine, 1e-5), ([0.0, 1e9], 1.0)]
    {
        assert!(matches!(Grid::new(range, range, step), Err(GridError::TooManyPoints { .. })), "{range:?}");
        assert!(!Grid::new(range, range, step).unwrap_err().to_string().is_empty());
    }
    // As many as are allowed, and one column more.
    let side = (MAX_POINTS as f64).sqrt().floor();
    assert!(Grid::new([1.0, side], [1.0, side], 1.0).is_ok());
    assert!(Grid::new([1.0, MAX_POINTS as f64], [0.0, 0.5], 1.0).is_ok());
    assert!(Grid::new([0.0, MAX_POINTS as f64], [0.0, 0.5], 1.0).is_err());
}

#[test]
fn ranges_of_no_length_or_far_from_the_origin_are_grids_still() {
    assert_eq!(Grid::new([2.0, 2.0], [3.0, 3.0], 5e-324).unwrap().len(), 1);
    assert_eq!(Grid::new([0.0, 0.5], [0.0, 0.5], 1e308).unwrap().len(), 1);
    assert_eq!(Grid::new([1e6 + 0.1, 1e6 + 0.4], [0.0, 0.0], 0.1).unwrap().len(), 4);
    assert_eq!(Grid::new([1e308, 1e308], [-1e308, -1e308], 1.0).unwrap().len(), 1);
}
