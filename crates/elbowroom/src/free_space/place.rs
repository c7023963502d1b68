use std::fmt;

use thiserror::Error;

use super::FreeSpace;
use super::state::touches;
use crate::arm::{Configuration, InverseError, JointLimits, Posture};
use crate::geometry::Point;
use crate::scene::{Place, Scene};

/// What forbids a configuration, or a place of the tip in one posture.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Reason {
    /// The links cannot put the tip there.
    #[error(
        "the tip would be {distance:.6} m from the base, the arm reaches {nearest:.6} m to {farthest:.6} m"
    )]
    OutOfReach {
        /// From base to tip (m).
        distance: f64,
        /// Nearest to the base that the links allow (m).
        nearest: f64,
        /// Farthest from the base (m).
        farthest: f64,
    },
    /// A joint would have to stand outside its limits.
    #[error("joint {joint} would stand at {angle:.6} rad, {}", in_words(limits))]
    JointLimit {
        /// 1 for the joint at the base.
        joint: usize,
        /// Where it would stand (rad).
        angle: f64,
        /// Where it may stand.
        limits: JointLimits,
    },
    /// A link would touch an obstacle.
    #[error("link {link} would be {depth:.6} m deep in obstacle {}", title(*obstacle, name.as_deref()))]
    Collision {
        /// 1 for the link at the base.
        link: usize,
        /// The obstacle's place in the scene, from 0.
        obstacle: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// How deep the link enters it, its own half width included (m): of all contacts the deepest.
        depth: f64,
    },
}

/// A place where the arm cannot stand.
#[derive(Debug, Clone, PartialEq)]
pub struct NotFree {
    /// The place asked for.
    pub place: Place,
    /// What forbids it: once for each posture of a tip place, once for a configuration.
    pub reasons: Vec<(Option<Posture>, Reason)>,
    /// The free grid point nearest to where the tip would be (m), if any point is free.
    pub nearest_free: Option<Point>,
}

impl std::error::Error for NotFree {}

impl fmt::Display for NotFree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place {
            Place::Tip(tip) => write!(f, "({} m, {} m) is not free", tip.x, tip.y)?,
            Place::Configuration(Configuration([q1, q2])) => {
                write!(f, "q = [{q1:.6} rad, {q2:.6} rad] is not free")?;
            }
        }
        let one_for_all = self.reasons.windows(2).all(|pair| pair[0].1 == pair[1].1);
        for (i, (posture, reason)) in self.reasons.iter().enumerate().take(if one_for_all { 1 } else { 2 }) {
            write!(f, "{}", if i == 0 { ": " } else { "; " })?;
            match posture {
                Some(posture) if !one_for_all => write!(f, "{}: {reason}", posture.name())?,
                _ => write!(f, "{reason}")?,
            }
        }
        match self.nearest_free {
            Some(p) => write!(f, "\nnearest free grid point: ({:.6} m, {:.6} m)", p.x, p.y),
            None => write!(f, "\nno point of the grid is free"),
        }
    }
}

/// Every free configuration that `place` stands for, elbow-up first: the configuration itself, or those that put
/// the tip there, all turns between the stops included.
///
/// # Errors
/// [`NotFree`] if there is none.
pub fn configurations(scene: &Scene, place: &Place) -> Result<Vec<Configuration<2>>, NotFree> {
    let mut found: Vec<Configuration<2>> = Vec::new();
    let mut reasons = Vec::new();
    match *place {
        Place::Configuration(q) => match forbids(scene, &q) {
            None => found.push(q),
            Some(reason) => reasons.push((None, reason)),
        },
        Place::Tip(tip) => {
            for posture in Posture::ALL {
                match in_posture(scene, tip, posture) {
                    Ok(places) => {
                        for q in places {
                            if !found.contains(&q) {
                                found.push(q);
                            }
                        }
                    }
                    Err(reason) => reasons.push((Some(posture), reason)),
                }
            }
        }
    }
    if found.is_empty() {
        return Err(NotFree { place: *place, reasons, nearest_free: nearest_free(scene, place) });
    }
    Ok(found)
}

fn in_posture(scene: &Scene, tip: Point, posture: Posture) -> Result<Vec<Configuration<2>>, Reason> {
    let places = scene.arm.inverse(tip, posture).map_err(|error| match error {
        InverseError::OutOfReach { distance, nearest, farthest } => {
            Reason::OutOfReach { distance, nearest, farthest }
        }
        InverseError::OutsideJointLimits { joint, angle } => {
            Reason::JointLimit { joint, angle, limits: scene.arm.joints()[joint - 1].limits }
        }
    })?;
    match deepest_contact(scene, &places[0]) {
        None => Ok(places),
        Some(reason) => Err(reason),
    }
}

/// What forbids the configuration `q`.
fn forbids(scene: &Scene, q: &Configuration<2>) -> Option<Reason> {
    for (j, joint) in scene.arm.joints().iter().enumerate() {
        if !joint.limits.contains(q.0[j]) {
            return Some(Reason::JointLimit { joint: j + 1, angle: q.0[j], limits: joint.limits });
        }
    }
    deepest_contact(scene, q)
}

fn deepest_contact(scene: &Scene, q: &Configuration<2>) -> Option<Reason> {
    let mut deepest: Option<(usize, usize, f64)> = None;
    for (link, segment) in scene.arm.links(q).into_iter().enumerate() {
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            if touches(&scene.arm, obstacle, segment) {
                let depth = scene.arm.half_width() - obstacle.signed_distance_to_segment(segment);
                if deepest.is_none_or(|(_, _, known)| depth > known) {
                    deepest = Some((link, index, depth));
                }
            }
        }
    }
    deepest.map(|(link, obstacle, depth)| Reason::Collision {
        link: link + 1,
        obstacle,
        name: scene.obstacles[obstacle].name.clone(),
        // A link that only comes within the floor of contact is 0 m deep.
        depth: depth.max(0.0),
    })
}

fn nearest_free(scene: &Scene, place: &Place) -> Option<Point> {
    let tip = match place {
        Place::Tip(tip) => *tip,
        Place::Configuration(q) => scene.arm.tip(q),
    };
    let space = FreeSpace::of(scene);
    let free = (0..scene.grid.len()).filter(|&cell| space.union_is_free(cell));
    free.map(|cell| scene.grid.point(cell)).min_by(|a, b| a.distance(tip).total_cmp(&b.distance(tip)))
}

fn in_words(limits: &JointLimits) -> String {
    match limits {
        JointLimits::Continuous => "which is no angle".to_owned(),
        JointLimits::Range { min, max } => format!("it may turn from {min:.6} rad to {max:.6} rad"),
    }
}

fn title(obstacle: usize, name: Option<&str>) -> String {
    match name {
        Some(name) => format!("{obstacle} ({name})"),
        None => obstacle.to_string(),
    }
}
