//! The numbers that the swarms over whole candidates share, kept in one place.

/// Where particles may be, and how candidates are examined.
pub(super) struct Settings {
    /// How far beyond start and goal a continuous joint may go (rad).
    pub(super) beyond: f64,
    /// Iterations without a better candidate after which a swarm is given up.
    pub(super) stagnation: usize,
    /// Distance between two samples at a turn, as a share of the reach, and the most looks at one.
    pub(super) look_every: f64,
    pub(super) most_looks: usize,
    /// Clearance that candidates are led to keep, as a share of the reach: what is examined only here and there shall be
    /// certified.
    pub(super) kept: f64,
}

pub(super) const SETTINGS: Settings =
    Settings { beyond: std::f64::consts::PI, stagnation: 60, look_every: 0.015, most_looks: 64, kept: 2e-3 };
