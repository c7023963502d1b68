//! What planners of arms with any number of links share.

mod contact;
mod ledger;

pub(in crate::planners) use contact::violation;
pub(in crate::planners) use ledger::{Halt, Ledger};
