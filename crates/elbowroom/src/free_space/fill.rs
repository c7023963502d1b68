//! The quick way to fill a map.
//!
//! A band of rows is halved again and again, as long as some [`Rule`] can forbid one part of a block and allow the
//! rest. At the middle of a block each rule still open is asked with the slack that the arm has while its tip is
//! anywhere in the block: a rule that forbids nothing there is never asked again within it, and one that forbids all
//! of it settles it. What is left of a small block is asked point by point, several at a time; where rounding
//! could decide, the reference, [`state_of`], does. So almost all work lies along the borders of the free space,
//! and its amount grows with the number of points only as its root does.

use std::ops::Range;

use super::block::{Block, SIDE};
use super::rule::{ALLOWED, Rule, Slack, UNDECIDED};
use super::stances::{Lanes, Lengths, Stances};
use super::state::{CellState, state_of};
use crate::arm::Posture;
use crate::geometry::Point;
use crate::scene::Scene;

/// Points of a small block.
const POINTS: usize = SIDE * SIDE;

/// What is worked out once for all points of a map.
pub(super) struct Filler<'a> {
    scene: &'a Scene,
    lengths: Lengths,
    rules: Vec<Rule>,
    /// The state by which a mark is known: that of an allowed place, then those of the rules.
    states: Vec<CellState>,
}

impl<'a> Filler<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let rules = Rule::all(scene);
        let states = [CellState::Free].into_iter().chain(rules.iter().map(|rule| rule.state)).collect();
        Self { scene, lengths: Lengths::of(&scene.arm), rules, states }
    }

    /// Fills the part `states` of the map of `posture`, from the row `first` on; false if `keep_going`, asked every
    /// few hundred points, said no.
    pub(super) fn fill_rows(
        &self,
        posture: Posture,
        first: usize,
        states: &mut [CellState],
        keep_going: &dyn Fn() -> bool,
    ) -> bool {
        let columns = self.scene.grid.columns();
        let block = Block { columns: 0..columns, rows: first..first + states.len() / columns };
        let open: Vec<u64> = (1..self.states.len() as u64).collect();
        let all = 0..open.len();
        let mut band = Band {
            filler: self,
            posture,
            middle: Stances::new(self.lengths, posture),
            points: Stances::new(self.lengths, posture),
            first,
            states,
            open,
            keep_going,
        };
        band.fill(&block, all, ALLOWED)
    }
}

/// Some rows of one map, and what is at hand while they are filled.
struct Band<'f> {
    filler: &'f Filler<'f>,
    posture: Posture,
    middle: Stances<1>,
    points: Stances<POINTS>,
    first: usize,
    states: &'f mut [CellState],
    /// The numbers of the rules that are open in the block at hand and those it is part of, one list after the other.
    open: Vec<u64>,
    keep_going: &'f dyn Fn() -> bool,
}

impl Band<'_> {
    /// Fills `block`, where the rules in the part `open` of the list are open and `otherwise` marks what none forbids.
    fn fill(&mut self, block: &Block, open: Range<usize>, otherwise: u64) -> bool {
        let end = self.open.len();
        let (open, otherwise) = self.still_open(block, open, otherwise);
        let mut done = true;
        if open.is_empty() {
            self.fill_alike(block, otherwise);
        } else if block.is_small() {
            self.fill_points(block, open, otherwise);
        } else {
            done = (self.keep_going)()
                && block.halves().iter().all(|half| self.fill(half, open.clone(), otherwise));
        }
        self.open.truncate(end);
        done
    }

    /// Which of the rules stay open in all of `block`, and what marks the places that none of them forbids.
    fn still_open(&mut self, block: &Block, open: Range<usize>, otherwise: u64) -> (Range<usize>, u64) {
        let (middle, radius) = block.circle_around(&self.filler.scene.grid, self.filler.scene.arm.base());
        self.middle.stand(&[middle.x], &[middle.y]);
        let Some(slack) = self.slack(radius) else { return (open, otherwise) };
        let start = self.open.len();
        for place in open {
            let number = self.open[place];
            let mut mark = [ALLOWED];
            self.filler.rules[number as usize - 1].mark(number, &self.middle, &slack, &mut mark);
            match mark[0] {
                ALLOWED => {}
                UNDECIDED => self.open.push(number),
                forbidden => return (start..self.open.len(), forbidden),
            }
        }
        (start..self.open.len(), otherwise)
    }

    /// How far the arm moves at most while its tip goes anywhere within `radius` of the middle; `None` where it may
    /// leave the reach.
    ///
    /// The second joint's sine bounds it: the tip moves at least that many times as far as the elbow, and the square
    /// of the sine has no least value but at the ends of an interval of squared distances.
    fn slack(&self, radius: f64) -> Option<Slack> {
        let lengths = &self.filler.lengths;
        let distance = self.middle.squared[0].sqrt();
        let (near, far) = ((distance - radius).max(0.0), distance + radius);
        let squared = (2.0 * distance + radius) * radius;
        let (near, far_squared) = (near * near, far * far);
        if near > lengths.farthest_squared || far_squared < lengths.nearest_squared {
            return Some(Slack { squared, ..Slack::default() });
        }
        if near - lengths.nearest_squared < lengths.rounding
            || lengths.farthest_squared - far_squared < lengths.rounding
        {
            return None;
        }
        let area = lengths.area(near).min(lengths.area(far_squared));
        let product = lengths.first * lengths.second;
        let sine = area.sqrt() / (2.0 * product);
        let elbow = radius / sine;
        let joints = [elbow / lengths.first, far * radius / (product * sine)];
        Some(Slack { squared, joints, links: elbow })
    }

    fn fill_alike(&mut self, block: &Block, mark: u64) {
        let state = self.filler.states[mark as usize];
        for row in block.rows.clone() {
            self.row(row, &block.columns).fill(state);
        }
    }

    /// Fills a small block, point by point.
    fn fill_points(&mut self, block: &Block, open: Range<usize>, otherwise: u64) {
        let Filler { scene, rules, states, .. } = self.filler;
        let (grid, base) = (&scene.grid, scene.arm.base());
        let (mut x, mut y): (Lanes<POINTS>, Lanes<POINTS>) = ([0.0; POINTS], [0.0; POINTS]);
        // Lanes beyond the block's last column or row hold points that are not written.
        for lane in 0..POINTS {
            x[lane] = grid.x(block.columns.start + lane % SIDE) - base.x;
            y[lane] = grid.y(block.rows.start + lane / SIDE) - base.y;
        }
        self.points.stand(&x, &y);
        let mut marks = [otherwise; POINTS];
        // The first rule in order is asked last.
        for &number in self.open[open].iter().rev() {
            rules[number as usize - 1].mark(number, &self.points, &Slack::default(), &mut marks);
        }
        let posture = self.posture;
        for (row, marks) in block.rows.clone().zip(marks.chunks(SIDE)) {
            let first = block.columns.start;
            for (column, (state, &mark)) in self.row(row, &block.columns).iter_mut().zip(marks).enumerate() {
                *state = match states.get(mark as usize) {
                    Some(state) => *state,
                    None => state_of(scene, Point::new(grid.x(first + column), grid.y(row)), posture),
                };
            }
        }
    }

    fn row(&mut self, row: usize, columns: &Range<usize>) -> &mut [CellState] {
        let start = (row - self.first) * self.filler.scene.grid.columns();
        &mut self.states[start + columns.start..start + columns.end]
    }
}
