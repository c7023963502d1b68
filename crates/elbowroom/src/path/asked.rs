use super::clearance::CERTIFIED_CLEARANCE;

/// Clearances examined per link and what it must not touch before a move is given up as not free: a move of a metre that
/// stays within 8e-6 m of an obstacle all along may use them up, one that only passes by does not.
const MOST_LOOKS: u32 = 1 << 17;

/// The same where a refusal costs little.
const FEWER_LOOKS: u32 = 1 << 10;

/// What is asked of a move.
#[derive(Clone, Copy)]
pub(super) struct Asked {
    /// Clearance that has to be left (m).
    pub(super) kept: f64,
    /// Per pair.
    pub(super) most_looks: u32,
    /// Whether links count that must not touch each other.
    pub(super) of_itself: bool,
}

impl Asked {
    pub(super) const CERTIFIED: Self =
        Self { kept: CERTIFIED_CLEARANCE, most_looks: MOST_LOOKS, of_itself: true };

    /// Of obstacles alone.
    pub(super) const OF_OBSTACLES: Self = Self { of_itself: false, ..Self::CERTIFIED };

    /// `margin` (m) more, or soon given up.
    pub(super) fn with_margin(margin: f64) -> Self {
        Self { kept: CERTIFIED_CLEARANCE + margin, most_looks: FEWER_LOOKS, of_itself: true }
    }
}
