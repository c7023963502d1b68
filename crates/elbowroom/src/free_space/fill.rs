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
use crate::scene::TwoLinkScene;

/// Points of a small block.
const POINTS: usize = SIDE * SIDE;

/// Points of a block that is filled without asking whether to go on: about a millisecond even if the reference has to
/// decide on all of them.
const UNASKED: usize = 512;

/// What a [`Filler`] asks before it fills a part of a map again.
pub(super) struct Watch {
    /// Those rules that may have come or gone: what none of them could forbid is as it was.
    rules: Vec<Rule>,
    /// Which of them are open in the block at hand and in those it is part of, one list after the other.
    open: Vec<usize>,
    /// The cells that are in another state now, by their place in the part that is filled.
    pub(super) changed: Vec<usize>,
}

impl Watch {
    pub(super) fn new(rules: Vec<Rule>) -> Self {
        let open = (0..rules.len()).collect();
        Self { rules, open, changed: Vec::new() }
    }
}

/// What is worked out once for all points of a map.
pub(super) struct Filler<'a> {
    scene: TwoLinkScene<'a>,
    lengths: Lengths,
    rules: Vec<Rule>,
}

impl<'a> Filler<'a> {
    pub(super) fn new(scene: TwoLinkScene<'a>) -> Self {
        Self { scene, lengths: Lengths::of(scene.arm()), rules: Rule::all(scene) }
    }

    /// Points in a row.
    pub(super) fn columns(&self) -> usize {
        self.scene.grid().columns()
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
        if keep_going() {
            self.fill_watched(posture, first, marks, (None, keep_going));
        }
    }

    /// [`fill_rows`](Self::fill_rows), but only where a rule of the watch may have made a difference.
    pub(super) fn fill_watched<M: Kept>(
        &self,
        posture: Posture,
        first: usize,
        marks: &mut [M],
        (watch, keep_going): (Option<&mut Watch>, &dyn Fn() -> bool),
    ) {
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
            watched: 0..watch.as_ref().map_or(0, |watch| watch.rules.len()),
            watch,
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
    /// Where only some places are to be filled.
    watch: Option<&'f mut Watch>,
    /// The part of the watch's list that holds for the block at hand.
    watched: Range<usize>,
    keep_going: &'f dyn Fn() -> bool,
}

impl<M: Kept> Band<'_, M> {
    /// Fills `block`, where the rules in the part `open` of the list are open and `otherwise` marks what none forbids;
    /// false if it was stopped.
    fn fill(&mut self, block: &Block, open: Range<usize>, otherwise: Mark) -> bool {
        let (middle, radius) = block.circle_around(self.filler.scene.grid(), self.filler.scene.arm().base());
        self.middle.stand(&[middle.x], &[middle.y]);
        let slack = self.slack(radius);
        let around = self.watched.clone();
        if self.is_as_it_was(middle, radius, slack.as_ref()) {
            return true;
        }
        let end = self.open.len();
        let (open, otherwise) = self.still_open((middle, radius), slack.as_ref(), open, otherwise);
        let mut done = true;
        if open.is_empty() {
            for row in block.rows.clone() {
                self.fill_row(row, &block.columns, M::cut(otherwise));
            }
        } else if block.is_small() {
            self.fill_points(block, open, otherwise);
        } else {
            done = (block.points() < UNASKED || (self.keep_going)())
                && block.halves().iter().all(|half| self.fill(half, open.clone(), otherwise));
        }
        self.open.truncate(end);
        if let Some(watch) = &mut self.watch {
            watch.open.truncate(self.watched.start);
        }
        self.watched = around;
        done
    }

    /// Whether there is a watch and none of its rules could forbid anything within `radius` of `middle`, for which
    /// `self.middle` stands; else those that could are watched on.
    fn is_as_it_was(&mut self, middle: Point, radius: f64, slack: Option<&Slack>) -> bool {
        let Some(watch) = &mut self.watch else { return false };
        let start = watch.open.len();
        for place in self.watched.clone() {
            let rule = &watch.rules[watch.open[place]];
            if rule.may_forbid((middle, radius), &self.middle, slack) {
                watch.open.push(watch.open[place]);
            }
        }
        let none = watch.open.len() == start;
        if !none {
            self.watched = start..watch.open.len();
        }
        none
    }

    /// Which of the rules stay open in all of the block within `radius` of `middle`, for which `self.middle` stands, and
    /// what marks the places that none of them forbids.
    fn still_open(
        &mut self,
        (middle, radius): (Point, f64),
        slack: Option<&Slack>,
        open: Range<usize>,
        otherwise: Mark,
    ) -> (Range<usize>, Mark) {
        let start = self.open.len();
        for place in open {
            let rule = &self.filler.rules[self.open[place]];
            let mut mark = [FREE];
            match slack {
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

    fn slack(&self, radius: f64) -> Option<Slack> {
        Slack::around(&self.filler.lengths, self.middle.squared[0].sqrt(), radius)
    }

    /// Fills a small block, point by point.
    fn fill_points(&mut self, block: &Block, open: Range<usize>, otherwise: Mark) {
        let Filler { scene, rules, .. } = self.filler;
        let (grid, base, posture) = (scene.grid(), scene.arm().base(), self.posture);
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
            let mut before = [M::cut(FREE); SIDE];
            let marks = self.row(row, &columns);
            before[..marks.len()].copy_from_slice(marks);
            for (mark, &found) in marks.iter_mut().zip(found) {
                *mark = M::cut(found);
            }
            for ((mark, &found), column) in marks.iter_mut().zip(found).zip(columns.clone()) {
                if found == UNDECIDED {
                    let tip = Point::new(grid.x(column), grid.y(row));
                    *mark = M::cut(mark_of(state_of(*scene, tip, posture)));
                }
            }
            if self.watch.is_some() {
                self.tell_changes(row, &columns, &before);
            }
        }
    }

    /// Marks part of a row alike.
    fn fill_row(&mut self, row: usize, columns: &Range<usize>, mark: M) {
        let at = self.place(row, columns);
        if let Some(watch) = &mut self.watch {
            let marks = self.marks[at.clone()].iter();
            watch
                .changed
                .extend(at.clone().zip(marks).filter(|(_, old)| **old != mark).map(|(cell, _)| cell));
        }
        self.marks[at].fill(mark);
    }

    /// Notes which marks in a part of a row are others than `before`.
    fn tell_changes(&mut self, row: usize, columns: &Range<usize>, before: &[M]) {
        let at = self.place(row, columns);
        let Some(watch) = &mut self.watch else { return };
        let pairs = at.clone().zip(self.marks[at].iter().zip(before));
        watch.changed.extend(pairs.filter(|(_, (new, old))| new != old).map(|(cell, _)| cell));
    }

    fn row(&mut self, row: usize, columns: &Range<usize>) -> &mut [M] {
        let at = self.place(row, columns);
        &mut self.marks[at]
    }

    fn place(&self, row: usize, columns: &Range<usize>) -> Range<usize> {
        let start = (row - self.first) * self.filler.columns();
        start + columns.start..start + columns.end
    }
}
