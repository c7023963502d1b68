//! The parts of which tests build their scenes. A test that does not use them all says
//! `#[path = "worlds/build.rs"] #[expect(dead_code, reason = "shared between tests")] mod build;`

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

use std::path::Path;

use elbowroom::arm::{Arm, Joint, JointLimits, MotionLimits};
use elbowroom::geometry::{Point, Shape};
use elbowroom::grid::Grid;
use elbowroom::scene::{Obstacle, Place, Scene, Task, TaskPosture, parse};

/// Centres of the circles of 5 cm among which the paper's arm stands (m).
pub(crate) const CIRCLES: [[f64; 2]; 5] =
    [[0.22, 0.22], [-0.08, 0.4], [-0.38, 0.18], [-0.2, -0.42], [0.38, -0.14]];

/// Stops at `min` and `max` (rad).
pub(crate) fn stops(min: f64, max: f64) -> JointLimits {
    JointLimits::range(min, max).unwrap()
}

/// A joint that may be as fast as it likes.
pub(crate) fn joint(limits: JointLimits) -> Joint {
    Joint { limits, motion: MotionLimits::default() }
}

/// On the origin, without width, all joints continuous; its links may cross.
pub(crate) fn arm(lengths: &[f64]) -> Arm {
    arm_of(lengths, 0.0, &vec![Joint::CONTINUOUS; lengths.len()])
}

/// On the origin; its links may cross.
pub(crate) fn arm_of(lengths: &[f64], half_width: f64, joints: &[Joint]) -> Arm {
    Arm::new(Point::new(0.0, 0.0), lengths.to_vec(), half_width, joints.to_vec(), false).unwrap()
}

pub(crate) fn circle(x: f64, y: f64, radius: f64) -> Obstacle {
    Obstacle::still(Shape::circle(Point::new(x, y), radius).unwrap())
}

pub(crate) fn polygon(vertices: &[[f64; 2]]) -> Obstacle {
    let vertices = vertices.iter().map(|&[x, y]| Point::new(x, y)).collect();
    Obstacle::still(Shape::polygon(vertices).unwrap())
}

/// All that is within `radius` (m) of a polygon.
pub(crate) fn rounded(vertices: &[[f64; 2]], radius: f64) -> Obstacle {
    let vertices = vertices.iter().map(|&[x, y]| Point::new(x, y)).collect();
    Obstacle::still(Shape::rounded_polygon(vertices, radius).unwrap())
}

/// From one end to the other, as thick as `radius` (m) says.
pub(crate) fn segment([from, to]: [[f64; 2]; 2], radius: f64) -> Obstacle {
    let [from, to] = [from, to].map(|[x, y]| Point::new(x, y));
    Obstacle::still(Shape::segment(from, to, radius).unwrap())
}

/// From `-half` to `half` both ways (m).
pub(crate) fn grid(half: f64, step: f64) -> Grid {
    Grid::new([-half, half], [-half, half], step).unwrap()
}

/// Without tasks, over a coarse grid of 4 m by 4 m.
pub(crate) fn scene(arm: Arm, obstacles: Vec<Obstacle>) -> Scene {
    Scene::new(arm, grid(2.0, 0.5), obstacles, Vec::new()).unwrap()
}

pub(crate) fn tip(x: f64, y: f64) -> Place {
    Place::Tip(Point::new(x, y))
}

pub(crate) fn task(name: &str, start: Place, goal: Place, posture: TaskPosture) -> Task {
    Task { name: name.to_owned(), start, goal, posture, clearance: 0.0 }
}

/// The paper's arm with its tasks `first` and `second`, among circles of 5 cm; joint 2 within `bend` (rad).
pub(crate) fn paper(
    first: JointLimits,
    bend: f64,
    motion: MotionLimits,
    centers: &[[f64; 2]],
    step: f64,
) -> Scene {
    let joints = [first, stops(-bend, bend)].map(|limits| Joint { limits, motion });
    let circles = centers.iter().map(|&[x, y]| circle(x, y, 0.05)).collect();
    let tasks = vec![
        task("first", tip(0.4, 0.1), tip(-0.45, -0.15), TaskPosture::Any),
        task("second", tip(0.3, -0.3), tip(0.15, 0.45), TaskPosture::Any),
    ];
    Scene::new(arm_of(&[0.25, 0.25], 0.0, &joints), grid(0.5, step), circles, tasks).unwrap()
}

/// A scene that comes with the package.
pub(crate) fn example(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../python/elbowroom/scenes");
    let text = std::fs::read_to_string(folder.join(format!("{name}.yaml"))).unwrap();
    parse(&text, name).unwrap().scene
}

/// The scene with one task changed.
pub(crate) fn with_task(scene: &Scene, task: usize, change: impl FnOnce(&mut Task)) -> Scene {
    let mut tasks = scene.tasks().to_vec();
    change(&mut tasks[task]);
    scene.with_tasks(tasks).unwrap()
}

/// The scene with one obstacle more.
pub(crate) fn with_obstacle(scene: &Scene, obstacle: Obstacle) -> Scene {
    scene.with_obstacles([scene.obstacles(), &[obstacle]].concat()).unwrap()
}
