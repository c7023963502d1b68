//! Which cells have obstacles so near that a short way of the tip from there may touch them.

use std::ops::Range;

use super::block::{Block, SIDE};
use super::mark::FREE;
use super::rule::{Rule, Slack};
use super::space::moved;
use super::stances::{Lanes, Lengths, Stances};
use crate::arm::Posture;
use crate::geometry::Point;
use crate::scene::{Obstacle, TwoLinkScene};

/// Points of a small block.
const POINTS: usize = SIDE * SIDE;

/// Widest turn for which that holds (rad): a joint that turns farther may be sent the other way round.
const WIDEST_TURN: f64 = 1.0;

/// Clearance that short ways keep from what is not near (m): enough to certify them in a few looks.
const MARGIN: f64 = 2e-5;

/// Short ways of the tip, straight or not, that a graph has as edges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShortWays {
    /// The longest, from end to end (m).
    pub(crate) length: f64,
    /// How near to the ends of the reach they may do as they please (m).
    pub(crate) band: f64,
}

/// The cells of the map of `posture` from which one of the `ways` may come to touch an obstacle that is not where it was
/// `before`, as it was or as it is now in `scene`. Edges that lead from other cells are what they were.
///
/// `None` if there are more than `most`.
pub(crate) fn cells_near_moved(
    scene: TwoLinkScene<'_>,
    before: &[Obstacle],
    posture: Posture,
    ways: ShortWays,
    most: usize,
) -> Option<Vec<usize>> {
    let rules = Rule::contacts(scene.arm(), MARGIN, moved(before, scene.obstacles()).into_iter());
    let lengths = Lengths::of(scene.arm());
    let open = (0..rules.len()).collect();
    let mut near = Near {
        scene,
        ways,
        rules,
        middle: Stances::new(lengths, posture),
        points: Stances::new(lengths, posture),
        open,
        found: Vec::new(),
        most,
    };
    let all = Block { columns: 0..scene.grid().columns(), rows: 0..scene.grid().rows() };
    near.search(&all, 0..near.rules.len());
    (near.found.len() <= most).then_some(near.found)
}

struct Near<'s> {
    scene: TwoLinkScene<'s>,
    ways: ShortWays,
    rules: Vec<Rule>,
    middle: Stances<1>,
    points: Stances<POINTS>,
    /// The rules that matter in the block at hand and in those it is part of, one list after the other.
    open: Vec<usize>,
    found: Vec<usize>,
    /// How many may be found before it is given up.
    most: usize,
}

impl Near<'_> {
    fn search(&mut self, block: &Block, open: Range<usize>) {
        let (middle, radius) = block.circle_around(self.scene.grid(), self.scene.arm().base());
        self.middle.stand(&[middle.x], &[middle.y]);
        let distance = self.middle.squared[0].sqrt();
        if open.is_empty() || self.found.len() > self.most || self.is_out_of_reach(distance, radius) {
            return;
        }
        let slack = self.slack(distance, radius + self.ways.length, radius + self.ways.band);
        let end = self.open.len();
        for place in open {
            let rule = self.open[place];
            let matters = slack.is_none()
                || self.rules[rule].may_forbid((middle, radius), &self.middle, slack.as_ref());
            if matters {
                self.open.push(rule);
            }
        }
        let open = end..self.open.len();
        if block.is_small() {
            // The slack of a single point in the worst place of the block.
            let worst = slack.map(|slack| self.of_points(slack, radius));
            self.look_at_points(block, &open, worst);
        } else {
            for half in block.halves() {
                self.search(&half, open.clone());
            }
        }
        self.open.truncate(end);
    }

    /// Whether no tip within `radius` of one at `distance` from the base is in reach.
    fn is_out_of_reach(&self, distance: f64, radius: f64) -> bool {
        let lengths = &self.middle.lengths;
        let (near, far) = ((distance - radius).max(0.0), distance + radius);
        near * near > lengths.farthest_squared + lengths.rounding
            || far * far < lengths.nearest_squared - lengths.rounding
    }

    /// How far the arm goes at most on ways that stay within `radius` of a place at `distance` from the base; `None`
    /// where that is not known, or ways within `band` may do as they please.
    fn slack(&self, distance: f64, radius: f64, band: f64) -> Option<Slack> {
        let lengths = &self.middle.lengths;
        Slack::around(lengths, distance, band.max(radius))?;
        let slack = Slack::around(lengths, distance, radius)?;
        let is_narrow = slack.joints.iter().all(|turn| *turn <= WIDEST_TURN);
        // While the tip goes straight the elbow goes no farther than `slack.links`. Where both joints turn evenly instead,
        // the first link and the direction of the second stay between what they are at the ends of the way: the second
        // link's ends go no farther than the elbow, and than it, the way that its direction turned the tip, and the elbow.
        is_narrow.then_some(Slack { links: 2.0 * slack.links + radius, ..slack })
    }

    /// The part that the ways have in the `slack` of a block within `radius`.
    fn of_points(&self, slack: Slack, radius: f64) -> Slack {
        Slack { links: slack.links * self.ways.length / (radius + self.ways.length), ..slack }
    }

    fn look_at_points(&mut self, block: &Block, open: &Range<usize>, slack: Option<Slack>) {
        let (grid, base) = (self.scene.grid(), self.scene.arm().base());
        let Some(slack) = slack else {
            for row in block.rows.clone() {
                for column in block.columns.clone() {
                    let tip = Point::new(grid.x(column) - base.x, grid.y(row) - base.y);
                    if self.is_near(tip, open) {
                        self.found.push(grid.cell(column, row));
                    }
                }
            }
            return;
        };
        if open.is_empty() {
            return;
        }
        let (mut x, mut y): (Lanes<POINTS>, Lanes<POINTS>) = ([0.0; POINTS], [0.0; POINTS]);
        for lane in 0..POINTS {
            x[lane] = grid.x(block.columns.start + lane % SIDE) - base.x;
            y[lane] = grid.y(block.rows.start + lane / SIDE) - base.y;
        }
        self.points.stand(&x, &y);
        let mut marks = [FREE; POINTS];
        for &rule in &self.open[open.clone()] {
            self.rules[rule].mark(&self.points, &slack, &mut marks);
        }
        for (row, marks) in block.rows.clone().zip(marks.chunks(SIDE)) {
            let near = block.columns.clone().zip(marks).filter(|(_, mark)| **mark != FREE);
            self.found.extend(near.map(|(column, _)| grid.cell(column, row)));
        }
    }

    /// Whether the ways from the one place `tip`, seen from the base, are near.
    fn is_near(&mut self, tip: Point, open: &Range<usize>) -> bool {
        self.middle.stand(&[tip.x], &[tip.y]);
        let distance = self.middle.squared[0].sqrt();
        if self.is_out_of_reach(distance, 0.0) {
            return false;
        }
        let Some(slack) = self.slack(distance, self.ways.length, self.ways.band) else { return true };
        let rules = self.open[open.clone()].iter();
        rules.copied().any(|rule| self.rules[rule].may_forbid((tip, 0.0), &self.middle, Some(&slack)))
    }
}
