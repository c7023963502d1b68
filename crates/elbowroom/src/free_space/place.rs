use std::fmt;

use super::reason::deepest_contact;
use super::{FreeSpace, Reason, reason_against};
use crate::arm::{InverseError, Posture};
use crate::geometry::Point;
use crate::scene::{Place, TwoLinkScene};
use crate::units::{Told, Units};

/// A place where the arm cannot stand.
#[derive(Debug, Clone, PartialEq)]
pub struct NotFree {
    /// The place asked for.
    pub place: Place,
    /// What forbids it: once for each posture of a tip place, once for a configuration; nothing for the tip of an arm of
    /// more than two links, which has too many configurations to name one.
    pub reasons: Vec<(Option<Posture>, Reason)>,
    /// The free grid point nearest to where the tip would be (m), if there is a map with a free point.
    pub nearest_free: Option<Point>,
    /// The clearance that was asked for (m): depths count from there.
    pub clearance: f64,
}

impl std::error::Error for NotFree {}

impl fmt::Display for NotFree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Units::SI))
    }
}

impl Told for NotFree {
    fn told(&self, units: Units) -> String {
        let place = match &self.place {
            Place::Tip(tip) => units.place(tip.x, tip.y),
            Place::Configuration(q) => {
                let angles: Vec<String> = q.iter().map(|&angle| units.stated_angle(angle)).collect();
                format!("q = [{}]", angles.join(", "))
            }
        };
        let one_for_all = self.reasons.windows(2).all(|pair| pair[0].1 == pair[1].1);
        let told =
            self.reasons.iter().take(if one_for_all { 1 } else { 2 }).map(
                |(posture, reason)| match posture {
                    Some(posture) if !one_for_all => {
                        format!("{}: {}", posture.name(), reason.told_within(units, self.clearance))
                    }
                    _ => reason.told_within(units, self.clearance),
                },
            );
        let reasons: Vec<String> = told.collect();
        let colon = if reasons.is_empty() { "" } else { ": " };
        let nearest = self
            .nearest_free
            .map_or_else(String::new, |p| format!("\nnearest free grid point: {}", units.place(p.x, p.y)));
        format!("{place} is not free{colon}{}{nearest}", reasons.join("; "))
    }
}

/// Every free configuration that `place` stands for, elbow-up first: the configuration itself, or those that put
/// the tip there, in every revolution within the joint limits.
///
/// # Errors
/// [`NotFree`] if there is none.
pub fn configurations(scene: TwoLinkScene<'_>, place: &Place) -> Result<Vec<[f64; 2]>, NotFree> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut reasons = Vec::new();
    match place {
        Place::Configuration(q) => match <[f64; 2]>::try_from(&q[..]) {
            Ok(q) => match reason_against(scene.scene(), &q) {
                None => found.push(q),
                Some(reason) => reasons.push((None, reason)),
            },
            Err(_) => reasons.push((None, Reason::OtherArm { found: q.len(), joints: 2 })),
        },
        &Place::Tip(tip) => {
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
        return Err(NotFree {
            place: place.clone(),
            reasons,
            nearest_free: nearest_free(scene, place),
            clearance: 0.0,
        });
    }
    Ok(found)
}

fn in_posture(scene: TwoLinkScene<'_>, tip: Point, posture: Posture) -> Result<Vec<[f64; 2]>, Reason> {
    let places = scene.arm().inverse(tip, posture).map_err(|error| match error {
        InverseError::OutOfReach { distance, nearest, farthest } => {
            Reason::OutOfReach { distance, nearest, farthest }
        }
        InverseError::OutsideJointLimits { joint, angle } => {
            Reason::JointLimit { joint, angle, limits: scene.arm().joints()[joint - 1].limits }
        }
    })?;
    match deepest_contact(scene.scene(), &places[0]) {
        None => Ok(places),
        Some(reason) => Err(reason),
    }
}

fn nearest_free(scene: TwoLinkScene<'_>, place: &Place) -> Option<Point> {
    let tip = match place {
        Place::Tip(tip) => *tip,
        Place::Configuration(q) => scene.arm().tip(&<[f64; 2]>::try_from(&q[..]).ok()?),
    };
    let space = FreeSpace::of(scene);
    let free = (0..scene.grid().len()).filter(|&cell| space.union_is_free(cell));
    free.map(|cell| scene.grid().point(cell)).min_by(|a, b| a.distance(tip).total_cmp(&b.distance(tip)))
}
