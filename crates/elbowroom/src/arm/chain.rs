use super::{Joint, PlanarArm, TwoLinkArm};
use crate::geometry::{Point, Segment, Vector};

/// A planar arm: links end to end on a fixed base, capsules of one half width, a joint at the start of each.
pub trait Arm: Sync {
    /// Where the first joint turns (m).
    fn base(&self) -> Point;

    /// Length of each link (m), base first.
    fn lengths(&self) -> &[f64];

    /// Radius of the capsules around the links' centre lines (m).
    fn half_width(&self) -> f64;

    /// The joints, base first: as many as links.
    fn joints(&self) -> &[Joint];

    /// Whether links that are not neighbours must keep clear of each other.
    fn self_collision(&self) -> bool;

    /// Where the links end at `q` (rad), in order (m): the last is the tip. Forward kinematics.
    fn link_ends(&self, q: &[f64]) -> impl Iterator<Item = Point> {
        let links = self.lengths().iter().zip(q);
        links.scan((self.base(), 0.0), |(end, direction), (&length, angle)| {
            *direction += angle;
            *end = *end + Vector::polar(length, *direction);
            Some(*end)
        })
    }

    /// Where the end of the last link is at `q` (rad) (m).
    fn tip_at(&self, q: &[f64]) -> Point {
        self.link_ends(q).last().unwrap_or(self.base())
    }

    /// Centre lines of the links at `q` (rad), base first.
    fn link_segments(&self, q: &[f64]) -> impl Iterator<Item = Segment> {
        self.link_ends(q).scan(self.base(), |start, end| {
            let segment = Segment::new(*start, end);
            *start = end;
            Some(segment)
        })
    }

    /// The same arm with closed forms, if it has two links.
    fn two_link(&self) -> Option<TwoLinkArm>;

    /// The same arm as one of any number of links.
    fn planar(&self) -> PlanarArm;

    /// Whether every joint may stand where `q` (rad) puts it.
    fn allows(&self, q: &[f64]) -> bool {
        self.joints().iter().zip(q).all(|(joint, &angle)| joint.limits.contains(angle))
    }
}
