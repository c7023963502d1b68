/// The polynomial of degree four, the constant first, from position, velocity and acceleration to position and velocity
/// over a duration (s), and the acceleration it ends with, which is left to it.
pub fn quartic([q0, v0, a0]: [f64; 3], [q1, v1]: [f64; 2], duration: f64) -> ([f64; 6], f64) {
    let t = duration;
    // What is left for the two highest terms to bring about, divided by t step by step: t⁴ would underflow early.
    let position = (q1 - q0 - v0 * t) / t / t - 0.5 * a0;
    let velocity = (v1 - v0) / t - a0;
    let c3 = (4.0 * position - velocity) / t;
    let c4 = (velocity - 3.0 * position) / t / t;
    ([q0, v0, a0 / 2.0, c3, c4, 0.0], a0 + 6.0 * velocity - 12.0 * position)
}
