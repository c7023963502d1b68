use crate::arm::{Posture, TwoLink};

/// One number for each of `N` stances, side by side so that the compiler works on several at a time.
pub(super) type Lanes<const N: usize> = [f64; N];

/// How near to the ends of the reach a tip is left undecided, as a share of the farthest squared: there the elbow
/// moves with the root of the tip's rounding.
const REACH_ROUNDING: f64 = 1e-6;

/// What the links' lengths alone decide, worked out once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lengths {
    pub(super) first: f64,
    pub(super) second: f64,
    /// Squares of the ends of the reach (m²).
    pub(super) nearest_squared: f64,
    pub(super) farthest_squared: f64,
    /// How near to these a square is left undecided (m²).
    pub(super) rounding: f64,
}

impl Lengths {
    pub(super) fn of(arm: &TwoLink) -> Self {
        let [first, second] = arm.lengths();
        let [nearest, farthest] = arm.reach();
        let (nearest_squared, farthest_squared) = (nearest * nearest, farthest * farthest);
        let rounding = REACH_ROUNDING * farthest_squared;
        Self { first, second, nearest_squared, farthest_squared, rounding }
    }

    /// Sixteen times the square of the area between the links: 0 at the ends of the reach, negative beyond.
    #[inline(always)]
    pub(super) fn area(&self, squared: f64) -> f64 {
        (self.farthest_squared - squared) * (squared - self.nearest_squared)
    }
}

/// `N` ways to stand in one posture, each with its tip at a place of its own. Positions are seen from the base.
pub(super) struct Stances<const N: usize> {
    pub(super) lengths: Lengths,
    /// -1 for elbow-up, 1 for elbow-down: the sign of the second joint.
    sign: f64,
    /// Square of the distance from base to tip (m²).
    pub(super) squared: Lanes<N>,
    /// Root of [`Lengths::area`] (m²).
    root: Lanes<N>,
    pub(super) links: [Links<N>; 2],
}

/// The centre lines of one link in `N` stances: where each begins, and the way to its end (m).
pub(super) struct Links<const N: usize> {
    pub(super) x: Lanes<N>,
    pub(super) y: Lanes<N>,
    pub(super) dx: Lanes<N>,
    pub(super) dy: Lanes<N>,
    /// One by the square of the length (1/m²).
    pub(super) inverse_squared: f64,
}

impl<const N: usize> Links<N> {
    fn of_length(length: f64) -> Self {
        let zero = [0.0; N];
        Self { x: zero, y: zero, dx: zero, dy: zero, inverse_squared: 1.0 / (length * length) }
    }

    /// Square of the distance (m²) from the link of `lane` to (`x`, `y`).
    #[inline(always)]
    pub(super) fn squared_distance(&self, lane: usize, x: f64, y: f64) -> f64 {
        let (dx, dy) = (self.dx[lane], self.dy[lane]);
        squared_distance(x - self.x[lane], y - self.y[lane], dx, dy, self.inverse_squared)
    }
}

/// Square of the distance from the point (`x`, `y`) to the line from the origin to (`dx`, `dy`).
#[inline(always)]
pub(super) fn squared_distance(x: f64, y: f64, dx: f64, dy: f64, inverse_squared: f64) -> f64 {
    let fraction = ((x * dx + y * dy) * inverse_squared).clamp(0.0, 1.0);
    let (off_x, off_y) = (x - fraction * dx, y - fraction * dy);
    off_x * off_x + off_y * off_y
}

impl<const N: usize> Stances<N> {
    pub(super) fn new(lengths: Lengths, posture: Posture) -> Self {
        let sign = match posture {
            Posture::ElbowUp => -1.0,
            Posture::ElbowDown => 1.0,
        };
        let links = [Links::of_length(lengths.first), Links::of_length(lengths.second)];
        Self { lengths, sign, squared: [0.0; N], root: [0.0; N], links }
    }

    /// Puts the tips at (`x`, `y`). Out of reach and at its very ends the elbow is anywhere, or not a number.
    #[inline(always)]
    pub(super) fn stand(&mut self, x: &Lanes<N>, y: &Lanes<N>) {
        let lengths = self.lengths;
        let difference = (lengths.first - lengths.second) * (lengths.first + lengths.second);
        let [first, second] = &mut self.links;
        for lane in 0..N {
            let (x, y) = (x[lane], y[lane]);
            let squared = x * x + y * y;
            let root = lengths.area(squared).max(0.0).sqrt();
            // Along the ray to the tip and beside it, as shares of the distance: no root of the square needed.
            let half = 0.5 / squared;
            let along = (squared + difference) * half;
            let beside = -self.sign * root * half;
            let (elbow_x, elbow_y) = (along * x - beside * y, along * y + beside * x);
            (first.dx[lane], first.dy[lane]) = (elbow_x, elbow_y);
            (second.x[lane], second.y[lane]) = (elbow_x, elbow_y);
            (second.dx[lane], second.dy[lane]) = (x - elbow_x, y - elbow_y);
            (self.squared[lane], self.root[lane]) = (squared, root);
        }
    }

    /// Cosine and sine of a joint, from 0.
    #[inline(always)]
    pub(super) fn direction(&self, lane: usize, joint: usize) -> (f64, f64) {
        let Lengths { first, second, .. } = self.lengths;
        if joint == 0 {
            let inverse = 1.0 / first;
            (self.links[0].dx[lane] * inverse, self.links[0].dy[lane] * inverse)
        } else {
            let inverse = 1.0 / (2.0 * first * second);
            let cos = (self.squared[lane] - first * first - second * second) * inverse;
            (cos, self.sign * self.root[lane] * inverse)
        }
    }
}
