use crate::arm::{Arm, Configuration, lerp};

/// Places of a path whose straight joint turns keep all ends of links within `tolerance` (m) of every place left
/// out; the ends are always among them.
///
/// # Reference
/// Douglas and Peucker, *Algorithms for the reduction of the number of points*, Cartographica 10(2), 1973,
/// with the arm's own distance in place of the plane's.
pub fn simplify<Q: AsRef<[f64]>>(arm: &Arm, places: &[Q], tolerance: f64) -> Vec<usize> {
    let mut kept = vec![false; places.len()];
    let mut stretches = Vec::new();
    if let Some(last) = places.len().checked_sub(1) {
        kept[0] = true;
        kept[last] = true;
        stretches.push((0, last));
    }
    while let Some((from, to)) = stretches.pop() {
        let far = (from + 1..to)
            .map(|i| (i, deviation(arm, places[from].as_ref(), places[to].as_ref(), places[i].as_ref())))
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

/// How far ends of links at `q` are from where the straight joint motion from `from` to `to` has them when it is
/// nearest to `q` in configuration space (m).
fn deviation(arm: &Arm, from: &[f64], to: &[f64], q: &[f64]) -> f64 {
    let (mut along, mut squared) = (0.0, 0.0);
    for ((from, to), q) in from.iter().zip(to).zip(q) {
        along += (q - from) * (to - from);
        squared += (to - from) * (to - from);
    }
    let fraction = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
    let near: Configuration = lerp(from, to, fraction);
    let pairs = arm.link_ends(&near).zip(arm.link_ends(q));
    pairs.map(|(near, there)| near.distance(there)).fold(0.0, f64::max)
}
