//! A judge of motions of arms with any number of links that shares no code with the crate: textbook kinematics, another
//! library's distances, and many looks.

use elbowroom::arm::{Arm, JointLimits};
use elbowroom::planning::Plan;
use elbowroom::scene::{Place, Scene, Task};

use crate::distance::distance;

type P = [f64; 2];

/// Looks at each piece of a motion.
const LOOKS: usize = 60;

/// Where base, joints and tip are at `q` (m).
fn skeleton(arm: &Arm, q: &[f64]) -> Vec<P> {
    let mut points = vec![[arm.base().x, arm.base().y]];
    for (k, length) in arm.lengths().iter().enumerate() {
        let direction: f64 = q[..=k].iter().sum();
        let [x, y] = points[k];
        points.push([x + length * direction.cos(), y + length * direction.sin()]);
    }
    points
}

/// Distance between two segments: of the ends, unless they cross.
fn between(a: [P; 2], b: [P; 2]) -> f64 {
    let to = |p: P, [s, e]: [P; 2]| {
        let (dx, dy) = (e[0] - s[0], e[1] - s[1]);
        let t = (((p[0] - s[0]) * dx + (p[1] - s[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        (p[0] - s[0] - t * dx).hypot(p[1] - s[1] - t * dy)
    };
    let side = |[s, e]: [P; 2], p: P| (e[0] - s[0]) * (p[1] - s[1]) - (e[1] - s[1]) * (p[0] - s[0]);
    let crosses = side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0;
    if crosses { 0.0 } else { to(a[0], b).min(to(a[1], b)).min(to(b[0], a)).min(to(b[1], a)) }
}

/// Least clearance at `q` of links from obstacles and from each other (m).
pub(crate) fn clearance(scene: &Scene, q: &[f64]) -> f64 {
    let points = skeleton(scene.arm(), q);
    let links: Vec<[P; 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let width = scene.arm().half_width();
    let mut least = f64::INFINITY;
    for (i, link) in links.iter().enumerate() {
        for obstacle in scene.obstacles() {
            least = least.min(distance(obstacle, link[0], link[1]) - width);
        }
        if scene.arm().self_collision() {
            for before in links.iter().take(i.saturating_sub(1)) {
                least = least.min(between(*before, *link) - 2.0 * width);
            }
        }
    }
    least
}

/// Whether the tip or the joints are where `place` says at `q`; a continuous joint may have been counted on by turns.
fn is_at(arm: &Arm, place: &Place, q: &[f64]) -> bool {
    match place {
        Place::Tip(tip) => {
            let [x, y] = *skeleton(arm, q).last().unwrap();
            (x - tip.x).hypot(y - tip.y) < 1e-9
        }
        Place::Configuration(asked) => {
            q.iter().zip(asked.iter()).zip(arm.joints()).all(|((q, asked), joint)| {
                let off = match joint.limits {
                    JointLimits::Continuous => 2.0 * ((q - asked) / 2.0).sin(),
                    JointLimits::Range { .. } => q - asked,
                };
                off.abs() < 1e-9
            })
        }
    }
}

/// All that is promised of a plan, looked at from outside.
pub(crate) fn assert_true(scene: &Scene, task: &Task, plan: &Plan) {
    let motion = plan.trajectory().motion();
    assert!(plan.trajectory().verdict().is_safe());
    let (first, last) = (motion.at(motion.start()), motion.at(motion.end()));
    assert!(is_at(scene.arm(), &task.start, &first.position), "{:?} is not {:?}", first.position, task.start);
    assert!(is_at(scene.arm(), &task.goal, &last.position), "{:?} is not {:?}", last.position, task.goal);
    for end in [&first, &last] {
        assert!(end.velocity.iter().chain(&end.acceleration).all(|rate| rate.abs() < 1e-6));
    }
    let mut before: Option<Vec<f64>> = None;
    for piece in motion.pieces() {
        for look in 0..=LOOKS {
            let s = piece.duration * look as f64 / LOOKS as f64;
            let at = |c: &[f64; 6]| c.iter().rev().fold(0.0, |sum, c| sum * s + c);
            let q: Vec<f64> = piece.coefficients.iter().map(at).collect();
            let clear = clearance(scene, &q);
            assert!(clear > 0.0, "clearance {clear} m at {q:?}");
            for (angle, joint) in q.iter().zip(scene.arm().joints()) {
                if let JointLimits::Range { min, max } = joint.limits {
                    assert!((min - 1e-9..=max + 1e-9).contains(angle), "{q:?}");
                }
            }
            if look == 0
                && let Some(before) = &before
            {
                assert!(before.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9), "{before:?}, {q:?}");
            }
            before = Some(q);
        }
    }
    for pair in plan.joint_path().0.windows(2) {
        for look in 0..=LOOKS {
            let share = look as f64 / LOOKS as f64;
            let q: Vec<f64> = pair[0].iter().zip(pair[1].iter()).map(|(a, b)| a + (b - a) * share).collect();
            assert!(clearance(scene, &q) > 0.0, "the path touches at {q:?}");
        }
    }
    let Some(effort) = plan.effort() else { return };
    assert!(effort.convergence.windows(2).all(|pair| pair[1].0 >= pair[0].0 && pair[1].1 < pair[0].1));
    assert!(effort.convergence.last().is_none_or(|(made, _)| *made <= effort.evaluations));
}
