//! A judge of motions that shares no code with the crate: textbook kinematics, another library's distances, and many
//! looks.

use elbowroom::arm::JointLimits;
use elbowroom::scene::Scene;
use elbowroom::trajectory::{Motion, Piece};

use crate::distance::distance;

/// Where base, elbow and tip are at `q` (m).
pub(crate) fn skeleton(scene: &Scene, q: [f64; 2]) -> [[f64; 2]; 3] {
    let (base, lengths) = (scene.arm().base(), scene.arm().lengths());
    let (l1, l2) = (lengths[0], lengths[1]);
    let elbow = [base.x + l1 * q[0].cos(), base.y + l1 * q[0].sin()];
    let tip = [elbow[0] + l2 * (q[0] + q[1]).cos(), elbow[1] + l2 * (q[0] + q[1]).sin()];
    [[base.x, base.y], elbow, tip]
}

/// Least clearance of both links at `q` (m); 0 or less in contact.
pub(crate) fn clearance(scene: &Scene, q: [f64; 2]) -> f64 {
    let [base, elbow, tip] = skeleton(scene, q);
    let links = [(base, elbow), (elbow, tip)];
    let distances = links.iter().flat_map(|&(a, b)| scene.obstacles().iter().map(move |o| distance(o, a, b)));
    distances.fold(f64::INFINITY, f64::min) - scene.arm().half_width()
}

/// Position and its first three derivatives of joint `j` at `s` seconds after the piece's start.
pub(crate) fn derivatives(piece: &Piece, j: usize, s: f64) -> [f64; 4] {
    let c = piece.coefficients[j];
    [
        c[0] + c[1] * s + c[2] * s.powi(2) + c[3] * s.powi(3) + c[4] * s.powi(4) + c[5] * s.powi(5),
        c[1] + 2.0 * c[2] * s + 3.0 * c[3] * s.powi(2) + 4.0 * c[4] * s.powi(3) + 5.0 * c[5] * s.powi(4),
        2.0 * c[2] + 6.0 * c[3] * s + 12.0 * c[4] * s.powi(2) + 20.0 * c[5] * s.powi(3),
        6.0 * c[3] + 24.0 * c[4] * s + 60.0 * c[5] * s.powi(2),
    ]
}

/// What is wrong with `motion` at any of `looks` instants of each piece, or between pieces; `None` if nothing is.
pub(crate) fn fault(scene: &Scene, motion: &Motion, looks: usize) -> Option<String> {
    let mut last: Option<[[f64; 4]; 2]> = None;
    for (index, piece) in motion.pieces().iter().enumerate() {
        for look in 0..=looks {
            let s = piece.duration * look as f64 / looks as f64;
            let state = [0, 1].map(|j| derivatives(piece, j, s));
            let q = [state[0][0], state[1][0]];
            let clearance = clearance(scene, q);
            if clearance <= 0.0 {
                return Some(format!("clearance {clearance} m in piece {index} at {s} s"));
            }
            for (j, joint) in scene.arm().joints().iter().enumerate() {
                if let JointLimits::Range { min, max } = joint.limits
                    && !(min - 1e-9..=max + 1e-9).contains(&q[j])
                {
                    return Some(format!("joint {} at {} rad in piece {index}", j + 1, q[j]));
                }
                let limits = [joint.motion.velocity, joint.motion.acceleration, joint.motion.jerk];
                for (k, limit) in limits.into_iter().enumerate() {
                    let rate = state[j][k + 1].abs();
                    if limit.is_some_and(|limit| rate > limit * (1.0 + 1e-9)) {
                        return Some(format!("derivative {} of joint {} is {rate}", k + 1, j + 1));
                    }
                }
            }
            if let (0, Some(last)) = (look, last) {
                for j in 0..2 {
                    let scale = 1.0 + last[j].iter().take(3).fold(0.0f64, |m, v| m.max(v.abs()));
                    if (0..3).any(|k| (last[j][k] - state[j][k]).abs() > 1e-6 * scale) {
                        return Some(format!("joint {} jumps before piece {index}", j + 1));
                    }
                }
            }
            if look == looks {
                last = Some(state);
            }
        }
    }
    None
}
