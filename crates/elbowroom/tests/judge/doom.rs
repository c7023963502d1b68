//! Whether an arm among moving discs is lost: a flood over configurations in time, which gives it every benefit of a doubt.

use std::f64::consts::{PI, TAU};

/// Width of a cell in both joints (rad) where cells are the coarsest, at least.
const CELL: f64 = 0.018_75;

/// Time between two layers (s), in which a joint gets two cells ahead at 1.5 rad/s.
const LAYER: f64 = 0.025;

/// Two links of 25 cm and 1 cm half width on the origin, the first joint continuous, the second within 2.6 rad either way;
/// both no faster than 1.5 rad/s.
const LINK: f64 = 0.25;
const HALF_WIDTH: f64 = 0.01;
const STOP: f64 = 2.6;
const ACCELERATION: f64 = 4.0;
const JERK: f64 = 40.0;

/// A disc: centre and radius (m).
pub(crate) type Disc = ([f64; 2], f64);

/// Whether no motion from `q` (rad), whatever its accelerations, keeps clear of `discs_at(time)` until `end` (s). A cell is
/// given up only if the arm is in contact in all of it, and at an instant; so `true` is a proof, `false` is none. Cells are
/// made `finer` by so much in each joint and in time.
pub(crate) fn is_doomed(q: [f64; 2], end: f64, finer: f64, discs_at: impl Fn(f64) -> Vec<Disc>) -> bool {
    let layer_time = LAYER / finer;
    let (wide, high) = ((TAU * finer / CELL).floor() as usize, (2.0 * STOP * finer / CELL).floor() as usize);
    let [cell, bend_cell] = [TAU / wide as f64, 2.0 * STOP / high as f64];
    let index = |i: usize, j: usize| i * high + j;
    let mut open = vec![false; wide * high];
    let first = [(q[0].rem_euclid(TAU) / cell) as usize % wide, ((q[1] + STOP) / bend_cell) as usize];
    open[index(first[0], first[1].min(high - 1))] = true;
    // How far a point of the arm may be from where it is in the middle of the cell.
    let off = (2.0 * LINK * cell + LINK * bend_cell) / 2.0;
    let layers = (end / layer_time) as usize;
    for layer in 1..=layers {
        open = spread(&spread(&open, wide, high), wide, high);
        let time = layer_time * layer as f64;
        let discs = discs_at(time);
        // From rest no joint gets farther than its acceleration and its jerk allow.
        let far = (ACCELERATION * time.powi(2) / 2.0).min(JERK * time.powi(3) / 6.0);
        for i in 0..wide {
            let shoulder = (i as f64 + 0.5) * cell;
            if ((shoulder - q[0] + PI).rem_euclid(TAU) - PI).abs() - cell / 2.0 > far {
                open[i * high..(i + 1) * high].fill(false);
                continue;
            }
            let elbow = [LINK * shoulder.cos(), LINK * shoulder.sin()];
            let is_lost = |a: [f64; 2], b: [f64; 2], off: f64| {
                discs.iter().any(|(center, radius)| distance(*center, a, b) < radius + HALF_WIDTH - off)
            };
            let first_lost = is_lost([0.0, 0.0], elbow, LINK * cell / 2.0);
            for j in 0..high {
                if !open[index(i, j)] {
                    continue;
                }
                let bend = (j as f64 + 0.5) * bend_cell - STOP;
                if (bend - q[1]).abs() - bend_cell / 2.0 > far {
                    open[index(i, j)] = false;
                    continue;
                }
                let angle = shoulder + bend;
                let tip = [elbow[0] + LINK * angle.cos(), elbow[1] + LINK * angle.sin()];
                open[index(i, j)] = !(first_lost || is_lost(elbow, tip, off));
            }
        }
        if !open.contains(&true) {
            return true;
        }
    }
    false
}

/// One cell ahead in both joints, the first going round.
fn spread(open: &[bool], wide: usize, high: usize) -> Vec<bool> {
    let mut along = vec![false; open.len()];
    for i in 0..wide {
        for j in 0..high {
            along[i * high + j] =
                (j.saturating_sub(1)..=(j + 1).min(high - 1)).any(|near| open[i * high + near]);
        }
    }
    let mut both = vec![false; open.len()];
    for i in 0..wide {
        for near in [(i + wide - 1) % wide, i, (i + 1) % wide] {
            for j in 0..high {
                both[i * high + j] |= along[near * high + j];
            }
        }
    }
    both
}

fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = along[0] * along[0] + along[1] * along[1];
    let share = ((along[0] * to[0] + along[1] * to[1]) / length).clamp(0.0, 1.0);
    (to[0] - share * along[0]).hypot(to[1] - share * along[1])
}
