use crate::trajectory::{Motion, SpeedLimits, spline_of};

/// Share by which the step is longer than the limits ask for, so that rounding does not break them.
const STEP_ROUNDING: f64 = 1e-9;

/// Control points of a uniform cubic B-spline that begins and ends at rest: the first three are one, and the last three.
#[derive(Clone)]
pub(super) struct ControlPoints {
    joints: usize,
    /// One after the other (rad).
    points: Vec<f64>,
}

impl ControlPoints {
    /// Along `motion`, of so many pieces.
    pub(super) fn of(motion: &Motion, pieces: usize) -> Self {
        let (start, duration) = (motion.start(), motion.duration());
        let at = |knot: usize| motion.at(start + duration * knot as f64 / pieces as f64).position;
        // A control point is near where the spline is one knot before.
        let knots = (0..pieces + 3).map(|i| match i {
            0..=2 => at(0),
            _ if i >= pieces => at(pieces),
            _ => at(i - 1),
        });
        Self { joints: motion.joints(), points: knots.flatten().collect() }
    }

    pub(super) fn joints(&self) -> usize {
        self.joints
    }

    /// How many points there are.
    pub(super) fn len(&self) -> usize {
        self.points.len() / self.joints
    }

    /// Pieces between knots.
    pub(super) fn pieces(&self) -> usize {
        self.len() - 3
    }

    /// Which points may be moved.
    pub(super) fn free(&self) -> std::ops::Range<usize> {
        3..self.len() - 3
    }

    pub(super) fn point(&self, i: usize) -> &[f64] {
        &self.points[i * self.joints..(i + 1) * self.joints]
    }

    /// With the free points moved to these (rad), one after the other.
    pub(super) fn with_free(&self, moved: &[f64]) -> Self {
        let mut points = self.points.clone();
        let first = self.free().start * self.joints;
        points[first..first + moved.len()].copy_from_slice(moved);
        Self { joints: self.joints, points }
    }

    /// The difference of this order that begins at point `i`, of joint `j` (rad).
    pub(super) fn difference(&self, order: usize, i: usize, j: usize) -> f64 {
        let terms = binomial(order).iter().enumerate();
        terms.map(|(k, factor)| factor * self.points[(i + k) * self.joints + j]).sum()
    }

    /// The least time between two knots (s) in which no joint breaks a limit: velocities stay within the hull of first differences.
    pub(super) fn least_step(&self, limits: &[SpeedLimits]) -> f64 {
        let mut least: f64 = 0.0;
        for (j, limits) in limits.iter().enumerate() {
            let greatest = |order: usize| {
                let all = (0..self.len() - order).map(|i| self.difference(order, i, j).abs());
                all.fold(0.0, f64::max)
            };
            least = least
                .max(greatest(1) / limits.velocity)
                .max((greatest(2) / limits.acceleration).sqrt())
                .max(libm::cbrt(greatest(3) / limits.jerk));
        }
        least * (1.0 + STEP_ROUNDING)
    }

    /// The sum of squares of all differences of this order (rad²).
    pub(super) fn squares(&self, order: usize) -> f64 {
        let all = (0..self.len() - order).flat_map(|i| (0..self.joints).map(move |j| (i, j)));
        all.map(|(i, j)| self.difference(order, i, j)).map(|difference| difference * difference).sum()
    }

    /// Where the joints are at `share` of a piece (rad).
    pub(super) fn position(&self, piece: usize, share: f64) -> Vec<f64> {
        let weights = weights(share);
        let at = |j: usize| (0..4).map(|k| weights[k] * self.points[(piece + k) * self.joints + j]).sum();
        (0..self.joints).map(at).collect()
    }

    /// The motion with so much time (s) between two knots, from time 0 on.
    pub(super) fn motion(&self, step: f64) -> Option<Motion> {
        let points: Vec<Vec<f64>> = (0..self.len()).map(|i| self.point(i).to_vec()).collect();
        spline_of(0.0, step, &points)
    }
}

/// What the four control points of a piece count at `share` of it.
pub(super) fn weights(share: f64) -> [f64; 4] {
    let (s, r) = (share, 1.0 - share);
    [
        r * r * r / 6.0,
        (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
        (3.0 * r * r * r - 6.0 * r * r + 4.0) / 6.0,
        s * s * s / 6.0,
    ]
}

/// The factors of a difference of this order.
pub(super) fn binomial(order: usize) -> &'static [f64] {
    match order {
        1 => &[-1.0, 1.0],
        2 => &[1.0, -2.0, 1.0],
        _ => &[-1.0, 3.0, -3.0, 1.0],
    }
}
