//! Motion over time: polynomial pieces per joint.

mod b_spline;
mod brake;
mod departure;
mod interpolate;
mod least_time;
mod length;
mod motion;
mod peak;
mod piece;
mod quartic;
mod spline;
mod timing;
mod via;

pub(crate) use b_spline::{spline_along, spline_of, third_point};
pub use brake::brake;
pub use departure::departing;
pub use interpolate::{Curve, Interpolated, MAX_ROWS, Samples, SamplesError, interpolate};
pub use least_time::{Stop, least_time, least_time_of_start};
pub use motion::{Motion, MotionError};
pub(crate) use piece::quintic;
pub use piece::{Piece, State};
pub use quartic::quartic;
pub use spline::{Via, durations_by_length, quintic_through, vias_at};
pub use timing::{SpeedLimits, TICK, fastest_durations, rescaled, stretch};
pub use via::random_vias;
