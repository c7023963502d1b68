//! How soon one joint can be where it is to be.

use super::SpeedLimits;

/// The acceleration of a joint where its velocity is zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// None: it stays there.
    Rest,
    /// Any within the limit: it turns back, or goes on.
    Turn,
}

/// The least time (s) in which a joint gets `distance` (rad) ahead from zero velocity to zero velocity, under `limits`, any of
/// which may be infinite. From rest to rest it is the double-S motion's.
///
/// # Proof
/// Let *p* be the greatest velocity on the way, *w* = *p* - *v* what is missing, and *s* the time to that instant, or since. There *w* = 0 and
/// *w'* = 0, and *w* is nowhere negative: under a limit *j* of |*w''*| that leaves *w'*² <= 2 *j w* (else *w* would be negative before), and
/// |*w'*| <= *a*. So up to the stop, where *w* = *p*, at least the integral of *w dw* / min(*a*, √(2 *j w*)) is missing of the distance
/// that *p* would have covered. Where the stop is a rest, *w'* = 0 there, and for the same reason *w'*² <= 2 *j* (*p* - *w*) as well; or the
/// joint has gone back before, arriving at *w* = *p* with some *w'* = *b* > 0: that saves *p b* / *j* at the most and costs more, *b* / *j* to
/// turn, when more than *p* is missing. With equality this is jerk *j*, then acceleration *a*, then jerk -*j* until *p* is reached: the
/// fastest ramp. Let it take *t*(*p*) and miss *m*(*p*). Then the distance is at most *p T* - *m*(*p*) - *m*(*p*), one for each end, where *T* >= *t*(*p*) + *t*(*p*);
/// it grows with *p* (*m'* <= *t*), so that the most is covered with the greatest *p* that the velocity limit and *T* allow.
pub fn least_time(distance: f64, limits: &SpeedLimits, stops: [Stop; 2]) -> f64 {
    if distance <= 0.0 {
        return 0.0;
    }
    let ramps = |peak: f64| {
        let [one, other] = stops.map(|stop| Ramp::new(stop, peak, limits));
        Ramp {
            time: one.time + other.time,
            distance: one.distance + other.distance,
            slope: one.slope + other.slope,
        }
    };
    if limits.velocity.is_finite() {
        let most = ramps(limits.velocity);
        if distance >= most.distance {
            return most.time + (distance - most.distance) / limits.velocity;
        }
    }
    // With acceleration or jerk alone limited the ramps would be shorter: peaks that are too great, from which Newton's method
    // falls to the root, for the distance is convex.
    let shares = stops.map(|stop| if stop == Stop::Rest { 1.0 } else { TURN_SHARE });
    let scaled = distance / (shares[0] + shares[1]);
    let mut peak = libm::cbrt(scaled * scaled * limits.jerk)
        .min((distance * limits.acceleration).sqrt())
        .min(limits.velocity);
    if !(peak > 0.0 && peak.is_finite()) {
        return 0.0;
    }
    for _ in 0..MOST_STEPS {
        let reached = ramps(peak);
        let next = peak - (reached.distance - distance) / reached.slope;
        if !(next < peak && next > 0.0) {
            break;
        }
        peak = next;
    }
    ramps(peak).time
}

/// The least time (s) in which a joint at rest gets `distance` (rad) ahead, however fast it is there.
///
/// # Proof
/// Its velocity after *t* is at most *r*(*t*), the fastest start: jerk, then acceleration, then velocity at the limit. The distance is at
/// most the integral.
pub fn least_time_of_start(distance: f64, limits: &SpeedLimits) -> f64 {
    if distance <= 0.0 {
        return 0.0;
    }
    let &SpeedLimits { velocity, acceleration, jerk } = limits;
    if jerk.is_infinite() && acceleration.is_infinite() {
        return distance / velocity;
    }
    // Until the acceleration, or the velocity before it, is at its limit.
    let (by_jerk, round) = if jerk.is_infinite() {
        (0.0, 0.0)
    } else {
        let time = (acceleration / jerk).min((2.0 * velocity / jerk).sqrt());
        (time, jerk * time * time * time / 6.0)
    };
    if distance < round {
        return libm::cbrt(6.0 * distance / jerk);
    }
    let speed = if by_jerk > 0.0 { jerk * by_jerk * by_jerk / 2.0 } else { 0.0 };
    let left = distance - round;
    if acceleration.is_infinite() || speed >= velocity {
        return by_jerk + left / velocity;
    }
    // With a steady acceleration until the velocity is at its limit.
    let until = (velocity - speed) / acceleration;
    let covered = speed * until + acceleration * until * until / 2.0;
    if left <= covered || until.is_infinite() {
        return by_jerk + 2.0 * left / (speed + (speed * speed + 2.0 * acceleration * left).sqrt());
    }
    by_jerk + until + (left - covered) / velocity
}

/// Distance of a ramp from a turn, as a share of that from rest, where only jerk is limited: 2 √2 / 3.
const TURN_SHARE: f64 = 0.942_809_041_582_063_3;

/// Newton's method falls to the root in less than ten.
const MOST_STEPS: usize = 64;

/// The fastest ramp from zero velocity to the peak.
struct Ramp {
    /// How long it takes (s).
    time: f64,
    /// How far it gets (rad).
    distance: f64,
    /// How much farther with a greater peak (s).
    slope: f64,
}

impl Ramp {
    fn new(stop: Stop, peak: f64, limits: &SpeedLimits) -> Self {
        let &SpeedLimits { acceleration, jerk, .. } = limits;
        if acceleration.is_infinite() && jerk.is_infinite() {
            return Self { time: 0.0, distance: 0.0, slope: 0.0 };
        }
        // How long the acceleration takes to get to its limit, and the velocity that this brings.
        let rise = if jerk.is_infinite() { 0.0 } else { acceleration / jerk };
        let gained = acceleration * rise;
        match stop {
            Stop::Rest if peak >= gained => {
                let time = peak / acceleration + rise;
                Self { time, distance: peak * time / 2.0, slope: peak / acceleration + rise / 2.0 }
            }
            Stop::Rest => {
                let time = 2.0 * (peak / jerk).sqrt();
                Self { time, distance: peak * time / 2.0, slope: 0.75 * time }
            }
            Stop::Turn if peak >= gained / 2.0 => {
                let steady = peak / acceleration - rise / 2.0;
                let distance = acceleration * (steady * steady / 2.0 - rise * rise / 6.0) + peak * rise;
                Self { time: steady + rise, distance, slope: steady + rise }
            }
            Stop::Turn => {
                let time = (2.0 * peak / jerk).sqrt();
                Self { time, distance: peak * time / 1.5, slope: time }
            }
        }
    }
}
