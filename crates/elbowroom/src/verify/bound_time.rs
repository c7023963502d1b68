//! How soon a motion of two joints can be where it is to be, past all that is in the way.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

use super::bound::{BoundError, Open, OpenJoints, Reachability, SUM_ROUNDING, cheapest, proved_open};
use super::progress::Progress;
use crate::arm::{Joint, JointLimits};
use crate::geometry::Vector;
use crate::mesh::Measure;
use crate::scene::TwoLinkScene;
use crate::trajectory::{SpeedLimits, least_time_of_start};

/// Ways into cells that are looked at before the search ends with what is proved by then.
const MOST_WAYS: usize = 20_000;

/// Ways between two questions whether to keep going.
const WAYS_PER_LOOK: usize = 512;

/// A lower bound of the duration (s) of every motion from rest at any of the starts to rest at any of the goals under `limits`, or the
/// proof that there is none.
///
/// The greater of two bounds: that of the way as a whole, both joints at once, and one joint by joint. A motion passes cells in some order,
/// through the sides between them, so that each joint visits the intervals that these sides span, in this order, whatever the other does.
/// The bound is the least, over all orders of cells, of the time of the slower joint.
///
/// # Errors
/// [`BoundError`]
pub fn bound_over_time(
    scene: TwoLinkScene<'_>,
    claim: &OpenJoints<'_>,
    limits: &[SpeedLimits],
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<Reachability, BoundError> {
    let Some(open) = proved_open(scene, claim, keep_going)? else { return Ok(Reachability::Parted) };
    let speeds = [0, 1].map(|j| 1.0 / limits[j].velocity);
    let found = cheapest(claim.mesh, &open, Measure::Greatest(speeds), keep_going)?;
    let Reachability::AtLeast { cost, path } = found else { return Ok(found) };
    let by_cells = by_cells(scene.arm().joints(), claim, &open, limits, keep_going)?;
    let cost = coupled(cost, limits).max(by_cells) * (1.0 - SUM_ROUNDING);
    Ok(Reachability::AtLeast { cost, path })
}

/// The least time (s) of a motion from rest to rest whose way takes `way` (s) with the joints at their greatest velocities.
///
/// # Proof
/// Let *r* be the fastest start of a joint, as a share of its velocity limit. In a motion of duration *T* no joint is faster than
/// *r*(*t*), nor, the motion played backwards, than *r*(*T* - *t*). So `way`, the integral of the greater share of both joints, is at most
/// twice the integral of the greater *r* over *T* / 2, and that is at most the start of a joint that has the greater acceleration
/// and the greater jerk of both.
fn coupled(way: f64, limits: &[SpeedLimits]) -> f64 {
    let bounded = || limits.iter().filter(|limits| limits.velocity.is_finite());
    let greatest = |rate: fn(&SpeedLimits) -> f64| bounded().map(rate).fold(0.0, f64::max);
    let start = SpeedLimits {
        velocity: 1.0,
        acceleration: greatest(|limits| limits.acceleration / limits.velocity),
        jerk: greatest(|limits| limits.jerk / limits.velocity),
    };
    2.0 * least_time_of_start(way / 2.0, &start)
}

/// A way into a cell.
#[derive(Clone)]
struct Way {
    cell: usize,
    /// How the cell's places are moved to get to those of the start's plane: whole revolutions.
    back: Vector,
    joints: [Progress; 2],
}

impl Way {
    /// Whether what this way asks of the joints is done by whoever comes by `other`, and all that may follow is the same.
    fn is_implied_by(&self, other: &Self) -> bool {
        let apart = self.back + -other.back;
        apart.x.abs().max(apart.y.abs()) < 1.0
            && (0..2).all(|j| self.joints[j].is_implied_by(&other.joints[j]))
    }
}

/// A way that goes on, or where it has come to a goal, none; the quickest comes first, then the eldest.
struct Waiting {
    time: f64,
    number: usize,
    way: Option<Way>,
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then(other.number.cmp(&self.number))
    }
}

