use crate::geometry::{Point, Vector};

/// What a straight way costs by its coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// Its length.
    Euclidean,
    /// The greater of both coordinates' ways, each times its weight: the time of two joints that turn at once.
    Greatest([f64; 2]),
}

impl Measure {
    /// What going by `way` costs.
    pub fn of(self, way: Vector) -> f64 {
        match self {
            Self::Euclidean => (way.x * way.x + way.y * way.y).sqrt(),
            Self::Greatest([x, y]) => (x * way.x.abs()).max(y * way.y.abs()),
        }
    }

    /// The least cost from `point` to a place of the straight line from `a` to `b`.
    pub fn to_line(self, point: Point, a: Point, b: Point) -> f64 {
        let (along, ray) = (b - a, a - point);
        let at = |t: f64| self.of(ray + along * t.clamp(0.0, 1.0));
        match self {
            Self::Euclidean => {
                let squared = along.length_squared();
                if squared > 0.0 { at(-ray.dot(along) / squared) } else { at(0.0) }
            }
            Self::Greatest([x, y]) => {
                // Convex along the line: least at an end or where one of both vanishes or they are equal.
                let (rx, ry, ax, ay) = (x * ray.x, y * ray.y, x * along.x, y * along.y);
                let candidates = [(rx, ax), (ry, ay), (rx - ry, ax - ay), (rx + ry, ax + ay)];
                let inner = candidates
                    .into_iter()
                    .filter(|(_, slope)| *slope != 0.0)
                    .map(|(r, slope)| at(-r / slope));
                inner.fold(at(0.0).min(at(1.0)), f64::min)
            }
        }
    }

    /// The least cost from the box between `low` and `high` to `point`.
    pub(super) fn between_box_and(self, low: Point, high: Point, point: Point) -> f64 {
        let apart = |low: f64, high: f64, v: f64| (low - v).max(v - high).max(0.0);
        self.of(Vector::new(apart(low.x, high.x, point.x), apart(low.y, high.y, point.y)))
    }
}
