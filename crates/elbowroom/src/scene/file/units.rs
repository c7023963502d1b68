/// The units that a file is written in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    pub(super) per_metre: f64,
    pub(super) degrees: bool,
}

impl Units {
    /// In metres: divided, so that 25 cm is the number nearest to a quarter.
    pub(super) fn length(self, number: f64) -> f64 {
        number / self.per_metre
    }

    /// In radians, or radians per second to some power.
    pub(super) fn angle(self, number: f64) -> f64 {
        if self.degrees { number.to_radians() } else { number }
    }

    /// What the file calls its unit of angles.
    pub(super) fn angle_name(self) -> &'static str {
        if self.degrees { "deg" } else { "rad" }
    }
}
