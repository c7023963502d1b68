//! From a motion to the best one near it: shape and timing together, under limits of velocity, acceleration and jerk.
//!
//! A motion is a uniform cubic B-spline from rest to rest, so that its jerk is constant between knots and every limit is a bound on
//! differences of control points. Clearances, the tip's way and the powers of the step are linearised about the last iterate: each
//! step of the search is a convex program over control points and step (sequential convex programming), linear, with second-order
//! cones where a length counts, quadratic where jerk does, solved by an interior-point method. From the control points the least
//! step that keeps all limits follows in closed form, so that every iterate keeps them exactly; contact is left to the verifier,
//! whose complaints become places that are sampled from then on.
//!
//! # Reference
//! Sequential convex programming with signed distances: Schulman et al., *Motion planning with sequential convex optimization and
//! convex collision checking*, IJRR 2014. B-splines for jerk-limited motions: De Boor, *A practical guide to splines*.

mod control_points;
mod length;
mod program;
mod refine;
mod signed_distance;

pub(crate) use length::Length;
pub(crate) use refine::{Constraints, Goal, improved};
