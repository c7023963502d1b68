/// Joint positions over a stretch of time as one polynomial of degree five per joint.
///
/// Joint `j` stands at the sum of `coefficients[j][k] * s^k` with `s` the time since `start`, from 0 to
/// `duration`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece<const DOF: usize> {
    /// When it begins (s).
    pub start: f64,
    /// How long it lasts (s).
    pub duration: f64,
    /// Per joint, the constant first (rad, rad/s, rad/s², ...).
    pub coefficients: [[f64; 6]; DOF],
}

/// Where the joints are and how they move at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<const DOF: usize> {
    /// Positions (rad).
    pub position: [f64; DOF],
    /// Velocities (rad/s).
    pub velocity: [f64; DOF],
    /// Accelerations (rad/s²).
    pub acceleration: [f64; DOF],
    /// Jerks (rad/s³).
    pub jerk: [f64; DOF],
}

impl<const DOF: usize> State<DOF> {
    /// Standing still at `position` (rad).
    pub const fn rest(position: [f64; DOF]) -> Self {
        Self { position, velocity: [0.0; DOF], acceleration: [0.0; DOF], jerk: [0.0; DOF] }
    }
}

impl<const DOF: usize> Piece<DOF> {
    /// The piece from `from` to `to` that meets position, velocity and acceleration at both ends: the
    /// solution of eqs (12) to (21) of the paper, with time counted from the piece's start.
    pub fn quintic(start: f64, duration: f64, from: &State<DOF>, to: &State<DOF>) -> Self {
        let t = duration;
        let coefficients = std::array::from_fn(|j| {
            let (q0, v0, a0) = (from.position[j], from.velocity[j], from.acceleration[j]);
            let h = to.position[j] - q0;
            let (v1, a1) = (to.velocity[j], to.acceleration[j]);
            // Divided by t step by step: t⁵ would underflow long before t does.
            let c3 = ((20.0 * h / t - 8.0 * v1 - 12.0 * v0) / t - (3.0 * a0 - a1)) / (2.0 * t);
            let c4 = ((-30.0 * h / t + 14.0 * v1 + 16.0 * v0) / t + (3.0 * a0 - 2.0 * a1)) / (2.0 * t * t);
            let c5 = ((12.0 * h / t - 6.0 * (v1 + v0)) / t + (a1 - a0)) / (2.0 * t * t * t);
            [q0, v0, a0 / 2.0, c3, c4, c5]
        });
        Self { start, duration, coefficients }
    }

    /// The joints at `s` seconds after the piece's start.
    pub fn at(&self, s: f64) -> State<DOF> {
        let derivative = |order: usize| {
            std::array::from_fn(|j| {
                self.coefficients[j].iter().enumerate().skip(order).rev().fold(0.0, |sum, (k, c)| {
                    let factor: usize = (k + 1 - order..=k).product();
                    sum * s + c * factor as f64
                })
            })
        };
        State {
            position: derivative(0),
            velocity: derivative(1),
            acceleration: derivative(2),
            jerk: derivative(3),
        }
    }
}
