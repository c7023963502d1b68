use std::ops::{Add, Mul, Neg, Sub};

/// A position in the plane (m).
///
/// The sum of two points has no meaning and no operator; a point plus a [`Vector`] has.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
}

/// The difference of two [`Point`]s (m).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
}

impl Point {
    /// The point at (`x`, `y`).
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Distance to `other` (m).
    pub fn distance(self, other: Self) -> f64 {
        (other - self).length()
    }

    /// The point at `fraction` of the way to `other`: 0 gives `self`, 1 gives `other`.
    pub fn lerp(self, other: Self, fraction: f64) -> Self {
        self + (other - self) * fraction
    }

    /// Whether both coordinates are finite numbers.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Vector {
    /// The vector (`x`, `y`).
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The vector of the given length (m) at `angle` (rad) from the x axis.
    pub fn polar(length: f64, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self::new(length * cos, length * sin)
    }

    /// Scalar product with `other`.
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// The z component of the cross product: positive when `other` lies to the left.
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Euclidean length (m).
    pub fn length(self) -> f64 {
        libm::hypot(self.x, self.y)
    }

    /// Square of the length (m²).
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Angle from the x axis, in (-π, π].
    pub fn angle(self) -> f64 {
        libm::atan2(self.y, self.x)
    }
}

impl Sub for Point {
    type Output = Vector;
    fn sub(self, other: Self) -> Vector {
        Vector::new(self.x - other.x, self.y - other.y)
    }
}

impl Add<Vector> for Point {
    type Output = Self;
    fn add(self, offset: Vector) -> Self {
        Self::new(self.x + offset.x, self.y + offset.y)
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl Mul<f64> for Vector {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }
}
