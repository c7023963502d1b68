//! Which of many paths are worth being made into motions.

use crate::path::{JointPath, can_be_deformed};
use crate::scene::Scene;

/// `own`, and of `paths` the first that cannot be pulled over to one before them; where these are fewer than `most` in all, also the
/// first of `drawn` and of the other paths. `None` where `keep_going` said no.
pub(crate) fn shortlist(
    scene: &Scene,
    own: JointPath,
    paths: Vec<JointPath>,
    drawn: Vec<JointPath>,
    most: usize,
    keep_going: &dyn Fn() -> bool,
) -> Option<Vec<JointPath>> {
    let mut chosen = vec![own];
    let mut others = drawn;
    for path in paths {
        if !keep_going() {
            return None;
        }
        if chosen.len() >= most {
            break;
        }
        if chosen.iter().any(|known| can_be_deformed(scene, known, &path)) {
            others.push(path);
        } else {
            chosen.push(path);
        }
    }
    others.retain(|path| !chosen.contains(path));
    others.truncate(most - chosen.len());
    chosen.extend(others);
    Some(chosen)
}
