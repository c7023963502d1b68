use std::ops::{Deref, DerefMut};

use smallvec::SmallVec;

/// One position per joint (rad), base first; each joint is measured from the link before it.
///
/// A slice of numbers that does not need the heap for up to four joints.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Configuration(SmallVec<[f64; 4]>);

impl Configuration {
    /// The configuration at `fraction` of the straight line to `to`, with no turn taken off.
    #[must_use]
    pub fn lerp(&self, to: &[f64], fraction: f64) -> Self {
        lerp(self, to, fraction)
    }

    /// Euclidean distance in configuration space (rad), with no turn taken off.
    pub fn distance(&self, to: &[f64]) -> f64 {
        joint_distance(self, to)
    }
}

impl Deref for Configuration {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.0
    }
}

impl DerefMut for Configuration {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl AsRef<[f64]> for Configuration {
    fn as_ref(&self) -> &[f64] {
        &self.0
    }
}

impl From<&[f64]> for Configuration {
    fn from(q: &[f64]) -> Self {
        Self(SmallVec::from_slice(q))
    }
}

impl<const N: usize> From<[f64; N]> for Configuration {
    fn from(q: [f64; N]) -> Self {
        Self(SmallVec::from_slice(&q))
    }
}

impl From<Vec<f64>> for Configuration {
    fn from(q: Vec<f64>) -> Self {
        Self(SmallVec::from_slice(&q))
    }
}

impl FromIterator<f64> for Configuration {
    fn from_iter<I: IntoIterator<Item = f64>>(positions: I) -> Self {
        Self(positions.into_iter().collect())
    }
}

impl PartialEq<[f64]> for Configuration {
    fn eq(&self, other: &[f64]) -> bool {
        **self == *other
    }
}

/// The positions (rad) at `fraction` of the straight line from `from` to `to`, with no turn taken off.
pub fn lerp<Q: FromIterator<f64>>(from: &[f64], to: &[f64], fraction: f64) -> Q {
    from.iter().zip(to).map(|(from, to)| from + (to - from) * fraction).collect()
}

/// Euclidean distance between two configurations, a position per joint each (rad), with no turn taken off.
pub fn joint_distance(a: &[f64], b: &[f64]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum();
    squares.sqrt()
}
