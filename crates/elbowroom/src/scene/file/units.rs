use super::keys;
use super::value::{Fault, Value};

/// The units that a file is written in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    per_metre: f64,
    degrees: bool,
}

impl Units {
    pub(super) fn read(value: &Value<'_>) -> Result<Self, Fault> {
        let map = value.map(&keys::UNITS)?;
        let per_metre = match map.required("length")?.word(&["m", "cm", "mm"])? {
            "cm" => 100.0,
            "mm" => 1000.0,
            _ => 1.0,
        };
        let degrees = map.required("angle")?.word(&["rad", "deg"])? == "deg";
        Ok(Self { per_metre, degrees })
    }

    /// In metres: divided, so that 25 cm is the number nearest to a quarter.
    pub(super) fn length(self, number: f64) -> f64 {
        number / self.per_metre
    }

    /// In radians, or radians per second to some power.
    pub(super) fn angle(self, number: f64) -> f64 {
        if self.degrees { number.to_radians() } else { number }
    }
}
