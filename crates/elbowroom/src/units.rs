//! The units that people write and read lengths and angles in, and how many digits of a number they are told. The core
//! itself counts in metres and radians.

/// What a scene file calls its units; metres and radians where nobody says otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Units {
    /// Of lengths.
    pub length: LengthUnit,
    /// Of angles.
    pub angle: AngleUnit,
}

/// What is told in the units of whoever reads it; where nobody says which, [`Display`](std::fmt::Display) tells it in metres and
/// radians.
pub trait Told {
    /// The text.
    fn told(&self, units: Units) -> String;
}

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum LengthUnit {
    /// m
    #[default]
    Metre,
    /// cm
    Centimetre,
    /// mm
    Millimetre,
}

/// A unit of angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum AngleUnit {
    /// rad
    #[default]
    Radian,
    /// deg
    Degree,
}

impl LengthUnit {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Metre, Self::Centimetre, Self::Millimetre];

    /// What it is called in files and texts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
        }
    }

    /// How many make a metre.
    pub const fn per_metre(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 100.0,
            Self::Millimetre => 1000.0,
        }
    }
}

impl AngleUnit {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Radian, Self::Degree];

    /// What it is called in files and texts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Radian => "rad",
            Self::Degree => "deg",
        }
    }
}

impl Units {
    /// Metres and radians.
    pub const SI: Self = Self { length: LengthUnit::Metre, angle: AngleUnit::Radian };

    /// A length of a file in metres: divided, so that 25 cm is the number nearest to a quarter.
    pub fn metres(self, number: f64) -> f64 {
        number / self.length.per_metre()
    }

    /// An angle of a file in radians, or radians per second to some power.
    pub fn radians(self, number: f64) -> f64 {
        match self.angle {
            AngleUnit::Radian => number,
            AngleUnit::Degree => number.to_radians(),
        }
    }

    /// Metres in the unit of lengths.
    pub fn of_metres(self, metres: f64) -> f64 {
        metres * self.length.per_metre()
    }

    /// Radians in the unit of angles, or their rates.
    pub fn of_radians(self, radians: f64) -> f64 {
        match self.angle {
            AngleUnit::Radian => radians,
            AngleUnit::Degree => radians.to_degrees(),
        }
    }

    /// A length that was measured (m): `40.0 mm`.
    pub fn length(self, metres: f64) -> String {
        format!("{} {}", measured(self.of_metres(metres)), self.length.name())
    }

    /// An angle that was measured (rad): `5.06 deg`.
    pub fn angle(self, radians: f64) -> String {
        format!("{} {}", measured(self.of_radians(radians)), self.angle.name())
    }

    /// A rate of an angle that was measured, its `order` as in [`rate_name`](Self::rate_name): `916 deg/s`.
    pub fn rate(self, value: f64, order: usize) -> String {
        format!("{} {}", measured(self.of_radians(value)), self.rate_name(order))
    }

    /// A length that somebody stated (m): `122.5 mm`.
    pub fn stated_length(self, metres: f64) -> String {
        format!("{} {}", stated(self.of_metres(metres)), self.length.name())
    }

    /// An angle that somebody stated (rad): `145 deg`.
    pub fn stated_angle(self, radians: f64) -> String {
        format!("{} {}", stated(self.of_radians(radians)), self.angle.name())
    }

    /// A place (m): `(450 mm, -122.5 mm)`.
    pub fn place(self, x: f64, y: f64) -> String {
        format!("({}, {})", self.stated_length(x), self.stated_length(y))
    }

    /// The unit of the rate of an angle: its `order` is 0 for the angle itself, 1 for velocity, 2 for acceleration, 3 for jerk.
    pub fn rate_name(self, order: usize) -> String {
        let per = ["", "/s", "/s²", "/s³"].get(order).copied().unwrap_or_default();
        format!("{}{per}", self.angle.name())
    }

    /// An angle or one of its rates, and the limit that it breaks, so that they can be told apart.
    pub fn beside_limit(self, value: f64, limit: f64, order: usize) -> [String; 2] {
        let told = apart(self.of_radians(value), self.of_radians(limit));
        told.map(|number| format!("{number} {}", self.rate_name(order)))
    }
}

/// A number that was measured, to three digits that count: `40.0`, `0.0388`, `30237`.
pub fn measured(number: f64) -> String {
    digits(number, 3)
}

/// A number that somebody stated: six digits that count, no zeros after them: `550`, `122.5`.
pub fn stated(number: f64) -> String {
    bare(digits(number, 6))
}

/// A number in short: four digits that count, no zeros after them.
pub fn short(number: f64) -> String {
    bare(digits(number, 4))
}

/// A time in a motion (s): to the millisecond.
pub fn seconds(time: f64) -> String {
    format!("{time:.3} s")
}

/// Two numbers to as many digits as it takes to tell them apart, four or more.
pub fn apart(a: f64, b: f64) -> [String; 2] {
    let told = |count| [a, b].map(|number| bare(digits(number, count)));
    let differ = |told: &[String; 2]| told[0] != told[1] || a == b;
    (4..17).map(told).find(differ).unwrap_or_else(|| told(17))
}

/// `number` to `count` digits that count; digits before the point are never rounded away.
fn digits(number: f64, count: usize) -> String {
    if number == 0.0 || !number.is_finite() {
        // -0 is 0.
        return (number + 0.0).to_string();
    }
    let count = count.max(1);
    let power = format!("{number:.*e}", count - 1);
    let exponent: i32 = power.rsplit('e').next().and_then(|text| text.parse().ok()).unwrap_or_default();
    if !(-5..15).contains(&exponent) {
        return power;
    }
    let places = (count as i32 - 1 - exponent).max(0) as usize;
    format!("{number:.places$}")
}

/// Without zeros at the end of what is behind the point.
fn bare(text: String) -> String {
    if !text.contains('.') || text.contains('e') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_mean_something() {
        let cases = [
            (40.000_000_802, "40.0"),
            (0.038_827_853_841, "0.0388"),
            (916.2, "916"),
            (30_237.4, "30237"),
            (0.999_6, "1.00"),
            (-0.0, "0"),
            (1e-9, "1.00e-9"),
            (0.000_05, "0.0000500"),
            (f64::INFINITY, "inf"),
        ];
        for (number, told) in cases {
            assert_eq!(measured(number), told);
        }
        for (number, told) in
            [(0.1 + 0.2, "0.3"), (550.000_000_000_1, "550"), (122.5, "122.5"), (1e6, "1000000")]
        {
            assert_eq!(stated(number), told);
        }
    }

    #[test]
    fn texts_are_in_the_units_asked_for() {
        let units = Units { length: LengthUnit::Millimetre, angle: AngleUnit::Degree };
        assert_eq!(units.length(0.040_000_000_802), "40.0 mm");
        assert_eq!(units.stated_angle(145_f64.to_radians()), "145 deg");
        assert_eq!(units.place(0.45, -0.1225), "(450 mm, -122.5 mm)");
        assert_eq!(Units::SI.length(0.04), "0.0400 m");
        assert_eq!(seconds(0.038_827), "0.039 s");
    }

    #[test]
    fn what_breaks_a_limit_can_be_told_from_it() {
        assert_eq!(apart(90.000_03, 90.0), ["90.00003", "90"]);
        assert_eq!(apart(916.2, 90.0), ["916.2", "90"]);
        assert_eq!(apart(90.0, 90.0), ["90", "90"]);
        let [value, limit] = Units::SI.beside_limit(16.084, 12.57, 3);
        assert_eq!((&*value, &*limit), ("16.08 rad/s³", "12.57 rad/s³"));
    }
}
