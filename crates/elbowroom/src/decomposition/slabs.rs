use crate::free_space::merged;

/// Most of the distance between a wall and the obstacle that may be lost or gained between two slices, as a share.
const SLACK: f64 = 0.5;

/// Width below which slabs are not cut any more, in distances between wall and obstacle.
const NARROWEST: f64 = 0.1;

/// Width of the thinnest obstacle that walls stand inside of, in distances between wall and obstacle.
const THINNEST: f64 = 1e-4;

/// How obstacles are approximated by trapezoids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Approximation {
    /// Whether the trapezoids lie within the obstacles.
    pub(super) is_inner: bool,
    /// How far the walls of both are apart, in the unit of the plane; nearer at what is thin.
    pub(super) distance: f64,
}

impl Approximation {
    /// Trapezoids within the obstacles: all that is free is open.
    pub(crate) const fn inner(distance: f64) -> Self {
        Self { is_inner: true, distance }
    }

    /// Trapezoids around the obstacles: all that is open is free.
    pub(crate) const fn outer(distance: f64) -> Self {
        Self { is_inner: false, distance }
    }
}

/// A stretch of the first coordinate between two slices.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Slab {
    /// From and to.
    pub(crate) x: [f64; 2],
    /// What is closed, in order.
    pub(crate) barriers: Vec<Barrier>,
}

/// A closed trapezoid of a slab: intervals of the second coordinate at both ends; either may be a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Barrier {
    pub(crate) left: [f64; 2],
    pub(crate) right: [f64; 2],
}

/// Cuts one stretch of the first coordinate into slabs.
pub(crate) struct Cutter<'a> {
    /// What is forbidden of the second coordinate at a place of the first: intervals in order, apart.
    pub(crate) forbidden: &'a dyn Fn(f64) -> Vec<[f64; 2]>,
    pub(crate) approximation: Approximation,
    /// Where the second coordinate may be.
    pub(crate) range: [f64; 2],
    /// How wide the slabs are that are begun with.
    pub(crate) widest: f64,
    /// Asked before every slice.
    pub(crate) keep_going: &'a dyn Fn() -> bool,
}

/// A place of the first coordinate with what is closed there.
#[derive(Clone)]
struct Slice {
    x: f64,
    closed: Vec<[f64; 2]>,
}

impl Cutter<'_> {
    /// Slabs from `from` to `to`, each as wide as its walls stay near enough to the obstacles; `None` where `keep_going` said no.
    pub(crate) fn slabs(&self, from: f64, to: f64) -> Option<Vec<Slab>> {
        let count = ((to - from) / self.widest).ceil().max(1.0);
        let mut slabs = Vec::new();
        let mut left = self.slice(from)?;
        for i in 1..=count as usize {
            let x = if i as f64 == count { to } else { from + (to - from) * (i as f64 / count) };
            let right = self.slice(x)?;
            self.cut(&left, &right, &mut slabs)?;
            left = right;
        }
        Some(slabs)
    }

    fn slice(&self, x: f64) -> Option<Slice> {
        if !(self.keep_going)() {
            return None;
        }
        let [low, high] = self.range;
        let Approximation { is_inner, distance } = self.approximation;
        let mut closed: Vec<[f64; 2]> = Vec::new();
        for [from, to] in (self.forbidden)(x) {
            // Where an obstacle is only grazed a wall inside it would stand on rounding.
            if is_inner && to - from < THINNEST * distance {
                continue;
            }
            let shift = if is_inner { distance.min((to - from) / 4.0) } else { -distance };
            // At the end of the range, where it goes on or the stop is, there is no wall to be moved.
            let from = if from <= low { low } else { (from + shift).max(low) };
            let to = if to >= high { high } else { (to - shift).min(high) };
            match closed.last_mut() {
                Some(last) if from <= last[1] => last[1] = to,
                _ => closed.push([from, to]),
            }
        }
        Some(Slice { x, closed })
    }

    fn cut(&self, left: &Slice, right: &Slice, slabs: &mut Vec<Slab>) -> Option<()> {
        let middle = self.slice(0.5 * (left.x + right.x))?;
        // An edge may bend off the middle: quarters tell.
        let mut is_straight = self.is_straight(left, &middle, right, 0.5);
        for share in [0.25, 0.75] {
            is_straight = is_straight
                && self.is_straight(left, &self.slice(left.x + (right.x - left.x) * share)?, right, share);
        }
        let barriers = if is_straight {
            let ends = left.closed.iter().zip(&right.closed);
            ends.map(|(&left, &right)| Barrier { left, right }).collect()
        } else if right.x - left.x > NARROWEST * self.approximation.distance {
            self.cut(left, &middle, slabs)?;
            return self.cut(&middle, right, slabs);
        } else {
            self.squared([left, &middle, right])
        };
        slabs.push(Slab { x: [left.x, right.x], barriers });
        Some(())
    }

    /// Whether what is closed goes straight from `left` to `right`, nearly, by what it is at `share` of the way.
    fn is_straight(&self, left: &Slice, between: &Slice, right: &Slice, share: f64) -> bool {
        let count = left.closed.len();
        if [between.closed.len(), right.closed.len()] != [count; 2] {
            return false;
        }
        (0..count).all(|i| {
            let (a, m, b) = (left.closed[i], between.closed[i], right.closed[i]);
            let near = SLACK * self.approximation.distance.min((m[1] - m[0]) / 2.0);
            let off = |end: usize| a[end] + (b[end] - a[end]) * share - m[end];
            (0..2).all(|end| off(end).abs() <= near)
        })
    }

    /// Rectangles of what is closed in all of the slices or, for walls before the obstacles, in any.
    fn squared(&self, slices: [&Slice; 3]) -> Vec<Barrier> {
        let [first, others @ ..] = slices;
        let mut closed = first.closed.clone();
        for other in others {
            closed = if self.approximation.is_inner {
                in_both(&closed, &other.closed)
            } else {
                merged(closed.into_iter().chain(other.closed.iter().copied()).collect())
            };
        }
        closed.into_iter().map(|ends| Barrier { left: ends, right: ends }).collect()
    }
}

fn in_both(a: &[[f64; 2]], b: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let pairs = a.iter().flat_map(|a| b.iter().map(|b| [a[0].max(b[0]), a[1].min(b[1])]));
    pairs.filter(|[from, to]| to > from).collect()
}
