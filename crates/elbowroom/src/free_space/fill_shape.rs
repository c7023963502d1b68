use super::state::CONTACT_FLOOR;
use crate::arm::TwoLinkArm;
use crate::geometry::{Point, Polygon, Segment};
use crate::scene::{Obstacle, Scene, Shape};

/// How near to contact a link is left undecided, as a share of the square of the measures at hand: the quick way
/// and the reference differ by a thousandth of this.
const UNDECIDED: f64 = 1e-12;

/// An obstacle within the arm's reach, made ready for many looks.
pub(super) struct FillShape<'a> {
    /// Its place in the scene's list.
    pub(super) index: u16,
    /// A circle around all of it.
    center: Point,
    /// Square of the distance from `center` up to which a link may touch it (m²): for a circle, does.
    near: f64,
    /// Half the width of the band around `near` that is left undecided (m²).
    band: f64,
    polygon: Option<&'a Polygon>,
}

/// What a quick look tells of a link and an obstacle.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    Clear,
    Touching,
    Undecided,
}

impl<'a> FillShape<'a> {
    /// The obstacles of `scene` that the arm can reach at all.
    pub(super) fn within_reach(scene: &'a Scene) -> Vec<Self> {
        let numbered = scene.obstacles.iter().zip(0..=u16::MAX);
        numbered.filter_map(|(obstacle, index)| Self::new(&scene.arm, obstacle, index)).collect()
    }

    fn new(arm: &TwoLinkArm, obstacle: &'a Obstacle, index: u16) -> Option<Self> {
        let (center, radius, polygon) = match &obstacle.shape {
            Shape::Circle(circle) => (circle.center, circle.radius, None),
            Shape::Polygon(polygon) => {
                let (center, radius) = circle_around(polygon);
                (center, radius, Some(polygon))
            }
        };
        let contact = radius + arm.half_width() + CONTACT_FLOOR;
        let base = arm.base();
        let measures = arm.reach()[1] + center.distance(base) + contact + base.x.abs() + base.y.abs();
        let band = UNDECIDED * measures * measures;
        let shape = Self { index, center, near: contact * contact, band, polygon };
        (center.distance(base) - arm.reach()[1] <= contact + UNDECIDED * measures).then_some(shape)
    }

    /// What is to be said of a link with its centre line at `segment`.
    pub(super) fn look(&self, segment: Segment, half_width: f64) -> Look {
        let squared = squared_distance(segment, self.center);
        if squared > self.near + self.band {
            return Look::Clear;
        }
        match self.polygon {
            None if squared < self.near - self.band => Look::Touching,
            None => Look::Undecided,
            Some(polygon) => {
                let distance = polygon.distance_to_segment(segment);
                let contact = half_width + CONTACT_FLOOR;
                let squared = distance * distance;
                // A boundary that is only grazed is left to the reference, whose links differ in their last digits.
                if squared > contact * contact + self.band {
                    Look::Clear
                } else if squared < contact * contact - self.band {
                    Look::Touching
                } else {
                    Look::Undecided
                }
            }
        }
    }
}

fn squared_distance(segment: Segment, point: Point) -> f64 {
    let along = segment.b - segment.a;
    let ray = point - segment.a;
    let fraction = (ray.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let off = ray + along * -fraction;
    off.length_squared()
}

/// A circle around `polygon`: the middle of its bounding box, and the farthest corner.
fn circle_around(polygon: &Polygon) -> (Point, f64) {
    let (mut least, mut most) = (polygon.vertices()[0], polygon.vertices()[0]);
    for v in polygon.vertices() {
        least = Point::new(least.x.min(v.x), least.y.min(v.y));
        most = Point::new(most.x.max(v.x), most.y.max(v.y));
    }
    let center = Point::new((least.x + most.x) / 2.0, (least.y + most.y) / 2.0);
    (center, polygon.vertices().iter().map(|v| v.distance(center)).fold(0.0, f64::max))
}
