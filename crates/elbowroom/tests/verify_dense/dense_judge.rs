//! The judge: geometry of its own at very many instants.

use super::*;

pub(crate) struct DenseJudge {
    pub(crate) base: P,
    pub(crate) lengths: [f64; 2],
    pub(crate) half_width: f64,
    pub(crate) shapes: Vec<JudgeShape>,
}

pub(crate) const SAMPLES: usize = 20_000;

pub(crate) fn sample_time(motion: &Motion, i: usize) -> f64 {
    motion.start() + motion.duration() * i as f64 / SAMPLES as f64
}

impl DenseJudge {
    pub(crate) fn new(scene: &Scene) -> Self {
        let shapes = scene.obstacles().iter().map(|obstacle| match obstacle.shape.vertices() {
            [center] => JudgeShape::Disc([center.x, center.y], obstacle.shape.radius()),
            core => JudgeShape::Polygon(core.iter().map(|v| [v.x, v.y]).collect(), obstacle.shape.radius()),
        });
        Self::among(scene.arm(), shapes.collect())
    }

    pub(crate) fn among(arm: &Arm, shapes: Vec<JudgeShape>) -> Self {
        Self {
            base: [arm.base().x, arm.base().y],
            lengths: arm.lengths().try_into().unwrap(),
            half_width: arm.half_width(),
            shapes,
        }
    }

    pub(crate) fn axes(&self, motion: &Motion, t: f64) -> [[P; 2]; 2] {
        let pieces = motion.pieces();
        let piece = pieces.iter().rfind(|piece| piece.start <= t).unwrap_or(&pieces[0]);
        let s = (t - piece.start).clamp(0.0, piece.duration);
        let value = |j: usize| piece.coefficients[j].iter().rev().fold(0.0, |sum, term| sum * s + term);
        let (q1, q2) = (value(0), value(1));
        let elbow = [self.base[0] + self.lengths[0] * q1.cos(), self.base[1] + self.lengths[0] * q1.sin()];
        let (sin, cos) = (q1 + q2).sin_cos();
        let tip = [elbow[0] + self.lengths[1] * cos, elbow[1] + self.lengths[1] * sin];
        [[self.base, elbow], [elbow, tip]]
    }

    pub(crate) fn clearance(&self, motion: &Motion, t: f64, link: usize, obstacle: usize) -> f64 {
        self.clearance_of(self.axes(motion, t)[link], obstacle)
    }

    pub(crate) fn clearance_of(&self, axis: [P; 2], obstacle: usize) -> f64 {
        let distance = match &self.shapes[obstacle] {
            JudgeShape::Disc(center, radius) => {
                let d = sub(axis[1], axis[0]);
                let r = sub(*center, axis[0]);
                let s = ((r[0] * d[0] + r[1] * d[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
                norm([r[0] - s * d[0], r[1] - s * d[1]]) - radius
            }
            JudgeShape::Polygon(vertices, radius) => {
                let edges = (0..vertices.len()).map(|i| [vertices[i], vertices[(i + 1) % vertices.len()]]);
                let outside = edges.map(|edge| segment_distance(axis, edge)).fold(f64::INFINITY, f64::min);
                // No polygon here reaches 0.3 m from its middle, so nothing farther than that from its edges is inside.
                let inside =
                    vertices.len() > 2 && outside > 0.0 && outside < 0.3 && goes_round(axis[0], vertices);
                if inside { -radius } else { outside - radius }
            }
        };
        distance - self.half_width
    }

    /// Clearance and time at the bottom of the dip between two times.
    pub(crate) fn bottom(
        &self,
        motion: &Motion,
        [mut a, mut b]: [f64; 2],
        link: usize,
        obstacle: usize,
    ) -> (f64, f64) {
        let at = |t: f64| self.clearance(motion, t, link, obstacle);
        for _ in 0..60 {
            let (c, d) = (a + (b - a) * 0.382, a + (b - a) * 0.618);
            if at(c) < at(d) { b = d } else { a = c }
        }
        let t = 0.5 * (a + b);
        (at(t), t)
    }

    /// Least clearance of both links from an obstacle, however large: the bottoms of all dips that may be it.
    pub(crate) fn least(&self, motion: &Motion, axes: &[[[P; 2]; 2]], obstacle: usize) -> f64 {
        let least_of = |link: usize| {
            let samples: Vec<f64> = axes.iter().map(|axes| self.clearance_of(axes[link], obstacle)).collect();
            let lowest = samples.iter().copied().fold(f64::INFINITY, f64::min);
            (0..samples.len())
                .filter(|&i| samples[i] < lowest + 1e-3 && is_dip(&samples, i))
                .map(|i| [i - 1, i + 1].map(|i| sample_time(motion, i)))
                .map(|around| self.bottom(motion, around, link, obstacle).0)
                .fold(lowest, f64::min)
        };
        least_of(0).min(least_of(1))
    }

    /// Least clearance of a pair found by samples, with every dip among them followed down; and the first of
    /// the times looked at with a clearance not above 0.
    pub(crate) fn sweep(
        &self,
        motion: &Motion,
        axes: &[[[P; 2]; 2]],
        link: usize,
        obstacle: usize,
    ) -> (f64, Option<f64>) {
        let time = |i: usize| sample_time(motion, i);
        let samples: Vec<f64> = axes.iter().map(|axes| self.clearance_of(axes[link], obstacle)).collect();
        let mut least = f64::INFINITY;
        let mut first = None;
        for i in 0..=SAMPLES {
            let mut low = (samples[i], time(i));
            if is_dip(&samples, i) && samples[i] < 0.05 {
                let bottom = self.bottom(motion, [time(i - 1), time(i + 1)], link, obstacle);
                low = if bottom.0 < low.0 { bottom } else { low };
            }
            if low.0 <= 1e-12 && first.is_none() {
                first = Some(low.1);
            }
            least = least.min(low.0);
        }
        (least, first)
    }
}

/// A level stretch is none: it has no bottom to look for.
pub(crate) fn is_dip(samples: &[f64], i: usize) -> bool {
    i > 0 && i + 1 < samples.len() && {
        let (before, after) = (samples[i - 1], samples[i + 1]);
        samples[i] <= before && samples[i] <= after && before.max(after) > samples[i] + 1e-12
    }
}
