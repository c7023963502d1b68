use super::CellState;
use super::arc::Arc;
use super::mark::{FREE, Mark, mark_of};
use super::stances::{Lengths, Stances};
use super::target::Target;
use crate::arm::TwoLink;
use crate::geometry::Point;
use crate::scene::{Obstacle, TwoLinkScene};

/// How near to a joint's stop a direction is left undecided (rad).
const JOINT_ROUNDING: f64 = 1e-9;

/// A reason why the tip may not stand somewhere.
pub(super) struct Rule {
    /// Stands for the state of the places it forbids.
    mark: Mark,
    test: Test,
}

enum Test {
    /// The tip is out of reach.
    Reach,
    /// A joint, from 0, points outside `arc`.
    Joint { joint: usize, arc: Arc },
    /// A link, from 0, touches an obstacle.
    Contact { link: usize, obstacle: Target },
}

/// How far the stances asked about may be from those tried; both are out of reach, or both within.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Slack {
    /// Of each joint (rad).
    pub(super) joints: [f64; 2],
    /// Of any point of any link (m).
    pub(super) links: f64,
}

/// Marks a place where slack or rounding may decide.
pub(super) const UNDECIDED: Mark = Mark::MAX;

impl Slack {
    /// How far the arm moves at most while its tip goes anywhere within `radius` of a place at `distance` from the base,
    /// if all of that is out of reach or all within; `None` where it may come to the ends of the reach.
    ///
    /// The second joint's sine bounds it: the tip moves at least that many times as far as the elbow, and the square
    /// of the sine has no least value but at the ends of an interval of squared distances.
    pub(super) fn around(lengths: &Lengths, distance: f64, radius: f64) -> Option<Self> {
        let (near, far) = ((distance - radius).max(0.0), distance + radius);
        let (near_squared, far_squared) = (near * near, far * far);
        let (past_nearest, short_of_farthest) =
            (|squared| squared - lengths.nearest_squared, |squared| lengths.farthest_squared - squared);
        if short_of_farthest(near_squared) < -lengths.rounding
            || past_nearest(far_squared) < -lengths.rounding
        {
            return Some(Self::default());
        }
        if past_nearest(near_squared) < lengths.rounding || short_of_farthest(far_squared) < lengths.rounding
        {
            return None;
        }
        let area = lengths.area(near_squared).min(lengths.area(far_squared));
        let product = lengths.first * lengths.second;
        let sine = area.sqrt() / (2.0 * product);
        let elbow = radius / sine;
        let joints = [elbow / lengths.first, far * radius / (product * sine)];
        Some(Self { joints, links: elbow })
    }
}

impl Rule {
    /// All rules of `scene` that could forbid anything, those that come first in [`CellState`]'s order first.
    pub(super) fn all(scene: TwoLinkScene<'_>) -> Vec<Self> {
        let arm = scene.arm();
        let mut rules = vec![Self { mark: mark_of(CellState::OutOfReach), test: Test::Reach }];
        for joint in 0..2 {
            if let Some(arc) = Arc::of(&arm.joints()[joint].limits) {
                let state = CellState::JointLimit { joint: joint as u8 + 1 };
                rules.push(Self { mark: mark_of(state), test: Test::Joint { joint, arc } });
            }
        }
        rules.extend(Self::contacts(arm, 0.0, scene.obstacles().iter().enumerate()));
        rules
    }

    /// The rules that some obstacles make, each given with its number in the scene, where the arm stays `margin` (m)
    /// farther away than contact.
    pub(super) fn contacts<'o>(
        arm: &TwoLink,
        margin: f64,
        obstacles: impl Iterator<Item = (usize, &'o Obstacle)>,
    ) -> Vec<Self> {
        let targets: Vec<(usize, Target)> =
            obstacles.map(|(index, obstacle)| (index, Target::new(arm, obstacle, margin))).collect();
        let mut rules = Vec::new();
        for (link, reach) in [arm.lengths()[0], arm.reach()[1]].into_iter().enumerate() {
            for (index, target) in targets.iter().filter(|(_, target)| target.is_within(reach)) {
                let state = CellState::Collision { link: link as u8 + 1, obstacle: *index as u16 };
                let test = Test::Contact { link, obstacle: target.clone() };
                rules.push(Self { mark: mark_of(state), test });
            }
        }
        rules
    }

    /// Whether this may forbid something within `radius` of `middle`, where `at` stands, with the slack that the arm has
    /// then; `None` where it may come to the ends of the reach.
    pub(super) fn may_forbid(
        &self,
        (middle, radius): (Point, f64),
        at: &Stances<1>,
        slack: Option<&Slack>,
    ) -> bool {
        let Some(slack) = slack else { return !self.allows_around(middle, radius, &at.lengths) };
        let mut mark = [FREE];
        self.mark(at, slack, &mut mark);
        mark[0] != FREE
    }

    /// Marks the stances that this rule does not surely allow; what earlier calls marked is overwritten, so that of
    /// several rules the one asked last has the say.
    #[inline(always)]
    pub(super) fn mark<const N: usize>(&self, at: &Stances<N>, slack: &Slack, marks: &mut [Mark; N]) {
        let mut measure = [0.0; N];
        let (forbidden_below, allowed_above) = match &self.test {
            Test::Reach => {
                let Lengths { nearest_squared, farthest_squared, rounding, .. } = at.lengths;
                for (measure, squared) in measure.iter_mut().zip(at.squared) {
                    let (short, beyond) = (farthest_squared - squared, squared - nearest_squared);
                    *measure = if short < beyond { short } else { beyond };
                }
                (-rounding, rounding)
            }
            Test::Joint { joint, arc } => {
                for (lane, measure) in measure.iter_mut().enumerate() {
                    let (cos, sin) = at.direction(lane, *joint);
                    *measure = arc.measure(cos, sin);
                }
                let slack = JOINT_ROUNDING + slack.joints[*joint];
                (-slack, slack)
            }
            Test::Contact { link, obstacle } => {
                let slack = obstacle.rounding + slack.links;
                if !obstacle.measure(&at.links[*link], slack, &mut measure) {
                    return;
                }
                let (least, most) = (obstacle.contact - slack, obstacle.contact + slack);
                // With more slack than contact only a negative measure, of a link that enters, is deep enough.
                (if least > 0.0 { least * least } else { -slack * slack }, most * most)
            }
        };
        for (mark, measure) in marks.iter_mut().zip(measure) {
            // A measure that is not a number is neither above nor below.
            let otherwise = if measure < forbidden_below { self.mark } else { UNDECIDED };
            *mark = if measure > allowed_above { *mark } else { otherwise };
        }
    }

    /// Whether this forbids nothing while the tip is within `radius` of `middle`, wherever the elbow may be.
    pub(super) fn allows_around(&self, middle: Point, radius: f64, lengths: &Lengths) -> bool {
        match &self.test {
            Test::Contact { obstacle, .. } => {
                obstacle.is_beyond(lengths.first + lengths.second, middle, radius)
            }
            _ => false,
        }
    }
}
