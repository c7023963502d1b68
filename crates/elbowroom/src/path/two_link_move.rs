//! Straight moves of two links: a bisection for each link and obstacle, one after the other.

use super::asked::Asked;
use super::clearance::CERTIFIED_CLEARANCE;
use crate::arm::{Arm, lerp_pair};
use crate::geometry::{Point, Segment, Vector};
use crate::scene::Obstacle;

/// Whether both of the arm's links stay clear of all obstacles on the straight move.
pub(super) fn is_clear(
    arm: &Arm,
    lengths: [f64; 2],
    obstacles: &[Obstacle],
    [from, to]: [&[f64; 2]; 2],
    asked: Asked,
) -> bool {
    let pose = Pose { base: arm.base(), lengths };
    let (starts, ends) = (pose.links(from), pose.links(to));
    let bounds = motion_bounds_of_two(lengths, from, to);
    obstacles.iter().all(|obstacle| {
        obstacle.motion.is_none()
            && bounds.iter().enumerate().all(|(link, &bound)| {
                let mut sweep = Sweep {
                    pose,
                    link,
                    obstacle,
                    half_width: arm.half_width(),
                    kept: asked.kept,
                    looks_left: asked.most_looks,
                };
                let (c0, c1) = (sweep.clearance(starts[link]), sweep.clearance(ends[link]));
                c0 > 0.0 && c1 > 0.0 && sweep.between_is_clear((from, c0), (to, c1), bound)
            })
    })
}

/// [`motion_bounds`](super::motion_bounds) of two links: without a list, for it is asked of every edge of a roadmap.
pub(crate) fn motion_bounds_of_two(lengths: [f64; 2], from: &[f64; 2], to: &[f64; 2]) -> [f64; 2] {
    let [turn1, turn2] = [to[0] - from[0], to[1] - from[1]];
    let first = lengths[0] * turn1.abs();
    [first, first + lengths[1] * (turn1 + turn2).abs()]
}

/// What tells where the links are.
#[derive(Clone, Copy)]
struct Pose {
    base: Point,
    lengths: [f64; 2],
}

impl Pose {
    fn links(&self, q: &[f64; 2]) -> [Segment; 2] {
        let elbow = self.elbow(q);
        [Segment::new(self.base, elbow), self.second(q, elbow)]
    }

    fn link(&self, link: usize, q: &[f64; 2]) -> Segment {
        let elbow = self.elbow(q);
        if link == 0 { Segment::new(self.base, elbow) } else { self.second(q, elbow) }
    }

    fn elbow(&self, q: &[f64; 2]) -> Point {
        self.base + Vector::polar(self.lengths[0], q[0])
    }

    fn second(&self, q: &[f64; 2], elbow: Point) -> Segment {
        Segment::new(elbow, elbow + Vector::polar(self.lengths[1], q[0] + q[1]))
    }
}

/// One link against one obstacle.
struct Sweep<'a> {
    pose: Pose,
    link: usize,
    obstacle: &'a Obstacle,
    half_width: f64,
    /// Clearance that has to be left (m).
    kept: f64,
    looks_left: u32,
}

impl Sweep<'_> {
    /// Clearance beyond what is to be kept (m).
    fn clearance(&self, link: Segment) -> f64 {
        self.obstacle.distance_to_segment(link) - self.half_width - self.kept
    }

    /// `bound` is how far a point of the link moves between the two configurations; it halves on every level, so that the
    /// recursion ends when it falls below the clearances or one of them is gone.
    fn between_is_clear(&mut self, from: (&[f64; 2], f64), to: (&[f64; 2], f64), bound: f64) -> bool {
        if from.1 + to.1 > bound {
            return true;
        }
        if bound <= CERTIFIED_CLEARANCE || self.looks_left == 0 {
            return false;
        }
        self.looks_left -= 1;
        let middle = lerp_pair(from.0, to.0, 0.5);
        let clearance = self.clearance(self.pose.link(self.link, &middle));
        clearance > 0.0
            && self.between_is_clear(from, (&middle, clearance), bound / 2.0)
            && self.between_is_clear((&middle, clearance), to, bound / 2.0)
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::arm::Joint;
    use crate::path::motion_bounds;
    use crate::random::within;

    #[test]
    fn bounds_of_two_links_are_those_of_any_number() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        for _ in 0..10_000 {
            let lengths = [within(&mut rng, 0.01, 2.0), within(&mut rng, 0.01, 2.0)];
            let [from, to] = [(); 2].map(|()| [(); 2].map(|()| within(&mut rng, -7.0, 7.0)));
            let arm =
                Arm::new(Point::new(0.0, 0.0), lengths.to_vec(), 0.0, vec![Joint::CONTINUOUS; 2], false);
            let expected = motion_bounds(&arm.unwrap(), &from, &to);
            assert_eq!(expected[..], motion_bounds_of_two(lengths, &from, &to));
        }
    }
}
