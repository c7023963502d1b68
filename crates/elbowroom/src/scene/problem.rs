use std::collections::HashSet;

use thiserror::Error;

use super::{Obstacle, Place, Task};
use crate::arm::Arm;

/// Most obstacles of a scene: a map numbers them in 16 bits.
pub(super) const MOST_OBSTACLES: usize = 1 << 16;

/// Most tasks of a scene.
pub(super) const MOST_TASKS: usize = 1000;

/// Greatest coordinate of a task's tip (m).
const GREATEST_COORDINATE: f64 = 1e6;

/// Greatest angle of a task's joint (rad): beyond it angles lose the digits the checks rely on.
pub(super) const GREATEST_ANGLE: f64 = 1e4;

/// Why parts make no scene.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneProblem {
    /// More obstacles than can be numbered.
    #[error("{found} obstacles, at most {MOST_OBSTACLES} are allowed")]
    Obstacles {
        /// How many.
        found: usize,
    },
    /// More tasks than anyone plans.
    #[error("{found} tasks, at most {MOST_TASKS} are allowed")]
    Tasks {
        /// How many.
        found: usize,
    },
    /// Two obstacles with one name.
    #[error("two obstacles are called '{}'", name.escape_debug())]
    ObstacleName {
        /// The name.
        name: String,
    },
    /// Two tasks with one name, or a task without.
    #[error("two tasks are called '{}', or one has no name", name.escape_debug())]
    TaskName {
        /// The name.
        name: String,
    },
    /// A start or goal with another number of angles than the arm has joints.
    #[error("task '{}': {found} joint angles, the arm has {links} joints", task.escape_debug())]
    Joints {
        /// Whose.
        task: String,
        /// How many angles it has.
        found: usize,
        /// How many joints the arm has.
        links: usize,
    },
    /// A clearance that is none.
    #[error("task '{}': its clearance must be 0 or greater", task.escape_debug())]
    Clearance {
        /// Whose.
        task: String,
    },
    /// A start or goal that is no place.
    #[error(
        "task '{}': start and goal must be finite, tips within {GREATEST_COORDINATE:e} m, angles within {GREATEST_ANGLE:e} rad",
        task.escape_debug()
    )]
    Place {
        /// Whose.
        task: String,
    },
}

pub(super) fn first(arm: &Arm, obstacles: &[Obstacle], tasks: &[Task]) -> Option<SceneProblem> {
    if obstacles.len() > MOST_OBSTACLES {
        return Some(SceneProblem::Obstacles { found: obstacles.len() });
    }
    if tasks.len() > MOST_TASKS {
        return Some(SceneProblem::Tasks { found: tasks.len() });
    }
    let mut names = HashSet::new();
    let mut named = obstacles.iter().filter_map(|obstacle| obstacle.name.as_ref());
    if let Some(name) = named.find(|name| !names.insert(name.as_str())) {
        return Some(SceneProblem::ObstacleName { name: name.clone() });
    }
    let mut names = HashSet::new();
    if let Some(task) = tasks.iter().find(|task| task.name.is_empty() || !names.insert(task.name.as_str())) {
        return Some(SceneProblem::TaskName { name: task.name.clone() });
    }
    let links = arm.links();
    tasks.iter().find_map(|task| {
        let [start, goal] = [&task.start, &task.goal];
        for place in [start, goal] {
            match place {
                Place::Configuration(q) if q.len() != links => {
                    return Some(SceneProblem::Joints { task: task.name.clone(), found: q.len(), links });
                }
                _ => {}
            }
        }
        if !(0.0..f64::INFINITY).contains(&task.clearance) {
            return Some(SceneProblem::Clearance { task: task.name.clone() });
        }
        (!(is_place(start) && is_place(goal))).then(|| SceneProblem::Place { task: task.name.clone() })
    })
}

fn is_place(place: &Place) -> bool {
    match place {
        Place::Tip(tip) => tip.x.abs() <= GREATEST_COORDINATE && tip.y.abs() <= GREATEST_COORDINATE,
        Place::Configuration(q) => q.iter().all(|angle| angle.abs() <= GREATEST_ANGLE),
    }
}
