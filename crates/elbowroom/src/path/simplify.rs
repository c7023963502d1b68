use super::JointPath;
use crate::arm::{Configuration, TwoLinkArm};

/// Places of `path` whose straight joint turns keep elbow and tip within `tolerance` (m) of every place left
/// out; the ends are always among them.
///
/// # Reference
/// Douglas and Peucker, *Algorithms for the reduction of the number of points*, Cartographica 10(2), 1973,
/// with the arm's own distance in place of the plane's.
pub fn simplify(arm: &TwoLinkArm, path: &JointPath, tolerance: f64) -> Vec<usize> {
    let places = &path.0;
    let mut kept = vec![false; places.len()];
    let mut stretches = Vec::new();
    if let Some(last) = places.len().checked_sub(1) {
        kept[0] = true;
        kept[last] = true;
        stretches.push((0, last));
    }
    while let Some((from, to)) = stretches.pop() {
        let far = (from + 1..to)
            .map(|i| (i, deviation(arm, &places[from], &places[to], &places[i])))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((i, deviation)) = far
            && deviation > tolerance
        {
            kept[i] = true;
            stretches.push((from, i));
            stretches.push((i, to));
        }
    }
    (0..places.len()).filter(|&i| kept[i]).collect()
}

/// How far elbow or tip at `q` are from where the straight turn from `from` to `to` has them when it is
/// nearest to `q` in configuration space (m).
fn deviation(arm: &TwoLinkArm, from: &Configuration<2>, to: &Configuration<2>, q: &Configuration<2>) -> f64 {
    let along = [to.0[0] - from.0[0], to.0[1] - from.0[1]];
    let squared = along[0] * along[0] + along[1] * along[1];
    let fraction = if squared > 0.0 {
        (((q.0[0] - from.0[0]) * along[0] + (q.0[1] - from.0[1]) * along[1]) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let near = from.lerp(to, fraction);
    arm.elbow(&near).distance(arm.elbow(q)).max(arm.tip(&near).distance(arm.tip(q)))
}
