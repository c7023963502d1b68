//! One step of the search: a linear program over control points, step and slack.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use super::control_points::{ControlPoints, binomial, weights};
use super::signed_distance::SignedDistance;
use crate::trajectory::SpeedLimits;

/// A place on the spline that is sampled, and all that is near there.
pub(super) struct Sample {
    pub(super) piece: usize,
    pub(super) share: f64,
    pub(super) signed_distances: Vec<SignedDistance>,
}

/// What a step is taken from, and how far it may go.
pub(super) struct Program<'a> {
    pub(super) control: &'a ControlPoints,
    /// Time between knots (s) about which its powers are linearised.
    pub(super) step: f64,
    pub(super) limits: &'a [SpeedLimits],
    /// Where each joint may be (rad).
    pub(super) ranges: &'a [[f64; 2]],
    pub(super) samples: &'a [Sample],
    /// Clearance to keep (m), and what counts as a length of 1 (m).
    pub(super) margin: f64,
    pub(super) reach: f64,
    /// How far each control point may move (rad).
    pub(super) trust: f64,
    /// What a slack of one reach costs, where the whole duration costs 1.
    pub(super) penalty: f64,
}

/// Rows of `A x <= b`.
#[derive(Default)]
struct Rows {
    row: Vec<usize>,
    column: Vec<usize>,
    value: Vec<f64>,
    most: Vec<f64>,
}

impl Rows {
    fn push(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, most: f64) {
        for (column, value) in terms {
            self.row.push(self.most.len());
            self.column.push(column);
            self.value.push(value);
        }
        self.most.push(most);
    }
}

impl Program<'_> {
    /// The control points it leads to; `None` where the solver finds none.
    pub(super) fn solved(&self) -> Option<ControlPoints> {
        let (control, joints) = (self.control, self.control.joints());
        let free = control.free();
        let unknowns = free.len() * joints;
        // The step as a share of what it was, and the slack as a share of the reach.
        let (step, slack) = (unknowns, unknowns + 1);
        let unknown = |i: usize, j: usize| free.contains(&i).then(|| (i - free.start) * joints + j);
        let mut rows = Rows::default();
        self.add_limits(&mut rows, &unknown, step);
        self.add_clearances(&mut rows, &unknown, slack);
        for i in free.clone() {
            for (j, [low, high]) in self.ranges.iter().enumerate() {
                let (x, at) = ((i - free.start) * joints + j, control.point(i)[j]);
                rows.push([(x, 1.0)], (at + self.trust).min(*high).max(at));
                rows.push([(x, -1.0)], -(at - self.trust).max(*low).min(at));
            }
        }
        rows.push([(slack, -1.0)], 0.0);
        let count = unknowns + 2;
        let matrix = CscMatrix::new_from_triplets(rows.most.len(), count, rows.row, rows.column, rows.value);
        let mut cost = vec![0.0; count];
        cost[step] = 1.0;
        cost[slack] = self.penalty;
        let cones = [SupportedConeT::NonnegativeConeT(rows.most.len())];
        let settings = DefaultSettings { verbose: false, max_iter: 60, ..DefaultSettings::default() };
        let nothing = CscMatrix::zeros((count, count));
        let mut solver = DefaultSolver::new(&nothing, &cost, &matrix, &rows.most, &cones, settings).ok()?;
        solver.solve();
        let solution = &solver.solution;
        let is_solved = matches!(solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        (is_solved && solution.x.iter().all(|x| x.is_finite()))
            .then(|| control.with_free(&solution.x[..unknowns]))
    }

    /// Differences of control points against powers of the step: `share^k >= 1 + k (share - 1)`, so that the linear bound is safe.
    fn add_limits(&self, rows: &mut Rows, unknown: &dyn Fn(usize, usize) -> Option<usize>, step: usize) {
        for (j, limits) in self.limits.iter().enumerate() {
            for (order, limit) in [(1, limits.velocity), (2, limits.acceleration), (3, limits.jerk)] {
                let power = order as f64;
                let most = limit * libm::pow(self.step, power);
                if !most.is_finite() {
                    continue;
                }
                for i in 0..self.control.len() - order {
                    let factors = binomial(order).iter().enumerate();
                    let mut terms = Vec::with_capacity(order + 2);
                    let mut known = 0.0;
                    for (k, factor) in factors {
                        match unknown(i + k, j) {
                            Some(x) => terms.push((x, factor / most)),
                            None => known += factor * self.control.point(i + k)[j] / most,
                        }
                    }
                    for sign in [1.0, -1.0] {
                        let signed = terms.iter().map(|&(x, value)| (x, sign * value));
                        rows.push(signed.chain([(step, -power)]), 1.0 - power - sign * known);
                    }
                }
            }
        }
    }

    /// Clearances, linear in the joints, against the margin less the slack.
    fn add_clearances(&self, rows: &mut Rows, unknown: &dyn Fn(usize, usize) -> Option<usize>, slack: usize) {
        for sample in self.samples {
            let weights = weights(sample.share);
            for it in &sample.signed_distances {
                let mut terms = vec![(slack, -1.0)];
                let mut here = 0.0;
                for (k, weight) in weights.iter().enumerate() {
                    for (j, slope) in it.gradient.iter().enumerate() {
                        let value = weight * slope / self.reach;
                        if let Some(x) = unknown(sample.piece + k, j)
                            && value != 0.0
                        {
                            terms.push((x, -value));
                            here += value * self.control.point(sample.piece + k)[j];
                        }
                    }
                }
                rows.push(terms, (it.distance - self.margin) / self.reach - here);
            }
        }
    }
}
