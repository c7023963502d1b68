//! Whether the arm may turn straight from one configuration to another: certified, not sampled.

use std::ops::Range;

use smallvec::SmallVec;

use crate::arm::Arm;
use crate::geometry::{Segment, Vector};
use crate::scene::{Obstacle, Scene};

/// Least clearance that a certified move keeps (m): twice the verifier's floor, so that what is certified here is not
/// refused there for a rounding.
pub const CERTIFIED_CLEARANCE: f64 = 2e-9;

/// Clearances looked at per link and what it must not touch before a move is given up as not free: a move of a metre that
/// stays within 8e-6 m of an obstacle all along may use them up, one that only passes by does not.
const MOST_LOOKS: u32 = 1 << 17;

/// The same where a refusal costs little.
const FEWER_LOOKS: u32 = 1 << 10;

/// Whether all links stay clear of all that they must not touch while each joint turns evenly from `from` to `to` (rad).
///
/// By bisection with a bound on the motion: over a stretch whose points move by no more than `b`, links that are clear
/// by `c0` at one end and `c1` at the other are clear all the way if `c0 + c1 > b`. `false` also when a clearance comes
/// down to [`CERTIFIED_CLEARANCE`], or cannot be told from it in bounded work, and where an obstacle of the scene moves.
/// Joint limits are not looked at: between two configurations within them there is no other.
///
/// # Panics
/// Unless both have a position for each joint.
///
/// # Reference
/// Schwarzer, Saha and Latombe, *Adaptive dynamic collision checking*, IEEE T-RO 21(3), 2005.
pub fn straight_move_is_free(scene: &Scene, from: &[f64], to: &[f64]) -> bool {
    is_clear(scene.arm(), scene.obstacles(), [from, to], Asked::CERTIFIED)
}

/// [`straight_move_is_free`] with `margin` (m) more clearance, and given up sooner: for moves that would be nice to have.
///
/// # Panics
/// Unless both have a position for each joint.
pub fn straight_move_keeps(scene: &Scene, from: &[f64], to: &[f64], margin: f64) -> bool {
    let asked = Asked { kept: CERTIFIED_CLEARANCE + margin, most_looks: FEWER_LOOKS, ..Asked::CERTIFIED };
    is_clear(scene.arm(), scene.obstacles(), [from, to], asked)
}

/// [`straight_move_is_free`] with one obstacle alone, and links free to touch each other.
pub(crate) fn straight_move_clears(arm: &Arm, obstacle: &Obstacle, from: &[f64], to: &[f64]) -> bool {
    let asked = Asked { of_itself: false, ..Asked::CERTIFIED };
    is_clear(arm, std::slice::from_ref(obstacle), [from, to], asked)
}

/// Clearance of each link at `q` (rad) from the nearest obstacle (m), base first; 0 or less in contact, infinite without
/// obstacles. One that moves counts where the scene has it.
///
/// # Panics
/// Unless `q` has a position for each joint.
pub fn link_clearances(scene: &Scene, q: &[f64]) -> SmallVec<[f64; 4]> {
    let half_width = scene.arm().half_width();
    let from_obstacles = |link: Segment| {
        let distances = scene.obstacles().iter().map(|obstacle| obstacle.distance_to_segment(link));
        distances.fold(f64::INFINITY, f64::min) - half_width
    };
    scene.arm().link_segments(q).map(from_obstacles).collect()
}

/// Least clearance at `q` (rad) between links that have to keep clear of each other (m); 0 or less in contact, infinite
/// where there are none.
///
/// # Panics
/// Unless `q` has a position for each joint.
pub fn self_clearance(scene: &Scene, q: &[f64]) -> f64 {
    let arm = scene.arm();
    let links = links_at(arm, q);
    let pairs = self_pairs(arm).map(|(a, b)| between(links[a], links[b], arm.half_width()));
    pairs.fold(f64::INFINITY, f64::min)
}

/// How far a point of each link can move (m), base first, while the joints turn evenly from `from` to `to` (rad).
pub fn motion_bounds(arm: &Arm, from: &[f64], to: &[f64]) -> SmallVec<[f64; 4]> {
    ways_of(arm.lengths(), from, to).collect()
}

/// How far a point of each of a chain of links can move (m), as seen from where the first begins.
fn ways_of(lengths: &[f64], from: &[f64], to: &[f64]) -> impl Iterator<Item = f64> {
    lengths.iter().zip(from.iter().zip(to)).scan((0.0, 0.0), |(turn, way), (length, (from, to))| {
        *turn += to - from;
        *way += length * f64::abs(*turn);
        Some(*way)
    })
}

/// Links that are no neighbours, each pair once, where they have to keep clear.
fn self_pairs(arm: &Arm) -> impl Iterator<Item = (usize, usize)> {
    let links = if arm.self_collision() { arm.links() } else { 0 };
    (0..links).flat_map(move |a| (a + 2..links).map(move |b| (a, b)))
}

type Links = SmallVec<[Segment; 8]>;

fn links_at(arm: &Arm, q: &[f64]) -> Links {
    arm.link_segments(q).collect()
}

/// What is asked of a move.
#[derive(Clone, Copy)]
struct Asked {
    /// Clearance that has to be left (m).
    kept: f64,
    /// Per pair.
    most_looks: u32,
    /// Whether links count that must not touch each other.
    of_itself: bool,
}

impl Asked {
    const CERTIFIED: Self = Self { kept: CERTIFIED_CLEARANCE, most_looks: MOST_LOOKS, of_itself: true };
}

/// Whether all pairs stay clear on the straight move.
fn is_clear(arm: &Arm, obstacles: &[Obstacle], [from, to]: [&[f64]; 2], asked: Asked) -> bool {
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
        // A short arm is quickly put anywhere: better to be done with an obstacle than to look at all others first.
        if ways.len() == 2 && !bisection.decides([from, to]) {
            return false;
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
    bisection.decides([from, to])
}

/// Clearance between two links (m).
fn between(a: Segment, b: Segment, half_width: f64) -> f64 {
    a.distance_to_segment(b) - 2.0 * half_width
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
    /// The arm at the place looked at last, as far as was asked.
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

    /// Whether those watched stay clear; ends the watch.
    fn decides(&mut self, [from, to]: [&[f64]; 2]) -> bool {
        if self.watched.is_empty() {
            return true;
        }
        self.places.clear();
        self.places.extend_from_slice(from);
        self.places.extend_from_slice(to);
        let is_clear = self.those_since(0, [0, from.len()], 1.0);
        self.watched.clear();
        is_clear
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

    /// Clearance at the place looked at last, beyond what is to be kept (m).
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
