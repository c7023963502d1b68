//! The quick way to fill a map: no trigonometry per point, the postures' common part worked out once.

use super::arc::Arc;
use super::fill_shape::{FillShape, Look};
use super::state::{CellState, state_of};
use crate::arm::Posture;
use crate::geometry::{Point, Segment, Vector};
use crate::scene::Scene;

/// How near to the ends of the reach a point is left to the reference, as a share of the reach squared: there the
/// elbow moves with the square root of the tip's rounding.
const NEAR_END_OF_REACH: f64 = 1e-6;

/// What is worked out once for all points of a map.
pub(super) struct Filler<'a> {
    scene: &'a Scene,
    shapes: Vec<FillShape<'a>>,
    joints: [Arc; 2],
}

/// What both postures share at a place of the tip.
struct Triangle {
    /// Unit vector from base to tip.
    along: Vector,
    /// From the base, where the elbow's foot on that ray lies (m).
    foot: f64,
    /// How far beside the ray the elbow lies (m).
    beside: f64,
    /// Cosine of the second joint.
    cos: f64,
    /// Sine of the second joint, its size.
    sin: f64,
}

impl<'a> Filler<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let joints = scene.arm.joints();
        Self {
            scene,
            shapes: FillShape::within_reach(scene),
            joints: [Arc::of(&joints[0].limits), Arc::of(&joints[1].limits)],
        }
    }

    /// Fills one row of both maps.
    pub(super) fn fill_row(&self, row: usize, states: [&mut [CellState]; 2]) {
        let grid = &self.scene.grid;
        let y = grid.y(row);
        let [up, down] = states;
        for (column, (up, down)) in up.iter_mut().zip(down).enumerate() {
            [*up, *down] = self.states_at(Point::new(grid.x(column), y));
        }
    }

    /// The states of one place, elbow-up first: those of [`state_of`].
    fn states_at(&self, tip: Point) -> [CellState; 2] {
        let arm = &self.scene.arm;
        let ray = tip - arm.base();
        let [nearest, farthest] = arm.reach();
        let squared = ray.length_squared();
        let scale = NEAR_END_OF_REACH * farthest * farthest;
        let short_of_farthest = farthest * farthest - squared;
        let beyond_nearest = squared - nearest * nearest;
        if short_of_farthest < -scale || beyond_nearest < -scale {
            return [CellState::OutOfReach; 2];
        }
        if short_of_farthest < scale || beyond_nearest < scale {
            return Posture::ALL.map(|posture| state_of(self.scene, tip, posture));
        }
        let [l1, l2] = arm.lengths();
        let distance = squared.sqrt();
        let root = (short_of_farthest * beyond_nearest).sqrt();
        let triangle = Triangle {
            along: ray * (1.0 / distance),
            foot: (squared + (l1 - l2) * (l1 + l2)) / (2.0 * distance),
            beside: root / (2.0 * distance),
            cos: (squared - l1 * l1 - l2 * l2) / (2.0 * l1 * l2),
            sin: root / (2.0 * l1 * l2),
        };
        Posture::ALL.map(|posture| {
            self.decide(tip, &triangle, posture).unwrap_or_else(|| state_of(self.scene, tip, posture))
        })
    }

    /// The state, or `None` where rounding could decide.
    fn decide(&self, tip: Point, triangle: &Triangle, posture: Posture) -> Option<CellState> {
        let arm = &self.scene.arm;
        let side = match posture {
            Posture::ElbowUp => 1.0,
            Posture::ElbowDown => -1.0,
        };
        let Vector { x, y } = triangle.along;
        let (foot, beside) = (triangle.foot, side * triangle.beside);
        let to_elbow = Vector::new(foot * x - beside * y, foot * y + beside * x);
        if !self.joints[0].holds(to_elbow * (1.0 / arm.lengths()[0]))? {
            return Some(CellState::JointLimit { joint: 1 });
        }
        if !self.joints[1].holds(Vector::new(triangle.cos, -side * triangle.sin))? {
            return Some(CellState::JointLimit { joint: 2 });
        }
        let elbow = arm.base() + to_elbow;
        for (link, segment) in
            [Segment::new(arm.base(), elbow), Segment::new(elbow, tip)].into_iter().enumerate()
        {
            for shape in &self.shapes {
                match shape.look(segment, arm.half_width()) {
                    Look::Clear => {}
                    Look::Touching => {
                        return Some(CellState::Collision { link: link as u8 + 1, obstacle: shape.index });
                    }
                    Look::Undecided => return None,
                }
            }
        }
        Some(CellState::Free)
    }
}
