//! One step of the search: a convex program over control points, step and slacks.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use super::control_points::{ControlPoints, binomial, weights};
use super::length::{Linear as OfPoints, Place, sum_of_squares};
use super::signed_distance::SignedDistance;
use crate::trajectory::SpeedLimits;

/// How exactly a program is solved: a step gains more than that, or the search ends.
const TOLERANCE: f64 = 1e-6;

/// A place on the spline that is sampled, and all that is near there.
pub(super) struct Sample {
    pub(super) piece: usize,
    pub(super) share: f64,
    pub(super) signed_distances: Vec<SignedDistance>,
}

/// What is to be little.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cost {
    /// The step.
    Step,
    /// The sum of squares of the chords, which even chords along a shortest path have the least of, and by this share that of the
    /// differences of control points: each in terms of the last iterate.
    Chords(f64),
    /// The sum of squares of jerk; the step is no more than what the powers are linearised about.
    Jerk,
}

/// Chords whose sum counts.
pub(super) struct Chords {
    pub(super) places: Vec<Place>,
    /// The most that their sum may be, if that is bounded.
    pub(super) most: Option<f64>,
}

/// What a step is taken from, and how far it may go.
pub(super) struct Program<'a> {
    pub(super) control: &'a ControlPoints,
    pub(super) cost: Cost,
    /// Time between knots (s) about which its powers are linearised.
    pub(super) step: f64,
    pub(super) limits: &'a [SpeedLimits],
    /// Where each joint may be (rad).
    pub(super) ranges: &'a [[f64; 2]],
    pub(super) samples: &'a [Sample],
    pub(super) chords: Option<&'a Chords>,
    /// Clearance to keep (m), and what counts as a length of 1 (m).
    pub(super) margin: f64,
    pub(super) reach: f64,
    /// How far each control point may move (rad).
    pub(super) trust: f64,
    /// What a slack of one reach costs, where what is to be little is 1, and what a slack of the whole length does.
    pub(super) penalty: f64,
    pub(super) length_penalty: f64,
}

/// Rows of `A x <= b`, or of `b - A x` in a second-order cone.
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

/// Which unknown is which.
struct Unknowns {
    first: usize,
    last: usize,
    joints: usize,
}

impl Unknowns {
    /// Coordinate `j` of control point `i`; `None` of those that are fixed.
    fn of(&self, i: usize, j: usize) -> Option<usize> {
        (self.first..self.last).contains(&i).then(|| (i - self.first) * self.joints + j)
    }

    fn count(&self) -> usize {
        (self.last - self.first) * self.joints
    }

    /// The step as a share of what it was.
    fn step(&self) -> usize {
        self.count()
    }

    /// By how much the margin is missed, as a share of the reach.
    fn slack(&self) -> usize {
        self.count() + 1
    }

    /// By how much the length is exceeded, as a share of it.
    fn length_slack(&self) -> usize {
        self.count() + 2
    }

    /// Length of a chord.
    fn chord(&self, k: usize) -> usize {
        self.count() + 3 + k
    }
}

