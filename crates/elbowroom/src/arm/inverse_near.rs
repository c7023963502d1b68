use super::{Arm, Configuration};
use crate::geometry::{Point, Vector};

/// Steps before the search from one configuration is given up.
const MOST_STEPS: usize = 200;

/// How near the tip has to come, as a share of the reach.
const NEAR_ENOUGH: f64 = 1e-12;

/// Damping at first, as a share of the reach squared; it shrinks while steps help and grows when they do not.
const DAMPING: f64 = 1e-3;

impl Arm {
    /// A configuration within the joint limits that puts the tip at `tip`, reached from `near` (rad) by damped least
    /// squares; `None` where the search ends short of it, which proves nothing.
    ///
    /// # Reference
    /// Wampler, *Manipulator inverse kinematic solutions based on vector formulations and damped least-squares methods*,
    /// IEEE T-SMC 16(1), 1986; the damping is adapted as in Levenberg's and Marquardt's method.
    pub fn inverse_near(&self, tip: Point, near: &[f64]) -> Option<Configuration> {
        let [_, farthest] = self.reach();
        let mut q = self.clamped(near.into());
        let mut off = tip - self.tip(&q);
        let mut damping = DAMPING;
        for _ in 0..MOST_STEPS {
            if off.length() <= NEAR_ENOUGH * farthest {
                return Some(q);
            }
            let columns = self.jacobian(&q);
            let next = self.clamped(step(&q, &columns, off, damping * farthest * farthest));
            let next_off = tip - self.tip(&next);
            if next_off.length() < off.length() {
                (q, off) = (next, next_off);
                damping = (damping * 0.1).max(f64::EPSILON);
            } else {
                damping *= 10.0;
                if damping > 1e6 {
                    return None;
                }
            }
        }
        None
    }
}

/// `q` moved by `Jᵀ (J Jᵀ + damping I)⁻¹ off`, with the columns of J given.
fn step(q: &[f64], columns: &[Vector], off: Vector, damping: f64) -> Configuration {
    let (mut xx, mut xy, mut yy) = (damping, 0.0, damping);
    for column in columns {
        xx += column.x * column.x;
        xy += column.x * column.y;
        yy += column.y * column.y;
    }
    let determinant = xx * yy - xy * xy;
    let weights =
        Vector::new((yy * off.x - xy * off.y) / determinant, (xx * off.y - xy * off.x) / determinant);
    q.iter().zip(columns).map(|(angle, column)| angle + column.dot(weights)).collect()
}
