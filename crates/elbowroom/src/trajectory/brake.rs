use super::piece::{Piece, State};
use super::timing::{SpeedLimits, TICK, stretch};

/// By what share the next duration tried is longer.
const LONGER: f64 = 0.1;

/// Longest stop that is tried (s).
const LONGEST: f64 = 60.0;

/// The piece from `state` to rest, wherever that is, as short as this search finds under `limits`, one per joint; it
/// begins at `start` (s) and lasts a whole number of [`TICK`]. `None` where no duration keeps them, as when a joint
/// at its maximum speed is still being sped up.
///
/// All joints come to rest at once, each on the polynomial of degree four that meets its position, velocity and
/// acceleration and ends without velocity and acceleration.
pub fn brake(start: f64, state: &State, limits: &[SpeedLimits]) -> Option<Piece> {
    let mut ticks = 1.0_f64;
    while ticks * TICK <= LONGEST {
        let piece = stop_after(start, state, ticks * TICK);
        if stretch(&piece, limits) <= 1.0 {
            return Some(piece);
        }
        ticks = (ticks * (1.0 + LONGER)).ceil().max(ticks + 1.0);
    }
    None
}

fn stop_after(start: f64, state: &State, duration: f64) -> Piece {
    let t = duration;
    let coefficients = (0..state.position.len())
        .map(|j| {
            let (v, a) = (state.velocity[j], state.acceleration[j]);
            // Velocity v + a s + b s² + c s³ with value and slope 0 at the end.
            let b = -(3.0 * v / t + 2.0 * a) / t;
            let c = (a + 2.0 * v / t) / t / t;
            [state.position[j], v, a / 2.0, b / 3.0, c / 4.0, 0.0]
        })
        .collect();
    Piece { start, duration, coefficients }
}
