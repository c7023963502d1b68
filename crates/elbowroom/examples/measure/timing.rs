use elbowroom::planning::ASSUMED_LIMITS;
use elbowroom::trajectory::{Motion, fastest_durations, quintic_through, vias_at};
use elbowroom::verify::{Trajectory, VerifySettings};
use serde_json::json;

use super::{Outcome, runs, scenes};

/// Quintic pieces through given configurations as fast as the limits allow, and the verdict on them.
pub(crate) fn measure(file: &str, vias: &str, runs: usize) -> Outcome {
    let scene = scenes::load(file, 101)?;
    let places: Vec<[f64; 2]> = serde_json::from_str(&std::fs::read_to_string(vias)?)?;
    let timed = || {
        let vias = vias_at(&places);
        Motion::new(quintic_through(&vias, &fastest_durations(&vias, &[ASSUMED_LIMITS; 2])))
    };
    let (times, motion) = runs::times(runs, timed);
    let duration = motion?.duration();
    let (verified, trajectory) = runs::times(runs, || {
        Ok::<_, elbowroom::trajectory::MotionError>(
            Trajectory::certify(&scene, timed()?, &VerifySettings::default()).is_ok(),
        )
    });
    Ok(json!({
        "times_ms": times, "verified_ms": verified, "duration": duration, "safe": trajectory?,
        "limits": [ASSUMED_LIMITS.velocity, ASSUMED_LIMITS.acceleration, ASSUMED_LIMITS.jerk],
    }))
}
