use crate::arm::Configuration;
use crate::geometry::Point;

/// Where a task begins or ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Place {
    /// The tip stands here (m); which configuration does not matter.
    Tip(Point),
    /// The joints stand here, one position each, base first (rad).
    Configuration(Configuration),
}

/// In which posture a task may be carried out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TaskPosture {
    /// The goal is reached elbow-up.
    Up,
    /// The goal is reached elbow-down.
    Down,
    /// The goal may be reached in either posture.
    #[default]
    Any,
    /// The whole motion keeps the posture it starts in.
    Keep,
}

/// A motion that is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// Its name in the scene.
    pub name: String,
    /// Where the arm is.
    pub start: Place,
    /// Where it shall be.
    pub goal: Place,
    /// Which postures will do.
    pub posture: TaskPosture,
    /// The clearance that every motion of it has to keep (m): 0 if only contact is forbidden.
    pub clearance: f64,
}
