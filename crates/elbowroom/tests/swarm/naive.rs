//! The same swarm as plainly as can be.

use super::*;

/// One particle of the naive swarm.
pub(crate) struct Particle {
    pub(crate) position: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) personal_best: Vec<f64>,
    pub(crate) value: f64,
}

/// The same swarm as plainly as can be: an array of particles, one random number at a time.
pub(crate) struct NaiveSwarm {
    pub(crate) ranges: Vec<[f64; 2]>,
    pub(crate) settings: SwarmSettings,
    pub(crate) particles: Vec<Particle>,
    pub(crate) rng: ChaCha8Rng,
    pub(crate) iteration: usize,
}

impl NaiveSwarm {
    pub(crate) fn new(ranges: &[[f64; 2]], settings: SwarmSettings, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut particles = Vec::new();
        for _ in 0..settings.particles {
            let (mut position, mut velocity) = (Vec::new(), Vec::new());
            for &[min, max] in ranges {
                let here = clamped(min + unit(&mut rng) * (max - min), min, max);
                let there = clamped(min + unit(&mut rng) * (max - min), min, max);
                let limit = settings.v_max.map_or(f64::INFINITY, |share| share * (max - min));
                position.push(here);
                velocity.push(clamped(0.5 * (there - here), -limit, limit));
            }
            let personal_best = position.clone();
            particles.push(Particle { position, velocity, personal_best, value: f64::INFINITY });
        }
        Self { ranges: ranges.to_vec(), settings, particles, rng, iteration: 0 }
    }

    /// The best of a particle's neighbourhood, by looking at all of it.
    pub(crate) fn neighbour_best(&self, particle: usize) -> usize {
        let n = self.particles.len();
        let members: Vec<usize> = match self.settings.neighbourhood {
            Neighbourhood::Global => (0..n).collect(),
            Neighbourhood::Ring { k } => (0..=2 * k).map(|i| (particle + n + i - k) % n).collect(),
        };
        let least = members.iter().map(|&i| self.particles[i].value).fold(f64::INFINITY, f64::min);
        members.into_iter().filter(|&i| self.particles[i].value == least).min().unwrap()
    }

    pub(crate) fn step(&mut self, objective: fn(&[f64]) -> f64) {
        if self.iteration > 0 {
            let SwarmSettings { first_inertia, last_inertia, .. } = self.settings;
            let share = self.iteration.min(self.settings.iterations) as f64 / self.settings.iterations as f64;
            let inertia = first_inertia - (first_inertia - last_inertia) * share;
            for i in 0..self.particles.len() {
                let best = self.particles[self.neighbour_best(i)].personal_best.clone();
                let particle = &mut self.particles[i];
                for (d, &[min, max]) in self.ranges.iter().enumerate() {
                    let (r1, r2) = (unit(&mut self.rng), unit(&mut self.rng));
                    let x = particle.position[d];
                    let mut v = inertia * particle.velocity[d]
                        + self.settings.c_personal * r1 * (particle.personal_best[d] - x)
                        + self.settings.c_neighbour * r2 * (best[d] - x);
                    if let Some(share) = self.settings.v_max {
                        let limit = share * (max - min);
                        v = clamped(v, -limit, limit);
                    }
                    let outside = x + v < min || x + v > max;
                    particle.position[d] = clamped(x + v, min, max);
                    particle.velocity[d] = if outside { 0.0 } else { v };
                }
            }
        }
        for particle in &mut self.particles {
            let value = objective(&particle.position);
            if !value.is_nan() && value < particle.value {
                particle.value = value;
                particle.personal_best.clone_from(&particle.position);
            }
        }
        self.iteration += 1;
    }

    pub(crate) fn best(&self) -> &Particle {
        let least = self.particles.iter().map(|particle| particle.value).fold(f64::INFINITY, f64::min);
        self.particles.iter().find(|particle| particle.value == least).unwrap()
    }
}
