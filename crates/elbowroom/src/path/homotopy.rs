use super::{JointPath, straight_move_is_free};
use crate::arm::{Configuration, joint_distance, lerp};
use crate::scene::Scene;

/// Steps into which each of two paths that are compared is cut.
const STEPS: usize = 32;

/// Ends that are nearer than this are the same (rad).
const SAME_END: f64 = 1e-6;

/// Whether one path can be pulled over to the other without touching anything, as far as straight moves between them show: from end to
/// end both can be gone along so that the straight move from one to the other is free all the time. Paths with other ends, or other turns of
/// a joint between them, are never the same.
///
/// Where this is not so they may belong to one homotopy class all the same; and what is small beside the steps may be jumped over, so that
/// this is good for choosing between paths and no proof.
///
/// # Reference
/// Visibility deformation: Jaillet and Siméon, *Path deformation roadmaps: compact graphs with useful cycles for motion planning*,
/// IJRR 2008; both paths at speeds of their own, as in the Fréchet distance.
pub(crate) fn can_be_deformed(scene: &Scene, one: &JointPath, other: &JointPath) -> bool {
    let [one, other] = [one, other].map(steps_along);
    let ([first, .., last], [other_first, .., other_last]) = (&one[..], &other[..]) else { return false };
    if joint_distance(first, other_first) > SAME_END || joint_distance(last, other_last) > SAME_END {
        return false;
    }
    // The pairs that can be come to from both starts: both go on, or one alone.
    let mut known = [[false; STEPS + 1]; STEPS + 1];
    let mut waiting = vec![(0, 0)];
    while let Some((i, j)) = waiting.pop() {
        if (i, j) == (STEPS, STEPS) {
            return true;
        }
        // The last is looked at first: as long as both can go on, they do.
        for (i, j) in [(i, j + 1), (i + 1, j), (i + 1, j + 1)] {
            if i <= STEPS
                && j <= STEPS
                && !std::mem::replace(&mut known[i][j], true)
                && straight_move_is_free(scene, &one[i], &other[j])
            {
                waiting.push((i, j));
            }
        }
    }
    false
}

/// Places along `path` from its start to its end, evenly far apart in joint travel; none of a path without places.
fn steps_along(path: &JointPath) -> Vec<Configuration> {
    let Some(first) = path.0.first() else { return Vec::new() };
    let step = path.length() / STEPS as f64;
    let mut steps = vec![first.clone()];
    let mut gone = 0.0;
    for pair in path.0.windows(2) {
        let length = joint_distance(&pair[0], &pair[1]);
        while length > 0.0 && steps.len() < STEPS && step * steps.len() as f64 <= gone + length {
            steps.push(lerp(&pair[0], &pair[1], (step * steps.len() as f64 - gone) / length));
        }
        gone += length;
    }
    steps.resize(STEPS, path.0[path.0.len() - 1].clone());
    steps.push(path.0[path.0.len() - 1].clone());
    steps
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::arm::{Arm, Joint};
    use crate::geometry::{Point, Shape};
    use crate::grid::Grid;
    use crate::random::within;
    use crate::scene::Obstacle;

    /// An arm of two links with a disc in its way, which a stretched arm touches at about 90 degrees and a bent one passes.
    fn scene(obstacles: Vec<Obstacle>) -> Scene {
        let arm = Arm::new(Point::new(0.0, 0.0), vec![0.5, 0.5], 0.0, vec![Joint::CONTINUOUS; 2], false);
        let grid = Grid::new([-1.0, 1.0], [-1.0, 1.0], 0.05).unwrap();
        Scene::new(arm.unwrap(), grid, obstacles, Vec::new()).unwrap()
    }

    fn disc() -> Obstacle {
        Obstacle::still(Shape::circle(Point::new(0.0, 0.8), 0.2).unwrap())
    }

    fn path(places: &[[f64; 2]]) -> JointPath {
        JointPath(places.iter().map(|q| q.iter().copied().collect()).collect())
    }

    /// The places of `path`, jittered, and more between them.
    fn jittered(rng: &mut ChaCha8Rng, places: &[[f64; 2]], by: f64) -> JointPath {
        let mut found = vec![places[0]];
        for pair in places.windows(2) {
            for share in [0.3, 0.6, 1.0] {
                let at = |j: usize| pair[0][j] + share * (pair[1][j] - pair[0][j]);
                found.push([at(0) + within(rng, -by, by), at(1) + within(rng, -by, by)]);
            }
        }
        let last = found.len() - 1;
        found[last] = places[places.len() - 1];
        path(&found)
    }

    #[test]
    fn what_bends_to_one_side_is_not_pulled_over_to_the_other() {
        let (scene, empty) = (scene(vec![disc()]), scene(Vec::new()));
        let mut rng = ChaCha8Rng::seed_from_u64(9);
        // Past the disc bent far to the left, or to the right.
        let side = |sign: f64| [[0.3, 0.0], [0.3, sign * 2.4], [PI - 0.3, sign * 2.4], [PI - 0.3, 0.0]];
        for _ in 0..200 {
            let [left, again, right] = [1.0, 1.0, -1.0].map(|sign| jittered(&mut rng, &side(sign), 0.1));
            assert!(can_be_deformed(&scene, &left, &again) && can_be_deformed(&scene, &again, &left));
            assert!(!can_be_deformed(&scene, &left, &right) && !can_be_deformed(&scene, &right, &left));
            assert!(can_be_deformed(&empty, &left, &right));
        }
    }

    #[test]
    fn other_ends_and_other_turns_are_another_path() {
        let scene = scene(Vec::new());
        assert_eq!(steps_along(&path(&[[0.0, 0.0], [1.0, 0.0], [1.0, 3.0]]))[8].to_vec(), [1.0, 0.0]);
        let one = path(&[[0.0, 0.0], [1.0, 1.0]]);
        assert!(can_be_deformed(&scene, &one, &one));
        assert!(!can_be_deformed(&scene, &one, &path(&[[0.0, 0.0], [1.0, 1.1]])));
        assert!(!can_be_deformed(&scene, &one, &path(&[[0.0, 0.0], [1.0 - TAU, 1.0]])));
        assert!(!can_be_deformed(&scene, &one, &path(&[])));
        let standing = path(&[[0.5, 0.5]]);
        assert!(can_be_deformed(&scene, &standing, &path(&[[0.5, 0.5], [0.5, 0.5]])));
    }
}
