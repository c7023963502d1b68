//! Pairs of a link and what it must not touch, and where both are at a time.

use smallvec::SmallVec;

use super::bernstein::Bernstein;
use super::clearance::{Axis, Body};
use super::moving::Way;
use super::verdict::Against;
use crate::arm::Arm;
use crate::trajectory::Piece;

/// Directions over a stretch of time of the links that carry a link, and of the link itself, last (rad).
pub(super) type Curves = SmallVec<[Bernstein<6>; 2]>;

/// One piece, for all links.
pub(super) struct Stretch {
    pub(super) start: f64,
    duration: f64,
    /// For each link that others are seen from, the directions of those after it; first those of all links, as seen
    /// from the base.
    directions: Vec<Vec<Bernstein<6>>>,
}

impl Stretch {
    pub(super) fn new(piece: &Piece, self_collision: bool) -> Self {
        let joints: Vec<Bernstein<6>> =
            piece.coefficients.iter().map(|terms| Bernstein::derivative(terms, 0, piece.duration)).collect();
        let summed = |first: usize| {
            let mut sums = vec![joints[first]];
            for joint in &joints[first + 1..] {
                sums.push(sums[sums.len() - 1].plus(joint));
            }
            sums
        };
        let seen_from = if self_collision { joints.len() } else { 1 };
        Self {
            start: piece.start,
            duration: piece.duration,
            directions: (0..seen_from).map(summed).collect(),
        }
    }

    pub(super) fn time(&self, fraction: f64) -> f64 {
        self.start + self.duration * fraction
    }
}

/// Every link with every obstacle and, where `links` are given, with every link before it that is no neighbour: that
/// one is at rest in the frame it is seen from, and the links between them are the carriers.
pub(super) fn pairs<'a>(
    arm: &'a Arm,
    obstacles: &'a [Body<'a>],
    ways: &[Option<Way<'a>>],
    links: &'a [Body<'a>],
    passed_jumps: &[f64],
    times: [f64; 2],
) -> Vec<Pair<'a>> {
    let lengths = arm.lengths();
    let base = [arm.base().x, arm.base().y];
    let half_width = arm.half_width();
    let reach = base[0].abs() + base[1].abs() + lengths.iter().sum::<f64>() + half_width;
    let carried = (0..lengths.len()).map(|j| lengths[j..].iter().sum::<f64>() * passed_jumps[j]);
    let jumps: f64 = carried.sum();
    let mut pairs = Vec::with_capacity((obstacles.len() + links.len()) * lengths.len());
    for (obstacle, (body, &way)) in obstacles.iter().zip(ways).enumerate() {
        if way.is_some_and(|way| !way.is_there()) {
            continue;
        }
        let (shift, moved) = way.map_or((0.0, 0.0), |way| (way.size(times), way.rounding(times)));
        for link in 0..lengths.len() {
            pairs.push(Pair {
                body,
                way,
                link,
                against: Against::Obstacle(obstacle),
                base,
                first: 0,
                lengths: &lengths[..=link],
                half_width,
                rounding: body.rounding(reach + shift) + moved + jumps,
            });
        }
    }
    for (other, body) in links.iter().enumerate() {
        for link in other + 2..lengths.len() {
            pairs.push(Pair {
                body,
                way: None,
                link,
                against: Against::Link(other + 1),
                base: [lengths[other], 0.0],
                first: other + 1,
                lengths: &lengths[other + 1..=link],
                half_width: 2.0 * half_width,
                rounding: body.rounding(reach) + jumps,
            });
        }
    }
    pairs
}

/// A link and what it must not touch.
#[derive(Clone, Copy)]
pub(super) struct Pair<'a> {
    pub(super) body: &'a Body<'a>,
    /// How the body moves, if it does.
    way: Option<Way<'a>>,
    pub(super) link: usize,
    pub(super) against: Against,
    /// Where the carriers begin.
    pub(super) base: [f64; 2],
    /// The joint that turns the first carrier.
    pub(super) first: usize,
    /// Of the carriers and, last, of the link (m).
    pub(super) lengths: &'a [f64],
    pub(super) half_width: f64,
    /// How far a clearance may be off (m).
    pub(super) rounding: f64,
}

impl Pair<'_> {
    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The link's centre line as the body sees it at `time` (s), with carriers and link in these directions (rad).
    pub(super) fn axis(&self, time: f64, mut directions: impl Iterator<Item = f64>) -> Axis {
        let [x, y] = self.way.map_or([0.0; 2], |way| way.shift(time));
        let mut start = [self.base[0] - x, self.base[1] - y];
        for length in &self.lengths[..self.lengths.len() - 1] {
            let (sin, cos) = libm::sincos(directions.next().unwrap_or(f64::NAN));
            start = [start[0] + length * cos, start[1] + length * sin];
        }
        let (sin, cos) = libm::sincos(directions.next().unwrap_or(f64::NAN));
        Axis { start, along: [cos, sin], length: self.length() }
    }

    /// Of a link whose centre line is `axis` at `time` (s) (m).
    pub(super) fn clearance(&self, axis: &Axis, time: f64) -> f64 {
        self.body.distance(axis) - self.half_width - self.way.map_or(0.0, |way| way.doubt(time))
    }

    /// How far the body is, at any time between two (s), from where it is in the middle, and how far its course may be in
    /// doubt there and then: in the middle, and at most (m).
    pub(super) fn spread(&self, [from, to]: [f64; 2], middle: f64) -> (f64, [f64; 2]) {
        self.way.map_or((0.0, [0.0; 2]), |way| {
            let most = way.doubt(from).max(way.doubt(to));
            (way.drift([from, to], way.shift(middle)), [way.doubt(middle), most])
        })
    }

    pub(super) fn curves<'a>(&self, stretch: &'a Stretch) -> &'a [Bernstein<6>] {
        &stretch.directions[self.first][..self.lengths.len()]
    }

    pub(super) fn axis_at(&self, stretch: &Stretch, fraction: f64) -> Axis {
        let curves = self.curves(stretch).iter();
        self.axis(stretch.time(fraction), curves.map(|curve| curve.value(fraction)))
    }

    pub(super) fn clearance_at(&self, stretch: &Stretch, fraction: f64) -> f64 {
        self.clearance(&self.axis_at(stretch, fraction), stretch.time(fraction))
    }
}
