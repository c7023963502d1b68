use super::Quantity;

/// Clearance that a safe motion has more of, whatever the margin (m).
pub const FLOOR: f64 = 1e-9;

/// What to ask of a motion, and how much work to put in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerifySettings {
    /// Clearance that a safe motion has more of (m); below [`FLOOR`] it counts as [`FLOOR`].
    pub margin: f64,
    /// Configurations examined per piece and pair of a link and what it must not touch before the pair is left undecided;
    /// half of them may go into the accuracy of the least clearance.
    pub evaluations: u32,
    /// What must not jump where pieces meet, all before it included. Jumps beyond it count only against joints with
    /// a limit on the next rate.
    pub continuous: Quantity,
    /// What is asked of the start and of the end of the motion.
    pub ends: [End; 2],
}

/// What is asked of a motion where it begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Nothing: the arm may be moving there.
    Open,
    /// That the arm is at rest beyond it. Up to this quantity nothing may jump from there to rest; a jump beyond it counts
    /// only against joints with a limit on the next rate.
    AtRest(Quantity),
}

impl Default for VerifySettings {
    /// No margin, open ends. A link that moves by 1 m and stays within 0.1 mm of an obstacle all along is still decided.
    fn default() -> Self {
        Self { margin: 0.0, evaluations: 1 << 17, continuous: Quantity::Acceleration, ends: [End::Open; 2] }
    }
}
