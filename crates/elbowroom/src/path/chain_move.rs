//! Straight moves of any number of links: one bisection for all pairs, so that each configuration is worked out once.

use std::ops::Range;

use smallvec::SmallVec;

use super::asked::Asked;
use super::clearance::{CERTIFIED_CLEARANCE, Links, between, links_at, motion_bounds, ways_of};
use crate::arm::Arm;
use crate::geometry::{Segment, Vector};
use crate::scene::Obstacle;

/// Whether all pairs stay clear on the straight move.
pub(super) fn is_clear(arm: &Arm, obstacles: &[Obstacle], [from, to]: [&[f64]; 2], asked: Asked) -> bool {
    let (starts, ends) = (links_at(arm, from), links_at(arm, to));
    let ways = motion_bounds(arm, from, to);
    let mut bisection = Bisection::new(arm, obstacles, asked);
    for (index, obstacle) in obstacles.iter().enumerate() {
        if obstacle.motion.is_some() {
            return false;
        }
        let clearance = |link| obstacle.distance_to_segment(link) - arm.half_width() - asked.kept;
        for (link, ((&start, &end), &way)) in starts.iter().zip(&ends).zip(&ways).enumerate() {
            let clearances = [clearance(start), clearance(end)];
            if !bisection.admits(Pair::Obstacle { link, obstacle: index }, way, clearances) {
                return false;
            }
        }
    }
    if asked.of_itself && arm.self_collision() {
        for a in 0..arm.links() {
            let after = a + 1;
            let ways = ways_of(&arm.lengths()[after..], &from[after..], &to[after..]);
            for (b, way) in (after..).zip(ways).skip(1) {
                let clearances =
                    [&starts, &ends].map(|links| between(links[a], links[b], arm.half_width()) - asked.kept);
                if !bisection.admits(Pair::Links(a, b), way, clearances) {
                    return false;
                }
            }
        }
    }
    bisection.all_are_clear([from, to])
}

/// A link and what it must not touch.
#[derive(Clone, Copy)]
enum Pair {
    Obstacle { link: usize, obstacle: usize },
    Links(usize, usize),
}

/// A pair that the clearances at the ends of the move do not decide.
struct Watched {
    pair: Pair,
    /// How far a point of the link can move on the whole move (m); of two links, as seen from the first.
    way: f64,
    looks_left: u32,
}

/// A pair that the clearances at the ends of a stretch do not decide.
#[derive(Clone, Copy)]
struct Open {
    /// Its place among those watched.
    watched: usize,
    /// Clearances at the ends of the stretch and in its middle, beyond what is to be kept (m).
    from: f64,
    to: f64,
    middle: f64,
}

/// Halves a straight move until every pair is decided on every stretch.
struct Bisection<'a> {
    arm: &'a Arm,
    obstacles: &'a [Obstacle],
    asked: Asked,
    watched: SmallVec<[Watched; 4]>,
    /// Those open in the stretch at hand and in those it is part of, one list after the other.
    open: SmallVec<[Open; 8]>,
    /// Positions of all joints (rad) at the ends of the stretch at hand and of those it is part of.
    places: SmallVec<[f64; 32]>,
    /// The arm at the place examined last, as far as was asked.
    links: Links,
}

impl<'a> Bisection<'a> {
    fn new(arm: &'a Arm, obstacles: &'a [Obstacle], asked: Asked) -> Self {
        Self {
            arm,
            obstacles,
            asked,
            watched: SmallVec::new(),
            open: SmallVec::new(),
            places: SmallVec::new(),
            links: SmallVec::new(),
        }
    }

    /// Whether a pair is clear at both ends of the move; watches it where that does not decide.
    fn admits(&mut self, pair: Pair, way: f64, [from, to]: [f64; 2]) -> bool {
        let is_clear = from > 0.0 && to > 0.0;
        if is_clear && !exceeds(from + to, way) {
            self.open.push(Open { watched: self.watched.len(), from, to, middle: 0.0 });
            self.watched.push(Watched { pair, way, looks_left: self.asked.most_looks });
        }
        is_clear
    }

    /// Whether those watched stay clear.
    fn all_are_clear(&mut self, [from, to]: [&[f64]; 2]) -> bool {
        self.places.extend_from_slice(from);
        self.places.extend_from_slice(to);
        self.those_since(0, [0, from.len()], 1.0)
    }

    /// Decides the pairs open from `start` on and takes them off.
    fn those_since(&mut self, start: usize, places: [usize; 2], share: f64) -> bool {
        let open = start..self.open.len();
        let is_clear = open.is_empty() || self.between_is_clear(places, open, share);
        self.open.truncate(start);
        is_clear
    }

    /// Whether the pairs `open` stay clear on a stretch between two places that is this `share` of the move. A share
    /// halves on every level, so that the recursion ends when the way falls below the clearances or one of them is gone.
    fn between_is_clear(&mut self, [from, to]: [usize; 2], open: Range<usize>, share: f64) -> bool {
        let mut last_link = 0;
        for open in &self.open[open.clone()] {
            let watched = &mut self.watched[open.watched];
            if watched.way * share <= CERTIFIED_CLEARANCE || watched.looks_left == 0 {
                return false;
            }
            watched.looks_left -= 1;
            let (Pair::Obstacle { link, .. } | Pair::Links(_, link)) = watched.pair;
            last_link = last_link.max(link);
        }
        let middle = self.go_to_middle([from, to], last_link);
        let half = share / 2.0;
        for i in open.clone() {
            let open = self.open[i];
            let watched = &self.watched[open.watched];
            let clearance = self.clearance(watched.pair);
            if !exceeds(clearance, 0.0) {
                return false;
            }
            self.open[i].middle = clearance;
            if !exceeds(open.from + clearance, watched.way * half) {
                self.open.push(Open { to: clearance, ..open });
            }
        }
        if !self.those_since(open.end, [from, middle], half) {
            return false;
        }
        for i in open.clone() {
            let open = self.open[i];
            if !exceeds(open.middle + open.to, self.watched[open.watched].way * half) {
                self.open.push(Open { from: open.middle, ..open });
            }
        }
        let is_clear = self.those_since(open.end, [middle, to], half);
        self.places.truncate(middle);
        is_clear
    }

    /// Puts the links up to `last_link` in the middle of two places, and tells where in the list that is.
    fn go_to_middle(&mut self, [from, to]: [usize; 2], last_link: usize) -> usize {
        let middle = self.places.len();
        let (mut start, mut direction) = (self.arm.base(), 0.0);
        self.links.clear();
        for (joint, &length) in self.arm.lengths().iter().enumerate() {
            let (from, to) = (self.places[from + joint], self.places[to + joint]);
            let angle = from + (to - from) * 0.5;
            self.places.push(angle);
            if joint <= last_link {
                direction += angle;
                let end = start + Vector::polar(length, direction);
                self.links.push(Segment::new(start, end));
                start = end;
            }
        }
        middle
    }

    /// Clearance at the place examined last, beyond what is to be kept (m).
    fn clearance(&self, pair: Pair) -> f64 {
        let (links, half_width) = (&self.links, self.arm.half_width());
        let clearance = match pair {
            Pair::Obstacle { link, obstacle } => {
                self.obstacles[obstacle].distance_to_segment(links[link]) - half_width
            }
            Pair::Links(a, b) => between(links[a], links[b], half_width),
        };
        clearance - self.asked.kept
    }
}

/// Whether `clearance` is greater than `way`: not where either is no number.
fn exceeds(clearance: f64, way: f64) -> bool {
    clearance > way
}
