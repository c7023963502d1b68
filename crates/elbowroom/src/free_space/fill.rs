//! The quick way to fill a map.
//!
//! A band of rows is halved again and again, as long as some [`Rule`] can forbid one part of a block and allow the
//! rest. At the middle of a block each rule still open is asked with the slack that the arm has while its tip is
//! anywhere in the block: a rule that forbids nothing there is never asked again within it, and one that forbids all
//! of it settles it. What is left of a small block is asked point by point; where rounding could decide, the
//! reference, [`state_of`], does. So most of the work lies along the borders of the free space, and its amount grows
//! with the number of points only as its root does.
//!
//! Exact intervals of the first joint would need a search for each point and a case for each pair of shape and link;
//! blocks need a distance alone. The points of a small block are worked on as plain arrays, which the compiler turns
//! into the vector instructions every machine of its kind has; wider ones, chosen at run time, gained a tenth.

use std::ops::Range;

use super::block::{Block, SIDE};
use super::mark::{FREE, Kept, Mark, mark_of};
use super::rule::{Rule, Slack, UNDECIDED};
use super::stances::{Lanes, Lengths, Stances};
use super::state::state_of;
use crate::arm::Posture;
use crate::geometry::Point;
use crate::scene::Scene;

/// Points of a small block.
const POINTS: usize = SIDE * SIDE;

/// Points of a block that is filled without asking whether to go on: about a millisecond even if the reference has to
/// decide on all of them.
const UNASKED: usize = 512;

/// What is worked out once for all points of a map.
pub(super) struct Filler<'a> {
    scene: &'a Scene,
    lengths: Lengths,
    rules: Vec<Rule>,
}

impl<'a> Filler<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        Self { scene, lengths: Lengths::of(&scene.arm), rules: Rule::all(scene) }
    }

    /// Points in a row.
    pub(super) fn columns(&self) -> usize {
        self.scene.grid.columns()
    }

    /// Fills the part `marks` of the map of `posture`, from the row `first` on, unless `keep_going`, asked every few
    /// hundred points, says no.
    pub(super) fn fill_rows<M: Kept>(
        &self,
        posture: Posture,
        first: usize,
        marks: &mut [M],
        keep_going: &dyn Fn() -> bool,
    ) {
        if !keep_going() {
            return;
        }
        let columns = self.columns();
        let block = Block { columns: 0..columns, rows: first..first + marks.len() / columns };
        let all = 0..self.rules.len();
        let mut band = Band {
            filler: self,
            posture,
            middle: Stances::new(self.lengths, posture),
            points: Stances::new(self.lengths, posture),
            first,
            marks,
            open: all.clone().collect(),
            keep_going,
        };
        band.fill(&block, all, FREE);
    }
}

/// Some rows of one map, and what is at hand while they are filled.
struct Band<'f, M> {
    filler: &'f Filler<'f>,
    posture: Posture,
    middle: Stances<1>,
    points: Stances<POINTS>,
    first: usize,
    marks: &'f mut [M],
    /// The rules that are open in the block at hand and in those it is part of, one list after the other.
    open: Vec<usize>,
    keep_going: &'f dyn Fn() -> bool,
}

