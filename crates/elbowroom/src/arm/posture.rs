use crate::geometry::wrap_angle;

/// On which side of the ray from base to tip the elbow lies.
///
/// The mapping, stated once for the whole project: the paper's "negative sign" of eqs (3) and (4) gives
/// the negative second joint, which is [`Posture::ElbowUp`] here, whatever the paper calls it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Posture {
    /// The elbow lies left of the ray from base to tip: the second joint is negative.
    ElbowUp,
    /// The elbow lies right of the ray: the second joint is positive.
    ElbowDown,
}

impl Posture {
    /// Both postures, elbow-up first.
    pub const ALL: [Self; 2] = [Self::ElbowUp, Self::ElbowDown];

    /// 0 for elbow-up, 1 for elbow-down: the place in arrays kept per posture.
    pub const fn index(self) -> usize {
        match self {
            Self::ElbowUp => 0,
            Self::ElbowDown => 1,
        }
    }

    /// The posture of `q`, or `None` where both meet: links in one line, stretched or folded.
    pub fn of(q: &[f64; 2]) -> Option<Self> {
        let bend = wrap_angle(q[1]);
        if bend == 0.0 || bend == std::f64::consts::PI {
            None
        } else if bend < 0.0 {
            Some(Self::ElbowUp)
        } else {
            Some(Self::ElbowDown)
        }
    }

    /// The posture at `q`, a position per joint; `None` where both meet, and for arms of more links, which have no two.
    pub fn at(q: &[f64]) -> Option<Self> {
        Self::of(<&[f64; 2]>::try_from(q).ok()?)
    }

    /// The word for it in files and on the command line: `elbow-up` or `elbow-down`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ElbowUp => "elbow-up",
            Self::ElbowDown => "elbow-down",
        }
    }
}
