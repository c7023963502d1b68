use super::{Quantity, Verdict, VerifySettings, verify_until};
use crate::scene::Scene;
use crate::trajectory::{Motion, Piece};

/// A motion that is proved to be safe in its scene. There is no other way to make one than to have it judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    motion: Motion,
    verdict: Verdict,
}

impl Trajectory {
    /// `motion`, if it is safe in `scene`; whatever the settings say, its acceleration must not jump.
    ///
    /// # Errors
    /// The verdict, if it is not proved to be safe.
    pub fn certify(scene: &Scene, motion: Motion, settings: &VerifySettings) -> Result<Self, Box<Verdict>> {
        Self::certify_until(scene, motion, settings, &|| true)
    }

    /// The same, given up when `keep_going` says so.
    ///
    /// # Errors
    /// The verdict, if it is not proved to be safe, be it for want of time.
    pub fn certify_until(
        scene: &Scene,
        motion: Motion,
        settings: &VerifySettings,
        keep_going: &dyn Fn() -> bool,
    ) -> Result<Self, Box<Verdict>> {
        let settings = VerifySettings { continuous: Quantity::Acceleration, ..*settings };
        let verdict = verify_until(scene, &motion, &settings, keep_going);
        if verdict.is_safe() { Ok(Self { motion, verdict }) } else { Err(Box::new(verdict)) }
    }

    /// The polynomials.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// What the verifier found, with no violation in it.
    pub fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// The first part of it, up to `end` (s), which is as safe as the whole; the verdict stays that of the whole, times and
    /// margins too. The arm need not be at rest at its end. `None` if that is the start or earlier.
    #[must_use]
    pub fn before(self, end: f64) -> Option<Self> {
        // Pieces that end by then stay as they are, to the last bit.
        let pieces: Vec<Piece> =
            self.motion.pieces().iter().filter(|piece| piece.start < end).cloned().collect();
        let motion = if pieces.iter().all(|piece| piece.start + piece.duration <= end) {
            Motion::new(pieces).ok()?
        } else {
            self.motion.before(end)?
        };
        Some(Self { motion, ..self })
    }

    /// The polynomials, out of the verifier's hands.
    pub fn into_motion(self) -> Motion {
        self.motion
    }
}
