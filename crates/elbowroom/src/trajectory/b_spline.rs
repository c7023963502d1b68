use super::{Motion, Piece, State};

/// A motion near a way that is told in time, from `start` (s) and a state on.
///
/// A uniform cubic B-spline whose control points are `way` every `step` seconds: it stays within the hull of four of them,
/// is never faster than the way is, and its acceleration and jerk are those of the way's differences. The first three
/// control points are those that `state` asks for, and the third stands for `step` seconds after `start`; from the way's
/// `end` on the motion comes to rest within four steps.
pub(crate) fn spline_along(
    start: f64,
    state: &State,
    step: f64,
    end: f64,
    way: impl Fn(f64) -> Vec<f64>,
) -> Option<Motion> {
    let mut control = first_points(state, step);
    let mut time = start + step;
    while time < end {
        time += step;
        control.push(way(time.min(end)));
    }
    let last = control.last()?.clone();
    control.extend([last.clone(), last]);
    spline_of(start, step, &control)
}

/// The uniform cubic B-spline with these control points (rad) every `step` seconds; it begins at `start` (s), near the second.
pub(crate) fn spline_of(start: f64, step: f64, control: &[Vec<f64>]) -> Option<Motion> {
    let states: Vec<State> = control.windows(3).map(|points| at_knot(points, step)).collect();
    let pieces = states.windows(2).enumerate().map(|(i, ends)| {
        // A cubic is the quintic between its own ends.
        Piece::quintic(start + step * i as f64, step, &ends[0], &ends[1])
    });
    Motion::new(pieces.collect()).ok()
}

/// Where a motion that begins with `state` is `step` seconds later, as far as its control points tell (rad).
pub(crate) fn third_point(state: &State, step: f64) -> Vec<f64> {
    let [_, _, third] = points(state, step);
    third
}

fn first_points(state: &State, step: f64) -> Vec<Vec<f64>> {
    points(state, step).to_vec()
}

fn points(state: &State, step: f64) -> [Vec<f64>; 3] {
    let joint = |j: usize| {
        let [q, v, a] = [state.position[j], state.velocity[j] * step, state.acceleration[j] * step * step];
        let middle = q - a / 6.0;
        [middle - v + a / 2.0, middle, middle + v + a / 2.0]
    };
    let joints: Vec<[f64; 3]> = (0..state.position.len()).map(joint).collect();
    [0, 1, 2].map(|k| joints.iter().map(|points| points[k]).collect())
}

fn at_knot(points: &[Vec<f64>], step: f64) -> State {
    let joint = |j: usize| {
        let [a, b, c] = [points[0][j], points[1][j], points[2][j]];
        [(a + 4.0 * b + c) / 6.0, (c - a) / (2.0 * step), (a - 2.0 * b + c) / (step * step)]
    };
    let joints: Vec<[f64; 3]> = (0..points[0].len()).map(joint).collect();
    let [position, velocity, acceleration] =
        [0, 1, 2].map(|order| joints.iter().map(|joint| joint[order]).collect::<Vec<f64>>());
    let jerk = vec![0.0; position.len()];
    State { position, velocity, acceleration, jerk }
}

#[cfg(test)]
mod tests {
    use super::{spline_along, third_point};
    use crate::trajectory::State;

    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1);
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 * 2.0 - 1.0
        }
    }

    #[test]
    fn begins_with_the_state_and_ends_at_rest_at_the_end_of_the_way() {
        for seed in 0..2000 {
            let mut number = numbers(seed);
            let mut pair = |size: f64| vec![size * number(), size * number()];
            let state = State {
                position: pair(3.0),
                velocity: pair(1.5),
                acceleration: pair(4.0),
                jerk: vec![0.0; 2],
            };
            let step = 0.05 + 0.01 * (seed % 40) as f64;
            let third = third_point(&state, step);
            let turn = pair(0.5);
            let end = 2.0 + step + seed as f64 % 7.0;
            let way =
                |time: f64| (0..2).map(|j| third[j] + turn[j] * (time - 2.0 - step)).collect::<Vec<f64>>();
            let motion = spline_along(2.0, &state, step, end, way).unwrap();
            let (first, last) = (motion.at(2.0), motion.at(motion.end()));
            let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near(&first.position, &state.position));
            assert!(near(&first.velocity, &state.velocity));
            assert!(near(&first.acceleration, &state.acceleration));
            assert!(near(&last.position, &way(end)));
            assert!(near(&last.velocity, &[0.0; 2]) && near(&last.acceleration, &[0.0; 2]));
            assert!(motion.end() <= end + 4.0 * step);
            // Once the state it began with has no more part in it, it is no faster than the way.
            for look in 0..50 {
                let time = 2.0 + 3.0 * step + (motion.end() - 2.0 - 3.0 * step) * f64::from(look) / 49.0;
                let velocity = motion.at(time).velocity;
                assert!(velocity.iter().zip(&turn).all(|(v, most)| v.abs() <= most.abs() + 1e-9));
            }
        }
    }
}
