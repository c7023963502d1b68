/// The longest that a motion may be asked to take (s): eleven days. Beyond it samples of it fill the memory.
pub const LONGEST_DURATION: f64 = 1e6;

/// Whether a motion may be asked to take this long (s).
pub(crate) fn is_duration(duration: f64) -> bool {
    duration > 0.0 && duration <= LONGEST_DURATION
}