impl<M: Kept> Band<'_, M> {
    /// Fills `block`, where the rules in the part `open` of the list are open and `otherwise` marks what none forbids;
    /// false if it was stopped.
    fn fill(&mut self, block: &Block, open: Range<usize>, otherwise: Mark) -> bool {
        let end = self.open.len();
        let (open, otherwise) = self.still_open(block, open, otherwise);
        let mut done = true;
        if open.is_empty() {
            for row in block.rows.clone() {
                self.row(row, &block.columns).fill(M::cut(otherwise));
            }
        } else if block.is_small() {
            self.fill_points(block, open, otherwise);
        } else {
            done = (block.points() < UNASKED || (self.keep_going)())
                && block.halves().iter().all(|half| self.fill(half, open.clone(), otherwise));
        }
        self.open.truncate(end);
        done
    }

    /// Which of the rules stay open in all of `block`, and what marks the places that none of them forbids.
    fn still_open(&mut self, block: &Block, open: Range<usize>, otherwise: Mark) -> (Range<usize>, Mark) {
        let (middle, radius) = block.circle_around(&self.filler.scene.grid, self.filler.scene.arm.base());
        self.middle.stand(&[middle.x], &[middle.y]);
        let slack = self.slack(radius);
        let start = self.open.len();
        for place in open {
            let rule = &self.filler.rules[self.open[place]];
            let mut mark = [FREE];
            match &slack {
                Some(slack) => rule.mark(&self.middle, slack, &mut mark),
                None if rule.allows_around(middle, radius, &self.filler.lengths) => {}
                None => mark = [UNDECIDED],
            }
            match mark[0] {
                FREE => {}
                UNDECIDED => self.open.push(self.open[place]),
                forbidden => return (start..self.open.len(), forbidden),
            }
        }
        (start..self.open.len(), otherwise)
    }

    /// How far the arm moves at most while its tip goes anywhere within `radius` of the middle, if all of that is out
    /// of reach or all within; `None` where it may come to the ends of the reach.
    ///
    /// The second joint's sine bounds it: the tip moves at least that many times as far as the elbow, and the square
    /// of the sine has no least value but at the ends of an interval of squared distances.
    fn slack(&self, radius: f64) -> Option<Slack> {
        let lengths = &self.filler.lengths;
        let distance = self.middle.squared[0].sqrt();
        let (near, far) = ((distance - radius).max(0.0), distance + radius);
        let (near_squared, far_squared) = (near * near, far * far);
        let (past_nearest, short_of_farthest) =
            (|squared| squared - lengths.nearest_squared, |squared| lengths.farthest_squared - squared);
        if short_of_farthest(near_squared) < -lengths.rounding
            || past_nearest(far_squared) < -lengths.rounding
        {
            return Some(Slack::default());
        }
        if past_nearest(near_squared) < lengths.rounding || short_of_farthest(far_squared) < lengths.rounding
        {
            return None;
        }
        let area = lengths.area(near_squared).min(lengths.area(far_squared));
        let product = lengths.first * lengths.second;
        let sine = area.sqrt() / (2.0 * product);
        let elbow = radius / sine;
        let joints = [elbow / lengths.first, far * radius / (product * sine)];
        Some(Slack { joints, links: elbow })
    }

    /// Fills a small block, point by point.
    fn fill_points(&mut self, block: &Block, open: Range<usize>, otherwise: Mark) {
        let Filler { scene, rules, .. } = self.filler;
        let (grid, base, posture) = (&scene.grid, scene.arm.base(), self.posture);
        let (mut x, mut y): (Lanes<POINTS>, Lanes<POINTS>) = ([0.0; POINTS], [0.0; POINTS]);
        // Lanes beyond the block's last column or row hold points that are not kept.
        let across: [f64; SIDE] = std::array::from_fn(|i| grid.x(block.columns.start + i) - base.x);
        for (row, (x, y)) in x.chunks_exact_mut(SIDE).zip(y.chunks_exact_mut(SIDE)).enumerate() {
            x.copy_from_slice(&across);
            y.fill(grid.y(block.rows.start + row) - base.y);
        }
        self.points.stand(&x, &y);
        let mut found = [otherwise; POINTS];
        // The first rule in order is asked last.
        for &rule in self.open[open].iter().rev() {
            rules[rule].mark(&self.points, &Slack::default(), &mut found);
        }
        for (row, found) in block.rows.clone().zip(found.chunks(SIDE)) {
            let columns = block.columns.clone();
            let marks = self.row(row, &columns);
            for (mark, &found) in marks.iter_mut().zip(found) {
                *mark = M::cut(found);
            }
            for ((mark, &found), column) in marks.iter_mut().zip(found).zip(columns) {
                if found == UNDECIDED {
                    let tip = Point::new(grid.x(column), grid.y(row));
                    *mark = M::cut(mark_of(state_of(scene, tip, posture)));
                }
            }
        }
    }

    fn row(&mut self, row: usize, columns: &Range<usize>) -> &mut [M] {
        let start = (row - self.first) * self.filler.columns();
        &mut self.marks[start + columns.start..start + columns.end]
    }
}
