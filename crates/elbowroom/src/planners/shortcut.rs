//! Pulls a certified path taut: corners are left out and cut for as long as what remains is certified.

use crate::arm::{Posture, joint_distance, lerp_pair};
use crate::path::{JointPath, straight_move_keeps};
use crate::path::{joint_path, pairs};
use crate::roadmap::direct;
use crate::scene::TwoLinkScene;

/// When a path is taut enough.
struct Settings {
    /// Rounds of leaving out and cutting; the gain falls by about half with each.
    rounds: usize,
    /// A round that gains less than this share of the length is the last.
    least_gain: f64,
    /// How often a cut is halved before a corner is left as it is.
    halvings: u32,
    /// More corners than this are not made.
    most_corners: usize,
}

const SETTINGS: Settings = Settings { rounds: 40, least_gain: 1e-4, halvings: 8, most_corners: 48 };

/// In what plane lines are straight.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Plane {
    /// That of the joints, with what a radian of each costs.
    Joints([f64; 2]),
    /// That of the tip; a straight line is followed in turns of at most so much tip travel (m).
    Tip(f64),
}

/// What lines may be taken.
pub(crate) struct Shortcut<'a> {
    pub(crate) scene: TwoLinkScene<'a>,
    pub(crate) plane: Plane,
    /// Clearance kept by what is new (m).
    pub(crate) margin: f64,
}

impl Shortcut<'_> {
    /// `path` pulled taut; every straight joint motion of the result is certified. `None` if `keep_going` said no.
    pub(crate) fn taut(&self, path: &JointPath, keep_going: &dyn Fn() -> bool) -> Option<JointPath> {
        let mut corners = self.galloped(&pairs(&path.0));
        let mut before = self.length(&corners);
        for _ in 0..SETTINGS.rounds {
            if !keep_going() {
                return None;
            }
            self.leave_out(&mut corners);
            if corners.len() <= SETTINGS.most_corners {
                corners = self.cut(&corners);
            }
            self.leave_out(&mut corners);
            let length = self.length(&corners);
            if before - length <= SETTINGS.least_gain * before {
                break;
            }
            before = length;
        }
        let mut places = vec![corners[0]];
        for pair in corners.windows(2) {
            // What was certified once is so again: the same numbers.
            if !self.join(&pair[0], &pair[1], &mut places) {
                places.push(pair[1]);
            }
        }
        Some(joint_path(&places))
    }

    /// `path`, taut already, without the corners that can be left out.
    pub(crate) fn thinned(&self, path: &JointPath) -> JointPath {
        let mut corners = self.galloped(&pairs(&path.0));
        self.leave_out(&mut corners);
        joint_path(&corners)
    }

    fn length(&self, corners: &[[f64; 2]]) -> f64 {
        corners.windows(2).map(|pair| self.distance(&pair[0], &pair[1])).sum()
    }

    fn distance(&self, a: &[f64; 2], b: &[f64; 2]) -> f64 {
        match self.plane {
            Plane::Joints(weights) => libm::hypot((b[0] - a[0]) * weights[0], (b[1] - a[1]) * weights[1]),
            Plane::Tip(_) => self.scene.arm().tip(a).distance(self.scene.arm().tip(b)),
        }
    }

    /// The place at `fraction` of the line from `a` to `b`.
    fn between(&self, a: &[f64; 2], b: &[f64; 2], fraction: f64) -> Option<[f64; 2]> {
        match self.plane {
            Plane::Joints(_) => Some(lerp_pair(a, b, fraction)),
            Plane::Tip(_) => {
                let arm = self.scene.arm();
                let (from, to) = (arm.tip(a), arm.tip(b));
                let posture = one_posture(a, b)?;
                let near = lerp_pair(a, b, fraction);
                let found = arm.inverse(from + (to - from) * fraction, posture).ok()?;
                found
                    .iter()
                    .filter_map(|q| direct(arm, &near, q))
                    .min_by(|p, q| joint_distance(p, &near).total_cmp(&joint_distance(q, &near)))
            }
        }
    }

    /// Appends the turns from `a`, left out, to `b` if they are certified.
    fn join(&self, a: &[f64; 2], b: &[f64; 2], places: &mut Vec<[f64; 2]>) -> bool {
        let known = places.len();
        let turns = match self.plane {
            Plane::Joints(_) => 1,
            Plane::Tip(_) if one_posture(a, b).is_none() => 1,
            Plane::Tip(most) => (self.distance(a, b) / most).ceil().max(1.0) as usize,
        };
        let mut from = *a;
        for turn in 1..=turns {
            let to = if turn == turns { Some(*b) } else { self.between(a, b, turn as f64 / turns as f64) };
            // Every configuration must be next to the one before it: no turn taken off on the way.
            let certified = to.filter(|to| {
                (0..2).all(|j| (to[j] - from[j]).abs() <= std::f64::consts::PI)
                    && straight_move_keeps(self.scene.scene(), &from, to, self.margin)
            });
            let Some(to) = certified else {
                places.truncate(known);
                return false;
            };
            places.push(to);
            from = to;
        }
        true
    }

    fn is_joined(&self, a: &[f64; 2], b: &[f64; 2]) -> bool {
        self.join(a, b, &mut Vec::new())
    }

    /// A first thinning out: from each corner as far as doubling leaps are certified and shorter.
    fn galloped(&self, places: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut corners = vec![places[0]];
        let mut at = 0;
        while at + 1 < places.len() {
            let mut leap = 1;
            while at + 2 * leap < places.len() && self.is_joined(&places[at], &places[at + 2 * leap]) {
                leap *= 2;
            }
            at += leap;
            corners.push(places[at]);
        }
        corners
    }

    /// Leaves out each corner whose neighbours can be joined.
    fn leave_out(&self, corners: &mut Vec<[f64; 2]>) {
        let mut i = 1;
        while i + 1 < corners.len() {
            let (a, b) = (&corners[i - 1], &corners[i + 1]);
            let way = self.distance(a, &corners[i]) + self.distance(&corners[i], b);
            if self.distance(a, b) <= way && self.is_joined(a, b) {
                corners.remove(i);
            } else {
                i += 1;
            }
        }
    }

    /// Replaces each corner by two, as far down its sides as the line between them is certified.
    fn cut(&self, corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut found = vec![corners[0]];
        for triple in corners.windows(3) {
            let before = found[found.len() - 1];
            let mut fraction = 0.5;
            let mut cut = None;
            for _ in 0..SETTINGS.halvings {
                let ends = (
                    self.between(&triple[1], &before, fraction),
                    self.between(&triple[1], &triple[2], fraction),
                );
                if let (Some(a), Some(b)) = ends
                    && self.is_joined(&a, &b)
                    && self.is_joined(&before, &a)
                    && self.is_joined(&b, &triple[2])
                {
                    cut = Some([a, b]);
                    break;
                }
                fraction /= 2.0;
            }
            match cut {
                Some(pair) => found.extend(pair),
                None => found.push(triple[1]),
            }
        }
        found.extend(corners.last().filter(|_| corners.len() > 1));
        found
    }
}

/// The posture of both, where they have the same.
fn one_posture(a: &[f64; 2], b: &[f64; 2]) -> Option<Posture> {
    match (Posture::of(a), Posture::of(b)) {
        (Some(p), Some(q)) if p != q => None,
        (Some(p), _) | (None, Some(p)) => Some(p),
        (None, None) => None,
    }
}
