/// The most links that are served.
pub const MOST_LINKS: usize = 64;

/// Shortest and longest link (m) that arithmetic in f64 can serve with the digits promised.
pub(crate) const LENGTHS: std::ops::RangeInclusive<f64> = 1e-6..=1e6;