/// The least time (s), over all orders of cells from a start to a goal, of the slower joint; less where the search is given up.
///
/// What is known of a way holds for every way that goes on from it, so that the least time of those that wait is proved at any moment.
/// A way into a cell is left where another that is known there asks no more of either joint: whoever goes on from the one has done
/// what the other asks.
fn by_cells(
    joints: &[Joint; 2],
    claim: &OpenJoints<'_>,
    open: &Open,
    limits: &[SpeedLimits],
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<f64, BoundError> {
    let mesh = claim.mesh;
    let to_goal = |ways: &[Progress; 2]| {
        let goals = claim.goals.iter().map(|goal| {
            let of_joint = |j: usize| least_time_to_image(&ways[j], goal[j], &joints[j], &limits[j]);
            of_joint(0).max(of_joint(1))
        });
        goals.fold(f64::INFINITY, f64::min)
    };
    let mut known: Vec<Vec<Way>> = vec![Vec::new(); mesh.len()];
    let mut waiting = BinaryHeap::new();
    let mut number = 0;
    let mut add = |waiting: &mut BinaryHeap<Waiting>, time: f64, way: Option<Way>| {
        number += 1;
        waiting.push(Waiting { time, number, way });
    };
    for start in &open.starts {
        let joints = [start.point.x, start.point.y].map(Progress::new);
        let way = Way { cell: start.cell, back: Vector::default(), joints };
        known[way.cell].push(way.clone());
        let time = to_goal(&way.joints);
        add(&mut waiting, time, Some(way));
    }
    let mut looked_at = 0_usize;
    while let Some(Waiting { time, way, .. }) = waiting.pop() {
        let Some(way) = way else { return Ok(time) };
        if looked_at.is_multiple_of(WAYS_PER_LOOK) && !keep_going() {
            return Err(BoundError::Stopped);
        }
        if looked_at >= MOST_WAYS {
            return Ok(time);
        }
        looked_at += 1;
        for goal in open.goals.iter().filter(|goal| goal.cell == way.cell) {
            let at = goal.point + way.back;
            let of_joint = |j: usize, at: f64| way.joints[j].least_time(at, &limits[j]);
            add(&mut waiting, time.max(of_joint(0, at.x)).max(of_joint(1, at.y)), None);
        }
        let sides = mesh.sides(way.cell);
        for (i, side) in sides.iter().enumerate() {
            let Some(across) = side.across else { continue };
            let (a, b) = (side.from + way.back, sides[(i + 1) % sides.len()].from + way.back);
            let spans = [[a.x.min(b.x), a.x.max(b.x)], [a.y.min(b.y), a.y.max(b.y)]];
            let joints = [0, 1].map(|j| way.joints[j].through(spans[j], &limits[j]));
            let next = Way { cell: across.cell, back: way.back + -across.shift, joints };
            if known[next.cell].iter().any(|other| other.is_implied_by(&next)) {
                continue;
            }
            known[next.cell].push(next.clone());
            let time = time.max(to_goal(&next.joints));
            add(&mut waiting, time, Some(next));
        }
    }
    // A goal that is reached has a way; one lost in rounding proves nothing.
    Ok(0.0)
}

/// The least time (s) in which one joint gets on to rest at `goal` (rad), whole revolutions aside where it is continuous.
fn least_time_to_image(way: &Progress, goal: f64, joint: &Joint, limits: &SpeedLimits) -> f64 {
    match joint.limits {
        JointLimits::Range { .. } => way.least_time(goal, limits),
        JointLimits::Continuous => {
            // Farther ones on either side take longer.
            let below = goal + TAU * ((way.at() - goal) / TAU).floor();
            way.least_time(below, limits).min(way.least_time(below + TAU, limits))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_says_nothing_of_one_that_came_to_the_cell_in_another_turn() {
        let way = |turns: f64| Way {
            cell: 0,
            back: Vector::new(turns * TAU, 0.0),
            joints: [Progress::new(0.0), Progress::new(0.0)],
        };
        assert!(way(1.0).is_implied_by(&way(1.0)));
        assert!(!way(0.0).is_implied_by(&way(1.0)) && !way(0.0).is_implied_by(&way(-1.0)));
    }

    #[test]
    fn both_joints_at_once_take_the_start_of_the_quicker_one() {
        let limits = |acceleration: f64, jerk: f64| SpeedLimits { velocity: 2.0, acceleration, jerk };
        let quickest = SpeedLimits { velocity: 1.0, acceleration: 4.0, jerk: 10.0 };
        let time = coupled(3.0, &[limits(8.0, 15.0), limits(6.0, 20.0)]);
        assert!((time - 2.0 * least_time_of_start(1.5, &quickest)).abs() < 1e-12);
        // What has no velocity limit takes no part in the length of the way.
        let free = SpeedLimits { velocity: f64::INFINITY, ..limits(1e9, 1e9) };
        assert!(
            (coupled(3.0, &[limits(8.0, 20.0), free]) - 2.0 * least_time_of_start(1.5, &quickest)).abs()
                < 1e-12
        );
    }
}
