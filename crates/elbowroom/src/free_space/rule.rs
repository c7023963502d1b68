use super::CellState;
use super::arc::Arc;
use super::boundary::Boundary;
use super::stances::{Lengths, Stances};
use super::state::CONTACT_FLOOR;
use crate::arm::TwoLinkArm;
use crate::scene::{Obstacle, Scene, Shape};

/// How near to a joint's stop a direction is left undecided (rad).
const JOINT_ROUNDING: f64 = 1e-9;

/// How near to contact a link is left undecided, as a share of the measures at hand: away from the ends of the reach,
/// the quick way and the reference differ by less than a tenth of this.
const CONTACT_ROUNDING: f64 = 1e-11;

/// A reason why the tip may not stand somewhere.
pub(super) struct Rule {
    /// The state of the places it forbids.
    pub(super) state: CellState,
    test: Test,
}

enum Test {
    /// The tip is out of reach.
    Reach,
    /// A joint, from 0, points outside `arc`.
    Joint { joint: usize, arc: Arc },
    /// A link, from 0, comes within `contact` (m) of what lies at `x`, `y` as seen from the base.
    Contact { link: usize, x: f64, y: f64, contact: f64, rounding: f64, boundary: Option<Boundary> },
}

/// How far the places asked about may be from the stances tried.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Slack {
    /// Of the square of the tip's distance from the base (m²).
    pub(super) squared: f64,
    /// Of each joint (rad).
    pub(super) joints: [f64; 2],
    /// Of any point of any link (m).
    pub(super) links: f64,
}

/// What rules say of a place: that nothing forbids it, so far; that rounding or slack may decide; or the number of
/// the rule that forbids it.
pub(super) const ALLOWED: u64 = 0;
pub(super) const UNDECIDED: u64 = u64::MAX;

impl Rule {
    /// All rules of `scene` that could forbid anything, those that come first in [`CellState`]'s order first.
    pub(super) fn all(scene: &Scene) -> Vec<Self> {
        let arm = &scene.arm;
        let mut rules = vec![Self { state: CellState::OutOfReach, test: Test::Reach }];
        for joint in 0..2 {
            if let Some(arc) = Arc::of(&arm.joints()[joint].limits) {
                let state = CellState::JointLimit { joint: joint as u8 + 1 };
                rules.push(Self { state, test: Test::Joint { joint, arc } });
            }
        }
        for link in 0..2 {
            for (index, obstacle) in scene.obstacles.iter().enumerate() {
                if let Some(test) = Test::contact(arm, obstacle, link) {
                    let state = CellState::Collision { link: link as u8 + 1, obstacle: index as u16 };
                    rules.push(Self { state, test });
                }
            }
        }
        rules
    }

    /// Marks the stances that this rule, as `number`, does not surely allow; what earlier calls marked is overwritten,
    /// so that of several rules the one asked last has the say.
    #[inline(always)]
    pub(super) fn mark<const N: usize>(
        &self,
        number: u64,
        at: &Stances<N>,
        slack: &Slack,
        marks: &mut [u64; N],
    ) {
        let mut measure = [0.0; N];
        let (forbidden_below, allowed_above) = match &self.test {
            Test::Reach => {
                let Lengths { nearest_squared, farthest_squared, rounding, .. } = at.lengths;
                for lane in 0..N {
                    let squared = at.squared[lane];
                    let (short, beyond) = (farthest_squared - squared, squared - nearest_squared);
                    measure[lane] = if short < beyond { short } else { beyond };
                }
                (-(rounding + slack.squared), rounding + slack.squared)
            }
            Test::Joint { joint, arc } => {
                for lane in 0..N {
                    let (cos, sin) = at.direction(lane, *joint);
                    measure[lane] = arc.measure(cos, sin);
                }
                let slack = JOINT_ROUNDING + slack.joints[*joint];
                (-slack, slack)
            }
            Test::Contact { link, x, y, contact, rounding, boundary } => {
                let links = &at.links[*link];
                for lane in 0..N {
                    measure[lane] = links.squared_distance(lane, *x, *y);
                }
                let slack = rounding + slack.links;
                let contact = match boundary {
                    None => *contact,
                    Some(boundary) => {
                        let near = boundary.radius + contact + slack;
                        if measure.iter().all(|m| *m > near * near) {
                            return;
                        }
                        boundary.measure(links, &mut measure);
                        *contact
                    }
                };
                let (least, most) = (contact - slack, contact + slack);
                // With more slack than contact only a negative measure, of a link that enters, is deep enough.
                (if least > 0.0 { least * least } else { -slack * slack }, most * most)
            }
        };
        for lane in 0..N {
            // A measure that is not a number is neither above nor below.
            let doubtful = if measure[lane] < forbidden_below { number } else { UNDECIDED };
            marks[lane] = if measure[lane] > allowed_above { marks[lane] } else { doubtful };
        }
    }
}

impl Test {
    /// Contact of `link` with `obstacle`; `None` where they cannot meet.
    fn contact(arm: &TwoLinkArm, obstacle: &Obstacle, link: usize) -> Option<Self> {
        let base = arm.base();
        let floor = arm.half_width() + CONTACT_FLOOR;
        let [reach, farthest] = [arm.lengths()[0], arm.reach()[1]];
        let reach = if link == 0 { reach } else { farthest };
        let (center, radius, contact, polygon) = match &obstacle.shape {
            Shape::Circle(circle) => (circle.center, circle.radius, circle.radius + floor, None),
            Shape::Polygon(polygon) => {
                let (center, radius) = Boundary::circle_around(polygon);
                (center, radius, floor, Some(polygon))
            }
        };
        let offset = center - base;
        let spread = farthest + offset.length() + radius.abs() + floor;
        let rounding = CONTACT_ROUNDING * (spread + base.x.abs() + base.y.abs());
        let boundary = polygon.map(|polygon| Boundary::new(polygon, base, radius, 8.0 * rounding * spread));
        let near = radius + floor + rounding;
        (near >= 0.0 && offset.length() - reach <= near).then_some(Self::Contact {
            link,
            x: offset.x,
            y: offset.y,
            contact,
            rounding,
            boundary,
        })
    }
}
