use crate::trajectory::Motion;
use crate::verify::{Trajectory, Verdict};

/// What the arm is to do.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Decision {
    /// Go on: the motion that runs is still the best that is known.
    Keep,
    /// Run this from now on; it takes over where the arm is, without a jump. It is certified in the scene as it is known.
    New(Trajectory),
    /// Come to rest on this motion: nothing that is proved to be safe was found in time, and why this one is not stands in
    /// the verdict.
    Stop(Motion),
}

/// What an update came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Update {
    /// What the arm is to do.
    pub decision: Decision,
    /// Whether the motion that now runs ends at a goal.
    pub reaches_goal: bool,
    /// What the verifier says of what is left of it, until it has come to rest and, among obstacles whose course is
    /// known, for eight seconds more. Not safe only where nothing safe was found, braking included.
    pub verdict: Verdict,
}
