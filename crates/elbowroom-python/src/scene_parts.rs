//! The parts of a scene as the dataclasses of `elbowroom.scene` hold them.

use elbowroom::arm::{Arm, Joint, JointLimits, MotionLimits};
use elbowroom::geometry::{Point, Shape, ShapeError, Vector};
use elbowroom::grid::Grid;
use elbowroom::online::KnownMotion;
use elbowroom::scene::{Course, Obstacle, ObstacleMotion, Place, Sight, Task, TaskPosture, Waypoint};
use pyo3::prelude::*;

use crate::errors;

#[derive(FromPyObject)]
pub(crate) struct JointPart {
    continuous: bool,
    min: Option<f64>,
    max: Option<f64>,
    velocity: Option<f64>,
    acceleration: Option<f64>,
    jerk: Option<f64>,
}

#[derive(FromPyObject)]
pub(crate) struct ArmPart {
    links: Vec<f64>,
    joints: Vec<JointPart>,
    half_width: f64,
    base: [f64; 2],
    self_collision: bool,
}

#[derive(FromPyObject)]
pub(crate) struct GridPart {
    x: [f64; 2],
    y: [f64; 2],
    step: f64,
}

#[derive(FromPyObject)]
pub(crate) enum ObstaclePart {
    Circle { center: [f64; 2], radius: f64, name: Option<String>, motion: Option<MotionPart> },
    Segment { start: [f64; 2], end: [f64; 2], radius: f64, name: Option<String>, motion: Option<MotionPart> },
    Polygon { vertices: Vec<[f64; 2]>, name: Option<String>, motion: Option<MotionPart> },
}

#[derive(FromPyObject)]
pub(crate) struct MotionPart {
    waypoints: Option<Vec<(f64, [f64; 2])>>,
    velocity: Option<[f64; 2]>,
    start: f64,
    chases: bool,
    keep_off: f64,
    greatest_speed: Option<f64>,
    seen_from: Option<f64>,
    sensing_radius: Option<f64>,
}

/// What is known of an obstacle that moves: its course, or where it was seen.
#[derive(FromPyObject)]
pub(crate) enum KnownPart {
    Motion(MotionPart),
    Sighting { shift: [f64; 2], time: f64, greatest_speed: Option<f64> },
}

#[derive(FromPyObject)]
pub(crate) enum PlacePart {
    Configuration { q: Vec<f64> },
    Tip([f64; 2]),
}

#[derive(FromPyObject)]
pub(crate) struct TaskPart {
    start: PlacePart,
    goal: PlacePart,
    posture: String,
}

