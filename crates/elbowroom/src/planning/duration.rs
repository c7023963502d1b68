/// The longest that a motion may be asked to take (s): eleven days. Beyond it samples of it fill the memory.
pub const LONGEST_DURATION: f64 = 1e6;

/// The shortest (s): a microsecond. Below it accelerations and jerks lose their digits.
pub const SHORTEST_DURATION: f64 = 1e-6;

/// Whether a motion may be asked to take this long (s).
pub(crate) fn is_duration(duration: f64) -> bool {
    (SHORTEST_DURATION..=LONGEST_DURATION).contains(&duration)
}