impl Program<'_> {
    /// The control points it leads to; `None` where the solver finds none.
    pub(super) fn solved(&self) -> Option<ControlPoints> {
        let free = self.control.free();
        let unknowns = Unknowns { first: free.start, last: free.end, joints: self.control.joints() };
        let mut rows = Rows::default();
        self.add_limits(&mut rows, &unknowns);
        self.add_clearances(&mut rows, &unknowns);
        self.add_trust(&mut rows, &unknowns);
        rows.push([(unknowns.slack(), -1.0)], 0.0);
        rows.push([(unknowns.length_slack(), -1.0)], 0.0);
        if self.cost == Cost::Jerk {
            rows.push([(unknowns.step(), 1.0)], 1.0);
        }
        let bounded = self.chords.and_then(|chords| Some((&chords.places[..], chords.most?)));
        let chords = bounded.map_or(0, |(places, _)| places.len() - 1);
        if let Some((_, most)) = bounded {
            let sum = (0..chords).map(|k| (unknowns.chord(k), 1.0 / most));
            rows.push(sum.chain([(unknowns.length_slack(), -1.0)]), 1.0);
        }
        let mut cones = vec![SupportedConeT::NonnegativeConeT(rows.most.len())];
        if let Some((places, _)) = bounded {
            self.add_chords(places, &mut rows, &unknowns, &mut cones);
        }

        let count = unknowns.chord(chords);
        let mut squares = Squares::new(count);
        squares.linear[unknowns.slack()] = self.penalty;
        squares.linear[unknowns.length_slack()] = self.length_penalty;
        match (self.cost, self.chords) {
            (Cost::Step, _) => squares.linear[unknowns.step()] = 1.0,
            (Cost::Jerk, _) => self.add_differences(&mut squares, &unknowns, 3, 1.0),
            (Cost::Chords(share), chords) => {
                self.add_differences(&mut squares, &unknowns, 1, share);
                let scale = 1.0 / chords.map_or(1.0, |chords| sum_of_squares(&chords.places));
                for (terms, known) in
                    chords.iter().flat_map(|it| self.coordinates(&it.places, &unknowns)).flatten()
                {
                    squares.add(&terms, known, scale);
                }
            }
        }
        let matrix = CscMatrix::new_from_triplets(rows.most.len(), count, rows.row, rows.column, rows.value);
        let settings = DefaultSettings {
            verbose: false,
            max_iter: 60,
            // Rows are of size 1 as they are, and a step needs no more digits than it is believed.
            tol_gap_abs: TOLERANCE,
            tol_gap_rel: TOLERANCE,
            tol_feas: TOLERANCE / 10.0,
            equilibrate_enable: false,
            iterative_refinement_enable: false,
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        let mut solver =
            DefaultSolver::new(&squares.matrix(), &squares.linear, &matrix, &rows.most, &cones, settings)
                .ok()?;
        solver.solve();
        let solution = &solver.solution;
        let is_solved = matches!(solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        (is_solved && solution.x.iter().all(|x| x.is_finite()))
            .then(|| self.control.with_free(&solution.x[..unknowns.count()]))
    }

    /// Differences of control points against powers of the step: `share^k >= 1 + k (share - 1)`, so that the linear bound is safe.
    fn add_limits(&self, rows: &mut Rows, unknowns: &Unknowns) {
        for (j, limits) in self.limits.iter().enumerate() {
            for (order, limit) in [(1, limits.velocity), (2, limits.acceleration), (3, limits.jerk)] {
                let power = order as f64;
                let most = limit * libm::pow(self.step, power);
                if !most.is_finite() {
                    continue;
                }
                for i in 0..self.control.len() - order {
                    let (terms, known) = self.difference(unknowns, order, i, j, 1.0 / most);
                    for sign in [1.0, -1.0] {
                        let signed = terms.iter().map(|&(x, value)| (x, sign * value));
                        rows.push(signed.chain([(unknowns.step(), -power)]), 1.0 - power - sign * known);
                    }
                }
            }
        }
    }

    /// The difference of this order that begins at point `i`, times `scale`: its terms, and what of it is fixed.
    fn difference(
        &self,
        unknowns: &Unknowns,
        order: usize,
        i: usize,
        j: usize,
        scale: f64,
    ) -> (Vec<(usize, f64)>, f64) {
        let mut terms = Vec::with_capacity(order + 2);
        let mut known = 0.0;
        for (k, factor) in binomial(order).iter().enumerate() {
            match unknowns.of(i + k, j) {
                Some(x) => terms.push((x, factor * scale)),
                None => known += factor * scale * self.control.point(i + k)[j],
            }
        }
        (terms, known)
    }

    /// Clearances, linear in the joints, against the margin less the slack.
    fn add_clearances(&self, rows: &mut Rows, unknowns: &Unknowns) {
        for sample in self.samples {
            let weights = weights(sample.share);
            for it in &sample.signed_distances {
                let mut terms = vec![(unknowns.slack(), -1.0)];
                let mut here = 0.0;
                for (k, weight) in weights.iter().enumerate() {
                    for (j, slope) in it.gradient.iter().enumerate() {
                        let value = weight * slope / self.reach;
                        if let Some(x) = unknowns.of(sample.piece + k, j)
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

    /// No control point moves far, or out of its joint's range.
    fn add_trust(&self, rows: &mut Rows, unknowns: &Unknowns) {
        for i in self.control.free() {
            for (j, [low, high]) in self.ranges.iter().enumerate() {
                let Some(x) = unknowns.of(i, j) else { continue };
                let at = self.control.point(i)[j];
                rows.push([(x, 1.0)], (at + self.trust).min(*high).max(at));
                rows.push([(x, -1.0)], -(at - self.trust).max(*low).min(at));
            }
        }
    }

    /// No chord is longer than what stands for its length.
    fn add_chords(
        &self,
        places: &[Place],
        rows: &mut Rows,
        unknowns: &Unknowns,
        cones: &mut Vec<SupportedConeT<f64>>,
    ) {
        for (k, coordinates) in self.coordinates(places, unknowns).enumerate() {
            rows.push([(unknowns.chord(k), -1.0)], 0.0);
            let dimensions = coordinates.len();
            for (terms, known) in coordinates {
                rows.push(terms.into_iter().map(|(x, factor)| (x, -factor)), known);
            }
            cones.push(SupportedConeT::SecondOrderConeT(1 + dimensions));
        }
    }

    /// The coordinates of each chord: their terms, and what of them is fixed.
    fn coordinates<'a>(
        &'a self,
        places: &'a [Place],
        unknowns: &'a Unknowns,
    ) -> impl Iterator<Item = Vec<Linear>> + 'a {
        let linear: Vec<_> = places.iter().map(|place| place.linear(self.control)).collect();
        (1..linear.len()).map(move |k| {
            let pairs = linear[k - 1].iter().zip(&linear[k]);
            let coordinate = |(from, to): (&OfPoints, &OfPoints)| {
                let mut known = to.1 - from.1;
                let mut terms = Vec::with_capacity(from.0.len() + to.0.len());
                for (sign, of) in [(-1.0, &from.0), (1.0, &to.0)] {
                    for &(i, j, factor) in of {
                        match unknowns.of(i, j) {
                            Some(x) => terms.push((x, sign * factor)),
                            None => known += sign * factor * self.control.point(i)[j],
                        }
                    }
                }
                (terms, known)
            };
            pairs.map(coordinate).collect()
        })
    }

    /// The sum of squares of differences of this order, in terms of that of the last iterate, times `share`.
    fn add_differences(&self, squares: &mut Squares, unknowns: &Unknowns, order: usize, share: f64) {
        let scale = share / self.control.squares(order).max(f64::MIN_POSITIVE);
        for i in 0..self.control.len() - order {
            for j in 0..unknowns.joints {
                let (terms, known) = self.difference(unknowns, order, i, j, 1.0);
                squares.add(&terms, known, scale);
            }
        }
    }
}

/// A sum of unknowns times factors, and a constant.
type Linear = (Vec<(usize, f64)>, f64);

/// A cost: a sum of squares, and what is linear.
struct Squares {
    row: Vec<usize>,
    column: Vec<usize>,
    value: Vec<f64>,
    linear: Vec<f64>,
}

impl Squares {
    fn new(count: usize) -> Self {
        Self { row: Vec::new(), column: Vec::new(), value: Vec::new(), linear: vec![0.0; count] }
    }

    /// Adds the square of `terms` and what is `known`, times `scale`.
    fn add(&mut self, terms: &[(usize, f64)], known: f64, scale: f64) {
        for &(x, a) in terms {
            self.linear[x] += 2.0 * scale * known * a;
            for &(y, b) in terms {
                if x <= y {
                    self.row.push(x);
                    self.column.push(y);
                    self.value.push(2.0 * scale * a * b);
                }
            }
        }
    }

    /// Half of what is quadratic, the upper triangle of its matrix.
    fn matrix(&self) -> CscMatrix<f64> {
        let count = self.linear.len();
        CscMatrix::new_from_triplets(count, count, self.row.clone(), self.column.clone(), self.value.clone())
    }
}
