use super::{Quantity, Verdict, VerifySettings, verify_until};
use crate::arm::Arm;
use crate::scene::Scene;
use crate::trajectory::Motion;

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
    pub fn certify<A: Arm>(
        scene: &Scene<A>,
        motion: Motion,
        settings: &VerifySettings,
    ) -> Result<Self, Box<Verdict>> {
        Self::certify_until(scene, motion, settings, &|| true)
    }

    /// The same, given up when `keep_going` says so.
    ///
    /// # Errors
    /// The verdict, if it is not proved to be safe, be it for want of time.
    pub fn certify_until<A: Arm>(
        scene: &Scene<A>,
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

    /// The polynomials, out of the verifier's hands.
    pub fn into_motion(self) -> Motion {
        self.motion
    }
}