fn point([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

impl JointPart {
    fn build(&self, py: Python<'_>, key: &str) -> PyResult<Joint> {
        let limits = match (self.continuous, self.min, self.max) {
            (true, None, None) => JointLimits::Continuous,
            (false, Some(min), Some(max)) => {
                JointLimits::range(min, max).map_err(|error| errors::part(py, key, &error.to_string()))?
            }
            _ => return Err(errors::part(py, key, "either continuous=True, or min and max")),
        };
        for (name, limit) in
            [("velocity", self.velocity), ("acceleration", self.acceleration), ("jerk", self.jerk)]
        {
            if limit.is_some_and(|limit| !(limit.is_finite() && limit > 0.0)) {
                let key = format!("{key}.{name}");
                return Err(errors::part(py, &key, "must be finite and greater than 0"));
            }
        }
        let motion =
            MotionLimits { velocity: self.velocity, acceleration: self.acceleration, jerk: self.jerk };
        Ok(Joint { limits, motion })
    }
}

impl ArmPart {
    pub(crate) fn build(&self, py: Python<'_>) -> PyResult<Arm> {
        let joint = |(j, part): (usize, &JointPart)| part.build(py, &format!("arm.joints[{j}]"));
        let joints = self.joints.iter().enumerate().map(joint).collect::<PyResult<Vec<Joint>>>()?;
        Arm::new(point(self.base), self.links.clone(), self.half_width, joints, self.self_collision)
            .map_err(|error| errors::part(py, "arm", &error.to_string()))
    }
}

impl GridPart {
    pub(crate) fn build(&self, py: Python<'_>) -> PyResult<Grid> {
        Grid::new(self.x, self.y, self.step).map_err(|error| errors::part(py, "grid", &error.to_string()))
    }
}

impl ObstaclePart {
    /// The obstacle, and how it moves if it does.
    pub(crate) fn build(self, py: Python<'_>, index: usize) -> PyResult<Obstacle> {
        let (name, shape, motion) = match self {
            Self::Circle { center, radius, name, motion } => {
                (name, Shape::circle(point(center), radius), motion)
            }
            Self::Segment { start, end, radius, name, motion } => {
                (name, Shape::segment(point(start), point(end), radius), motion)
            }
            Self::Polygon { vertices, name, motion } => {
                (name, Shape::polygon(vertices.into_iter().map(point).collect()), motion)
            }
        };
        let refused =
            |error: ShapeError| errors::part(py, &format!("obstacles[{index}]"), &error.to_string());
        let shape = shape.map_err(refused)?;
        let motion = motion.map(|motion| motion.build(py, index)).transpose()?;
        Ok(Obstacle { name, shape, motion })
    }
}

impl MotionPart {
    fn build(self, py: Python<'_>, index: usize) -> PyResult<ObstacleMotion> {
        let refused = |message: &str| errors::part(py, &format!("obstacles[{index}].motion"), message);
        let vector = |[x, y]: [f64; 2]| Vector::new(x, y);
        let course = match (self.waypoints, self.velocity, self.chases) {
            (Some(points), None, false) => Course::Waypoints(
                points.into_iter().map(|(time, shift)| Waypoint { time, shift: vector(shift) }).collect(),
            ),
            (None, Some(velocity), false) => Course::Drift { start: self.start, velocity: vector(velocity) },
            (None, None, true) => Course::Chase { keep_off: self.keep_off },
            _ => return Err(refused("one of waypoints, velocity, chases")),
        };
        let sight = match (self.seen_from, self.sensing_radius) {
            (None, None) => Sight::Always,
            (Some(time), None) => Sight::From(time),
            (None, Some(radius)) => Sight::Within(radius),
            (Some(_), Some(_)) => return Err(refused("seen_from or sensing_radius, not both")),
        };
        if matches!(course, Course::Chase { .. }) && self.greatest_speed.is_none() {
            return Err(refused("greatest_speed is needed beside chases"));
        }
        ObstacleMotion::new(course, sight, self.greatest_speed).map_err(|error| refused(&error.to_string()))
    }
}

impl KnownPart {
    /// The obstacle that the scene declares to move as `declared`, as it is known.
    pub(crate) fn build(
        self,
        py: Python<'_>,
        index: usize,
        declared: &ObstacleMotion,
    ) -> PyResult<KnownMotion> {
        let refused = |message: &str| errors::setting(py, "known", &format!("known[{index}]: {message}"));
        let motion = match self {
            Self::Motion(motion) if motion.chases => {
                Err(refused("nobody knows the course of what chases; a Sighting says where it was seen"))
            }
            Self::Motion(motion) => motion.build(py, index),
            Self::Sighting { shift: [x, y], time, greatest_speed } => {
                let course = Course::Unknown { seen: time, shift: Vector::new(x, y) };
                let speed = greatest_speed.unwrap_or_else(|| declared.greatest_speed());
                ObstacleMotion::new(course, Sight::Always, Some(speed))
                    .map_err(|error| refused(&error.to_string()))
            }
        };
        Ok(KnownMotion { obstacle: index, motion: motion? })
    }
}

impl PlacePart {
    fn build(&self) -> Place {
        match self {
            Self::Configuration { q } => Place::Configuration(q.clone().into()),
            Self::Tip(tip) => Place::Tip(point(*tip)),
        }
    }
}

impl TaskPart {
    pub(crate) fn build(&self, py: Python<'_>, name: String) -> PyResult<Task> {
        let posture = match self.posture.as_str() {
            "up" => TaskPosture::Up,
            "down" => TaskPosture::Down,
            "any" => TaskPosture::Any,
            "keep" => TaskPosture::Keep,
            other => {
                let message = format!("'{other}'; up, down, any or keep");
                return Err(errors::part(py, &format!("tasks.{name}.posture"), &message));
            }
        };
        Ok(Task { start: self.start.build(), goal: self.goal.build(), posture, name })
    }
}
