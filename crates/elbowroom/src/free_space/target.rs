use std::sync::Arc as Shared;

use super::boundary::Boundary;
use super::stances::{Lanes, Links};
use super::state::CONTACT_FLOOR;
use crate::arm::TwoLink;
use crate::geometry::{Point, Vector};
use crate::scene::Obstacle;

/// How near to contact a link is left undecided, as a share of the measures at hand: away from the ends of the reach,
/// the quick way and the reference differ by less than a tenth of this.
const CONTACT_ROUNDING: f64 = 1e-11;

/// Measures beyond which nothing is decided quickly (m): squares of squares of them would leave the numbers' range.
const GREATEST: f64 = 1e12;

/// An obstacle made ready for many looks; positions are seen from the base.
#[derive(Clone)]
pub(super) struct Target {
    /// Of a circle around all of its core: its middle (m).
    x: f64,
    y: f64,
    /// The circle's radius (m); for a disc 0.
    radius: f64,
    /// The centre line of a link touches it at this distance from the core (m).
    pub(super) contact: f64,
    /// How much of that distance rounding may decide (m).
    pub(super) rounding: f64,
    /// Of a core that is more than a point.
    boundary: Option<Shared<Boundary>>,
}

impl Target {
    /// `obstacle` to an arm that is to stay `margin` (m) farther away than contact.
    pub(super) fn new(arm: &TwoLink, obstacle: &Obstacle, margin: f64) -> Self {
        let base = arm.base();
        let floor = arm.half_width() + CONTACT_FLOOR + margin;
        let shape = &obstacle.shape;
        let ((center, radius), contact) = (shape.circle_around_core(), shape.radius() + floor);
        let Vector { x, y } = center - base;
        let spread = arm.reach()[1] + libm::hypot(x, y) + radius + contact.abs();
        let rounding = if spread < GREATEST {
            CONTACT_ROUNDING * (spread + base.x.abs() + base.y.abs())
        } else {
            f64::INFINITY
        };
        let has_lines = shape.vertices().len() > 1;
        let boundary = has_lines.then(|| Shared::new(Boundary::new(shape, base, 8.0 * rounding * spread)));
        Self { x, y, radius, contact, rounding, boundary }
    }

    /// Whether a link within `reach` (m) of the base may touch it at all.
    pub(super) fn is_within(&self, reach: f64) -> bool {
        let near = self.radius + self.contact + self.rounding;
        near >= 0.0 && libm::hypot(self.x, self.y) <= reach + near
    }

    /// Whether no link touches it while the tip is within `radius` of `middle`, for an arm with links of `farthest`
    /// together: the way from base to tip over any point of the links is at most as long as that.
    pub(super) fn is_beyond(&self, farthest: f64, middle: Point, radius: f64) -> bool {
        let (dx, dy) = (self.x - middle.x, self.y - middle.y);
        let (from_base, from_tip) = ((self.x * self.x + self.y * self.y).sqrt(), (dx * dx + dy * dy).sqrt());
        from_base + from_tip > farthest + radius + 2.0 * (self.radius + self.contact + self.rounding)
    }

    /// For each link the square of its distance from the disc's middle, or what [`Boundary::measure`] tells; false, and
    /// nothing told, where it is plain that with `slack` (m) none touches.
    #[inline(always)]
    pub(super) fn measure<const N: usize>(
        &self,
        links: &Links<N>,
        slack: f64,
        measure: &mut Lanes<N>,
    ) -> bool {
        for (lane, measure) in measure.iter_mut().enumerate() {
            *measure = links.squared_distance(lane, self.x, self.y);
        }
        if let Some(boundary) = &self.boundary {
            let near = self.radius + self.contact + slack;
            if measure.iter().all(|squared| *squared > near * near) {
                return false;
            }
            boundary.measure(links, measure);
        }
        true
    }
}
