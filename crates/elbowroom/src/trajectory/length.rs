use super::{Motion, Piece};
use crate::arm::TwoLinkArm;
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

impl Motion<2> {
    /// Length of the tip's way with `arm` (m).
    pub fn tip_length(&self, arm: &TwoLinkArm) -> f64 {
        let [l1, l2] = arm.lengths();
        self.integral(|piece, s| {
            let state = piece.at(s);
            let ([q1, q2], [v1, v2]) = (state.position, state.velocity);
            // Turned by a right angle, which changes no length.
            (Vector::polar(l1 * v1, q1) + Vector::polar(l2 * (v1 + v2), q1 + q2)).length()
        })
    }

    /// Length of the way in configuration space (rad).
    pub fn joint_length(&self) -> f64 {
        self.integral(|piece, s| {
            let [v1, v2] = piece.at(s).velocity;
            libm::hypot(v1, v2)
        })
    }

    fn integral(&self, speed: impl Fn(&Piece<2>, f64) -> f64) -> f64 {
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
