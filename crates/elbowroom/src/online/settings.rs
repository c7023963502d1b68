//! The numbers by which the replanner weighs what to do: found by trying on random episodes, kept in one place.

/// How long the end of a motion has to stay clear of obstacles whose course is known for the motion to be safe (s).
pub(super) const HOLD: f64 = 8.0;

/// How far ahead is looked where the arm ends elsewhere than at a goal (s): staying clear so long is as good as for ever.
pub(super) const LOOK_AHEAD: f64 = 25.0;

/// How far the arm may be off (rad, rad/s, rad/s²) from where its motion has it before the motion counts as lost, and from
/// rest at a goal to count as there.
pub(super) const ASTRAY: f64 = 1e-6;

/// Rates below this are none (rad/s, rad/s²): from such a state a motion begins as if from rest.
pub(super) const STANDS: f64 = 1e-9;

/// Updates between two samples for a motion that is better than the safe one that runs.
pub(super) const LOOK_EVERY: u64 = 10;

/// Looks for which it stands that the arm would be caught at a goal, or would not, while the same is known to come there: the search for
/// a way out is the longest there is.
pub(super) const LOOKS_PER_TRAP: u64 = 10;

/// How long the arm may wait before it goes to the goal (s), tried one after the other.
pub(super) const WAITS: [f64; 10] = [0.0, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.5, 6.5];

/// How much earlier (s) another motion has to arrive to be preferred to the one that runs.
pub(super) const WORTH_CHANGING: f64 = 0.25;

/// How long the arm follows a motion that is not safe to its end before it brakes (s), tried one after the other.
pub(super) const STRETCHES: [f64; 4] = [1.2, 0.6, 0.3, 0.1];

/// How far a motion may stray from a path before the verifier is asked, in grid steps.
pub(super) const TOLERANCE: f64 = 1.0;

/// By what share less it may in the next round of following the path more closely, and how many rounds there are.
pub(super) const TIGHTER: f64 = 0.3;
pub(super) const ROUNDS: usize = 3;

/// Random ways out of the way that are tried to find the best, and as long as none is safe.
pub(super) const TRIES: usize = 60;
pub(super) const MOST_TRIES: usize = 300;

/// How far the first random place may be away in each joint (rad), and how much farther the last.
pub(super) const NEAREST_TRY: f64 = 0.2;
pub(super) const FARTHER_TRIES: f64 = 2.8;

/// How long the arm waits at a rest on its way out of the way (s), at most.
pub(super) const LONGEST_WAIT: f64 = 4.0;

/// How much longer (s) another place has to be safe for the arm to go there.
pub(super) const WORTH_LEAVING: f64 = 1.0;

/// How to search for a way out in space and time.
pub(super) struct Attempt {
    /// The clearance that is kept (m), for what the motion will be off the way.
    pub(super) clearance: f64,
    /// Between places that may be gone to (rad).
    pub(super) lattice: f64,
    /// Between control points of the motion (s): a motion with more time between them is faster, and farther off.
    pub(super) control: f64,
    /// How much of what acceleration and jerk allow the way uses: one that turns back at once needs less than half.
    pub(super) vigour: f64,
}

/// Quick ones first.
pub(super) const ATTEMPTS: [Attempt; 5] = [
    Attempt { clearance: 0.02, lattice: 0.1, control: 0.2, vigour: 0.95 },
    Attempt { clearance: 0.01, lattice: 0.1, control: 0.4, vigour: 0.5 },
    Attempt { clearance: 0.004, lattice: 0.05, control: 0.2, vigour: 0.95 },
    Attempt { clearance: 0.001, lattice: 0.03, control: 0.2, vigour: 0.5 },
    Attempt { clearance: 0.0005, lattice: 0.03, control: 0.4, vigour: 0.5 },
];

/// How near to its maximum speed a joint is taken on such a way.
pub(super) const PACE: f64 = 0.9;

/// Expansions after which such a search ends with what it has.
pub(super) const MOST_EXPANSIONS: usize = 20_000;

/// Shortest step in time of such a search (s): a touch that is over sooner may be passed over. What is planned with it is
/// verified in any case.
pub(super) const SHORTEST: f64 = 0.02;
