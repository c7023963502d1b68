use super::bernstein::Bernstein;

/// How far the bound may stay above the greatest value found, as a share of the greatest coefficient:
/// below it are only rounding errors.
const SLACK: f64 = 1e-14;

/// Halvings after which an interval is taken as it is.
const DEEPEST: u32 = 40;

/// Halvings in all after which every interval is taken as it is; a peak takes about two for each digit.
const MOST_HALVINGS: u32 = 2000;

/// Rounding of the terms of a polynomial and of its coefficients, in shares of what `Bernstein` allows for the latter: a
/// quintic from one stop to the other has terms that amount to 63 times its way.
const TERMS: f64 = 2.0;

/// The greatest value seen so far, over the pieces of a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Peak {
    /// A value that the polynomial takes, as far as its arithmetic goes.
    pub(super) value: f64,
    /// When (s).
    pub(super) time: f64,
    /// Proved: no value is greater.
    pub(super) bound: f64,
    /// The bound without what rounding may have put into it and into the terms themselves: a polynomial meant to end at a
    /// value gets no farther.
    pub(super) unrounded: f64,
}

struct Search {
    slack: f64,
    /// Where in the stretch the greatest value was found, if the stretch has it.
    place: Option<f64>,
    halvings_left: u32,
}

impl Peak {
    /// Before anything was seen.
    pub(super) const NONE: Self =
        Self { value: f64::NEG_INFINITY, time: 0.0, bound: f64::NEG_INFINITY, unrounded: f64::NEG_INFINITY };

    /// Looks at a polynomial over the stretch of time from `start`, `duration` long (s).
    pub(super) fn raise<const N: usize>(&mut self, polynomial: &Bernstein<N>, start: f64, duration: f64) {
        let [low, high] = polynomial.hull();
        let slack = SLACK * low.abs().max(high.abs());
        let mut place = None;
        let last = polynomial.coefficients[N - 1];
        for (fraction, value) in [(0.0, polynomial.coefficients[0]), (1.0, last)] {
            if value > self.value {
                self.value = value;
                place = Some(fraction);
            }
        }
        let mut search = Search { slack, place, halvings_left: MOST_HALVINGS };
        self.search(polynomial, (0.0, 1.0), &mut search, 0);
        if let Some(fraction) = search.place {
            self.time = start + duration * fraction;
        }
    }

    /// The ends of the interval from `from`, `width` long, have been examined.
    fn search<const N: usize>(
        &mut self,
        polynomial: &Bernstein<N>,
        (from, width): (f64, f64),
        search: &mut Search,
        depth: u32,
    ) {
        let high = if polynomial.is_monotone() {
            polynomial.coefficients[0].max(polynomial.coefficients[N - 1])
        } else {
            polynomial.hull()[1]
        };
        if high <= self.value + search.slack || depth == DEEPEST || search.halvings_left == 0 {
            self.bound = self.bound.max(high + polynomial.rounding);
            self.unrounded = self.unrounded.max(high - TERMS * polynomial.rounding);
            return;
        }
        search.halvings_left -= 1;
        let halves = polynomial.halves();
        let middle = halves[1].coefficients[0];
        let width = 0.5 * width;
        if middle > self.value {
            self.value = middle;
            search.place = Some(from + width);
        }
        for (half, from) in halves.iter().zip([from, from + width]) {
            self.search(half, (from, width), search, depth + 1);
        }
    }
}
