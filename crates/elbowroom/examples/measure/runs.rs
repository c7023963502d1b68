use std::hint::black_box;
use std::time::Instant;

/// Work that takes longer needs no warm-up (s).
const LONG: f64 = 1.0;

/// Does `work` `runs` times; returns how long each took (ms) and the last answer. Short work is warmed up first. No two
/// answers are held at a time, so that the most memory held is that of the work.
pub(crate) fn times<T>(runs: usize, mut work: impl FnMut() -> T) -> (Vec<f64>, T) {
    let mut once = || {
        let begun = Instant::now();
        let answer = black_box(work());
        (begun.elapsed().as_secs_f64() * 1e3, answer)
    };
    let (first, mut answer) = once();
    let mut spent = Vec::with_capacity(runs);
    if first > LONG * 1e3 {
        spent.push(first);
    }
    while spent.len() < runs {
        drop(answer);
        let (time, last) = once();
        spent.push(time);
        answer = last;
    }
    (spent, answer)
}
