/// A rate of change of a joint's position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Rate {
    /// In rad/s.
    Velocity,
    /// In rad/s².
    Acceleration,
    /// In rad/s³.
    Jerk,
}

/// What must not jump where two pieces meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// In rad.
    Position,
    /// In rad/s.
    Velocity,
    /// In rad/s².
    Acceleration,
}

impl Rate {
    /// The word for it, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Jerk => "jerk",
        }
    }

    /// Which derivative of the position it is.
    pub const fn order(self) -> usize {
        match self {
            Self::Velocity => 1,
            Self::Acceleration => 2,
            Self::Jerk => 3,
        }
    }
}

impl Quantity {
    /// The word for it, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
        }
    }

    /// The word for several.
    pub(super) const fn plural(self) -> &'static str {
        match self {
            Self::Position => "positions",
            Self::Velocity => "velocities",
            Self::Acceleration => "accelerations",
        }
    }

    /// Which derivative of the position it is.
    pub const fn order(self) -> usize {
        match self {
            Self::Position => 0,
            Self::Velocity => 1,
            Self::Acceleration => 2,
        }
    }
}
