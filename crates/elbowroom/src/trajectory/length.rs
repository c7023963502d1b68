use super::piece::derivative_at;
use super::{Motion, Piece};
use crate::arm::Arm;
use crate::geometry::Vector;

/// Stretches that each piece is cut into for its integral; with five nodes each, lengths are right to a share of 1e-5,
/// and to 1e-9 where no joint turns back within a piece.
const STRETCHES: usize = 64;

/// Nodes and weights of Gauss and Legendre's rule of five points, over [-1, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.0, 0.568_888_888_888_888_9),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

impl Motion {
    /// Length of the tip's way with `arm` (m).
    pub fn tip_length(&self, arm: &Arm) -> f64 {
        self.integral(|piece, s| {
            let (mut direction, mut turn, mut velocity) = (0.0, 0.0, Vector::new(0.0, 0.0));
            for (length, terms) in arm.lengths().iter().zip(&piece.coefficients) {
                direction += derivative_at(terms, 0, s);
                turn += derivative_at(terms, 1, s);
                // Turned by a right angle, which changes no length.
                velocity = velocity + Vector::polar(length * turn, direction);
            }
            velocity.length()
        })
    }

    /// Length of the way in configuration space (rad).
    pub fn joint_length(&self) -> f64 {
        self.integral(|piece, s| {
            let square = |speed: f64| speed * speed;
            let squares = piece.coefficients.iter().map(|terms| square(derivative_at(terms, 1, s)));
            squares.sum::<f64>().sqrt()
        })
    }

    fn integral(&self, speed: impl Fn(&Piece, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for piece in self.pieces() {
            let half = piece.duration / STRETCHES as f64 / 2.0;
            for i in 0..STRETCHES {
                let middle = half * (2 * i + 1) as f64;
                sum += GAUSS.iter().map(|(x, w)| w * half * speed(piece, middle + half * x)).sum::<f64>();
            }
        }
        sum
    }
}
