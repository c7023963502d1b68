//! Between configurations of any arm and the pairs of angles (rad) that closed forms of two links work on.

use super::JointPath;
use crate::arm::Configuration;

/// `configurations` as pairs; none of an arm of more than two links.
pub(crate) fn pairs(configurations: &[Configuration]) -> Vec<[f64; 2]> {
    configurations.iter().filter_map(|q| <[f64; 2]>::try_from(&**q).ok()).collect()
}

/// The path through `pairs`.
pub(crate) fn joint_path(pairs: &[[f64; 2]]) -> JointPath {
    JointPath(pairs.iter().map(|&q| Configuration::from(q)).collect())
}
