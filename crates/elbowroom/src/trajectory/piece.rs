/// Joint positions over a stretch of time as one polynomial of degree five per joint.
///
/// Joint `j` stands at the sum of `coefficients[j][k] * s^k` with `s` the time since `start`, from 0 to
/// `duration`.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// When it begins (s).
    pub start: f64,
    /// How long it lasts (s).
    pub duration: f64,
    /// Per joint, the constant first (rad, rad/s, rad/s², ...).
    pub coefficients: Vec<[f64; 6]>,
}

/// Where the joints are and how they move at one instant; one number per joint each.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Positions (rad).
    pub position: Vec<f64>,
    /// Velocities (rad/s).
    pub velocity: Vec<f64>,
    /// Accelerations (rad/s²).
    pub acceleration: Vec<f64>,
    /// Jerks (rad/s³).
    pub jerk: Vec<f64>,
}

/// The quintic, the constant first, from position, velocity and acceleration to position, velocity and acceleration over
/// a duration (s): the solution of eqs (12) to (21) of the paper, with time counted from the start.
pub(crate) fn quintic([q0, v0, a0]: [f64; 3], [q1, v1, a1]: [f64; 3], duration: f64) -> [f64; 6] {
    let t = duration;
    let h = q1 - q0;
    // Divided by t step by step: t⁵ would underflow long before t does.
    let c3 = ((20.0 * h / t - 8.0 * v1 - 12.0 * v0) / t - (3.0 * a0 - a1)) / (2.0 * t);
    let c4 = ((-30.0 * h / t + 14.0 * v1 + 16.0 * v0) / t + (3.0 * a0 - 2.0 * a1)) / (2.0 * t * t);
    let c5 = ((12.0 * h / t - 6.0 * (v1 + v0)) / t + (a1 - a0)) / (2.0 * t * t * t);
    [q0, v0, a0 / 2.0, c3, c4, c5]
}

/// The derivative of this order of the polynomial with these coefficients, the constant first, at `s`.
pub(super) fn derivative_at(coefficients: &[f64; 6], order: usize, s: f64) -> f64 {
    coefficients.iter().enumerate().skip(order).rev().fold(0.0, |sum, (k, c)| {
        let factor: usize = (k + 1 - order..=k).product();
        sum * s + c * factor as f64
    })
}

impl State {
    /// Standing still at `position` (rad).
    pub fn rest(position: &[f64]) -> Self {
        let zeros = vec![0.0; position.len()];
        let (velocity, acceleration, jerk) = (zeros.clone(), zeros.clone(), zeros);
        Self { position: position.to_vec(), velocity, acceleration, jerk }
    }

    fn of_joint(&self, j: usize) -> [f64; 3] {
        [self.position[j], self.velocity[j], self.acceleration[j]]
    }
}

impl Piece {
    /// The piece from `from` to `to` that meets position, velocity and acceleration at both ends: the
    /// solution of eqs (12) to (21) of the paper, with time counted from the piece's start.
    pub fn quintic(start: f64, duration: f64, from: &State, to: &State) -> Self {
        let joints = 0..from.position.len().min(to.position.len());
        let coefficients = joints.map(|j| quintic(from.of_joint(j), to.of_joint(j), duration)).collect();
        Self { start, duration, coefficients }
    }

    /// What is left of the piece from `s` seconds after its start on: the same polynomials about another point.
    #[must_use]
    pub fn after(&self, s: f64) -> Self {
        let shifted = |terms: &[f64; 6]| {
            // Horner's scheme again and again: each round leaves the next coefficient in its place.
            let mut terms = *terms;
            for done in 0..5 {
                for k in (done..5).rev() {
                    terms[k] += terms[k + 1] * s;
                }
            }
            terms
        };
        Self {
            start: self.start + s,
            duration: self.duration - s,
            coefficients: self.coefficients.iter().map(shifted).collect(),
        }
    }

    /// The joints at `s` seconds after the piece's start.
    pub fn at(&self, s: f64) -> State {
        let derivative =
            |order: usize| self.coefficients.iter().map(|terms| derivative_at(terms, order, s)).collect();
        State {
            position: derivative(0),
            velocity: derivative(1),
            acceleration: derivative(2),
            jerk: derivative(3),
        }
    }
}
