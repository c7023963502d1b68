//! Room that is kept between the arm and what it must not touch.

use super::Scene;
use crate::arm::Arm;

impl Scene {
    /// The scene in which the arm touches something where in this one it comes as near to it as `clearance` (m): links and obstacles
    /// are thicker by half of it each, so that it is kept between links as well. `None` where there is no such scene, as the
    /// clearance is no number of 0 or greater, or more than the arm or an obstacle can be thickened by.
    pub fn with_clearance(&self, clearance: f64) -> Option<Self> {
        let half = clearance / 2.0;
        let arm = self.arm();
        let arm = Arm::new(
            arm.base(),
            arm.lengths().to_vec(),
            arm.half_width() + half,
            arm.joints().to_vec(),
            arm.self_collision(),
        );
        let mut obstacles = self.obstacles().to_vec();
        for obstacle in &mut obstacles {
            obstacle.shape = obstacle.shape.grown(half)?;
        }
        self.with_obstacles(obstacles).ok()?.with_arm(arm.ok()?).ok()
    }
}
