//! Which stretches of a side are seen from one bend.

use smallvec::SmallVec;

/// Costs that differ by less than this share are the same: paths to one vertex may differ in what they see beyond.
const COST_ROUNDING: f64 = 1e-12;

/// The most that `cost` may come to when it is summed up along another path.
pub(super) fn with_rounding(cost: f64) -> f64 {
    cost * (1.0 + COST_ROUNDING)
}

/// Stretches of a side, as shares of it and apart, that paths of the least known cost to one bend have crossed.
#[derive(Default)]
pub(super) struct Crossed {
    cost: f64,
    stretches: SmallVec<[[f64; 2]; 1]>,
}

impl Crossed {
    /// Whether a path of `cost` to the bend crosses anything of a stretch that no path as cheap did before; it counts from now on.
    pub(super) fn is_more(&mut self, cost: f64, [from, to]: [f64; 2]) -> bool {
        if self.stretches.is_empty() || with_rounding(cost) < self.cost {
            *self = Self { cost, stretches: SmallVec::new() };
        } else if self.stretches.iter().any(|known| known[0] <= from && to <= known[1]) {
            return false;
        }
        let mut whole = [from, to];
        self.stretches.retain(|known| {
            let apart = known[1] < whole[0] || whole[1] < known[0];
            if !apart {
                whole = [whole[0].min(known[0]), whole[1].max(known[1])];
            }
            apart
        });
        self.stretches.push(whole);
        true
    }
}
