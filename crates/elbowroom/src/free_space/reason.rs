use thiserror::Error;

use super::CONTACT_FLOOR;
use super::state::touches;
use crate::arm::JointLimits;
use crate::geometry::Segment;
use crate::scene::{Scene, obstacle_in_words};
use crate::units::{Told, Units, apart};

/// What forbids a configuration, or a place of the tip in one posture.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Reason {
    /// The links cannot put the tip there.
    #[error("{}", self.told(Units::SI))]
    OutOfReach {
        /// From base to tip (m).
        distance: f64,
        /// Nearest to the base that the links allow (m).
        nearest: f64,
        /// Farthest from the base (m).
        farthest: f64,
    },
    /// A joint would have to stand outside its limits.
    #[error("{}", self.told(Units::SI))]
    JointLimit {
        /// 1 for the joint at the base.
        joint: usize,
        /// Where it would stand (rad).
        angle: f64,
        /// Where it may stand.
        limits: JointLimits,
    },
    /// A link would touch an obstacle.
    #[error("{}", self.told(Units::SI))]
    Collision {
        /// 1 for the link at the base.
        link: usize,
        /// The obstacle's place among the scene's, from 0.
        obstacle: usize,
        /// Its name, if it has one.
        name: Option<String>,
        /// How deep the link enters it, its own half width included (m): of all contacts the deepest.
        depth: f64,
    },
    /// Two links that are no neighbours would touch.
    #[error("{}", self.told(Units::SI))]
    SelfCollision {
        /// The one nearer to the base, 1 for the link there.
        link: usize,
        /// The other one.
        other: usize,
        /// How much less far apart they are than their half widths ask for (m).
        depth: f64,
    },
    /// It is the configuration of an arm with another number of joints.
    #[error("it has {found} joint positions, the arm has {joints} joints")]
    OtherArm {
        /// How many positions it has.
        found: usize,
        /// How many joints the arm has.
        joints: usize,
    },
}

/// What forbids the configuration `q` (rad): another number of joints than the arm has, else the first joint beyond its limits, else the deepest contact with an obstacle,
/// else the deepest of links with each other.
pub fn reason_against(scene: &Scene, q: &[f64]) -> Option<Reason> {
    let joints = scene.arm().links();
    if q.len() != joints {
        return Some(Reason::OtherArm { found: q.len(), joints });
    }
    for (j, (joint, &angle)) in scene.arm().joints().iter().zip(q).enumerate() {
        if !joint.limits.contains(angle) {
            return Some(Reason::JointLimit { joint: j + 1, angle, limits: joint.limits });
        }
    }
    deepest_contact(scene, q).or_else(|| deepest_self_contact(scene, q))
}

pub(super) fn deepest_contact(scene: &Scene, q: &[f64]) -> Option<Reason> {
    let mut deepest: Option<(usize, usize, f64)> = None;
    for (link, segment) in scene.arm().link_segments(q).enumerate() {
        for (index, obstacle) in scene.obstacles().iter().enumerate() {
            if touches(scene.arm().half_width(), obstacle, segment) {
                let depth = scene.arm().half_width() - obstacle.signed_distance_to_segment(segment);
                if deepest.is_none_or(|(_, _, known)| depth > known) {
                    deepest = Some((link, index, depth));
                }
            }
        }
    }
    deepest.map(|(link, obstacle, depth)| Reason::Collision {
        link: link + 1,
        obstacle,
        name: scene.obstacles()[obstacle].name.clone(),
        // A link that only comes within the floor of contact is 0 m deep.
        depth: depth.max(0.0),
    })
}

fn deepest_self_contact(scene: &Scene, q: &[f64]) -> Option<Reason> {
    if !scene.arm().self_collision() {
        return None;
    }
    let segments: Vec<Segment> = scene.arm().link_segments(q).collect();
    let mut deepest: Option<(usize, usize, f64)> = None;
    for (link, segment) in segments.iter().enumerate() {
        for (other, far) in segments.iter().enumerate().skip(link + 2) {
            let depth = 2.0 * scene.arm().half_width() - segment.distance_to_segment(*far);
            if depth >= -CONTACT_FLOOR && deepest.is_none_or(|(_, _, known)| depth > known) {
                deepest = Some((link, other, depth));
            }
        }
    }
    deepest.map(|(link, other, depth)| Reason::SelfCollision {
        link: link + 1,
        other: other + 1,
        depth: depth.max(0.0),
    })
}

impl Told for Reason {
    fn told(&self, units: Units) -> String {
        self.told_within(units, 0.0)
    }
}

impl Reason {
    /// In words, where `clearance` (m) was asked for and depths count from there.
    pub(super) fn told_within(&self, units: Units, clearance: f64) -> String {
        match self {
            &Self::OutOfReach { distance, nearest, farthest } => {
                let beyond = if distance > farthest { farthest } else { nearest };
                let [distance, _] = apart(units.of_metres(distance), units.of_metres(beyond));
                format!(
                    "out of reach: {distance} {} from the base, the arm reaches {} to {}",
                    units.length.name(),
                    units.stated_length(nearest),
                    units.stated_length(farthest)
                )
            }
            Self::JointLimit { joint, angle, limits } => match *limits {
                JointLimits::Continuous => {
                    format!("joint {joint} would have to be at an angle that is no number")
                }
                JointLimits::Range { min, max } => {
                    let beyond = if *angle > max { max } else { min };
                    let [angle, _] = units.beside_limit(*angle, beyond, 0);
                    let [min, max] = [min, max].map(|limit| units.stated_angle(limit));
                    format!("joint {joint} would have to be at {angle}, its limits are {min} to {max}")
                }
            },
            Self::Collision { link, obstacle, name, depth } => {
                contact(units, *link, &obstacle_in_words(*obstacle, name.as_deref()), *depth, clearance)
            }
            Self::SelfCollision { link, other, depth } => {
                contact(units, *link, &format!("link {other}"), *depth, clearance)
            }
            Self::OtherArm { .. } => self.to_string(),
        }
    }
}

fn contact(units: Units, link: usize, other: &str, depth: f64, clearance: f64) -> String {
    if depth < clearance - CONTACT_FLOOR {
        let [nearest, asked] = apart(units.of_metres(clearance - depth), units.of_metres(clearance));
        let unit = units.length.name();
        return format!("link {link} would be {nearest} {unit} from {other}, {asked} {unit} were asked for");
    }
    let depth = depth - clearance;
    // Within the floor of contact there is no depth to speak of.
    if depth <= CONTACT_FLOOR {
        return format!("link {link} would touch {other}");
    }
    format!("link {link} would penetrate {other} by {}", units.length(depth))
}
