use std::f64::consts::{PI, TAU};

/// The same direction as `angle`, in (-π, π].
pub fn wrap_angle(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let turned = angle - TAU * libm::round(angle / TAU);
    if turned <= -PI { turned + TAU } else { turned }
}

/// The shorter direction from `from` to `to`, in (-π, π].
pub fn angle_difference(from: f64, to: f64) -> f64 {
    wrap_angle(to - from)
}
