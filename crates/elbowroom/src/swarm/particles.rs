//! The plain particle swarm over any objective.

use std::collections::VecDeque;

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::neighbours::{best, ring_bests};
use super::{Bounds, Neighbourhood, SwarmError, SwarmSettings, Value};

/// What a swarm found.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum<V = f64> {
    /// The best position that was evaluated.
    pub position: Vec<f64>,
    /// The objective there; the worst of values, as infinity, if it was nowhere better.
    pub value: V,
    /// How often the objective was asked.
    pub evaluations: usize,
}

/// Particles that look for the least value of an objective in a box, iteration by iteration.
///
/// Iteration 0 evaluates positions drawn at random; each one after it moves every particle by eqs (5) and (6),
/// clamps its speed and then its position to the box, where a clamped coordinate loses its velocity, and
/// evaluates it. Personal bests change only when all particles have moved. An objective that is not a number
/// counts as infinite. The same seed gives the same bytes on every platform if the objective does.
///
/// # Reference
/// Shi and Eberhart, *A modified particle swarm optimizer* (1998); first velocities as in Clerc's *Standard
/// particle swarm optimisation* (2007), section 3.
#[derive(Debug, Clone)]
pub struct Swarm<V: Value = f64> {
    pub(super) bounds: Bounds,
    pub(super) settings: SwarmSettings,
    /// Greatest speed in each dimension.
    v_max: Vec<f64>,
    // One array for each property, particle after particle.
    pub(super) positions: Vec<f64>,
    pub(super) velocities: Vec<f64>,
    pub(super) personal_bests: Vec<f64>,
    /// The objective at each personal best.
    pub(super) values: Vec<V>,
    /// For each particle the one with the best personal best of its neighbourhood.
    neighbour_bests: Vec<usize>,
    pub(super) swarm_best: usize,
    pub(super) iteration: usize,
    pub(super) rng: ChaCha8Rng,
    /// Random bytes for one particle: two numbers for each coordinate.
    pub(super) draws: Vec<[u8; 8]>,
    /// Scratch of the ring.
    waiting: VecDeque<usize>,
}

impl<V: Value> Swarm<V> {
    /// A swarm at random positions, not yet evaluated.
    ///
    /// # Errors
    /// [`SwarmError`] if a setting makes no sense.
    pub fn new(bounds: &Bounds, settings: &SwarmSettings, seed: u64) -> Result<Self, SwarmError> {
        let (particles, dimensions) = (settings.particles, bounds.dimensions());
        settings.check_in(dimensions)?;
        let v_max = bounds.min().iter().zip(bounds.max());
        let mut swarm = Self {
            v_max: v_max
                .map(|(min, max)| settings.v_max.map_or(f64::INFINITY, |v| v * (max - min)))
                .collect(),
            bounds: bounds.clone(),
            settings: *settings,
            positions: vec![0.0; particles * dimensions],
            velocities: vec![0.0; particles * dimensions],
            personal_bests: Vec::new(),
            values: vec![V::WORST; particles],
            neighbour_bests: vec![0; particles],
            swarm_best: 0,
            iteration: 0,
            rng: ChaCha8Rng::seed_from_u64(seed),
            draws: vec![[0; 8]; dimensions],
            waiting: VecDeque::with_capacity(particles),
        };
        swarm.scatter();
        swarm.personal_bests = swarm.positions.clone();
        Ok(swarm)
    }

    /// A swarm whose first particles are at rest at `positions`, clamped to the box, and the others fly anywhere in it.
    ///
    /// # Errors
    /// [`SwarmError`] if a setting makes no sense, there are more positions than particles, or one has another number of
    /// coordinates than the box.
    pub fn starting_at(
        bounds: &Bounds,
        settings: &SwarmSettings,
        positions: &[Vec<f64>],
        seed: u64,
    ) -> Result<Self, SwarmError> {
        let mut swarm = Self::new(bounds, settings, seed)?;
        let (particles, dimensions) = (settings.particles, bounds.dimensions());
        let odd = positions.iter().map(Vec::len).find(|len| *len != dimensions);
        if odd.is_some() || positions.len() > particles {
            let (found, coordinates) = (positions.len(), odd.unwrap_or(dimensions));
            return Err(SwarmError::Start { found, coordinates, particles, dimensions });
        }
        let coordinates = positions.iter().flat_map(|position| position.iter().copied().enumerate());
        for (at, (d, x)) in swarm.positions.iter_mut().zip(coordinates) {
            *at = clamped(x, bounds.min()[d], bounds.max()[d]);
        }
        let given = positions.len() * dimensions;
        swarm.velocities[..given].fill(0.0);
        swarm.personal_bests = swarm.positions.clone();
        Ok(swarm)
    }

    /// Draws positions all over the box, and velocities that lead half the way to another such position.
    fn scatter(&mut self) {
        let dimensions = self.bounds.dimensions();
        let rows =
            self.positions.chunks_exact_mut(dimensions).zip(self.velocities.chunks_exact_mut(dimensions));
        for (position, velocity) in rows {
            self.rng.fill_bytes(self.draws.as_flattened_mut());
            for (d, draw) in self.draws.iter().enumerate() {
                let (min, max) = (self.bounds.min()[d], self.bounds.max()[d]);
                let [here, there] = units(*draw).map(|unit| clamped(min + unit * (max - min), min, max));
                position[d] = here;
                velocity[d] = clamped(0.5 * (there - here), -self.v_max[d], self.v_max[d]);
            }
        }
    }

    /// One iteration: every particle moves, but for the first one, and is evaluated.
    pub fn step(&mut self, objective: &mut impl FnMut(&[f64]) -> V) {
        if self.iteration > 0 {
            self.advance();
        }
        self.look_around(objective);
    }

    /// [`step`](Self::step) with `shape` put to every velocity before the particle moves by it.
    pub fn step_shaped(
        &mut self,
        objective: &mut impl FnMut(&[f64]) -> V,
        shape: &mut impl FnMut(&mut [f64]),
    ) {
        if self.iteration > 0 {
            self.advance_shaped(shape);
        }
        self.look_around(objective);
    }

    fn look_around(&mut self, objective: &mut impl FnMut(&[f64]) -> V) {
        self.evaluate(objective);
        self.swarm_best = best(&self.values);
        match self.settings.neighbourhood {
            Neighbourhood::Ring { k } if k < self.values.len().div_ceil(2) => {
                ring_bests(&self.values, k, &mut self.waiting, &mut self.neighbour_bests);
            }
            _ => self.neighbour_bests.fill(self.swarm_best),
        }
        self.iteration += 1;
    }

    /// Moves every particle: eqs (5) and (6).
    fn advance(&mut self) {
        let inertia = self.settings.inertia(self.iteration);
        let (c_personal, c_neighbour) = (self.settings.c_personal, self.settings.c_neighbour);
        let dimensions = self.bounds.dimensions();
        // Slices of one known length: no index below is checked again.
        let (min, max) = (&self.bounds.min()[..dimensions], &self.bounds.max()[..dimensions]);
        let v_max = &self.v_max[..dimensions];
        for (particle, &neighbour) in self.neighbour_bests.iter().enumerate() {
            self.rng.fill_bytes(self.draws.as_flattened_mut());
            let draws = &self.draws[..dimensions];
            let row = particle * dimensions;
            let position = &mut self.positions[row..][..dimensions];
            let velocity = &mut self.velocities[row..][..dimensions];
            let personal = &self.personal_bests[row..][..dimensions];
            let neighbour = &self.personal_bests[neighbour * dimensions..][..dimensions];
            for d in 0..dimensions {
                let [r1, r2] = units(draws[d]);
                let x = position[d];
                let v = inertia * velocity[d]
                    + c_personal * r1 * (personal[d] - x)
                    + c_neighbour * r2 * (neighbour[d] - x);
                let v = clamped(v, -v_max[d], v_max[d]);
                let inside = clamped(x + v, min[d], max[d]);
                velocity[d] = if inside == x + v { v } else { 0.0 };
                position[d] = inside;
            }
        }
    }

    /// [`advance`](Self::advance) in two passes for each particle, with `shape` between them.
    fn advance_shaped(&mut self, shape: &mut impl FnMut(&mut [f64])) {
        let inertia = self.settings.inertia(self.iteration);
        let (c_personal, c_neighbour) = (self.settings.c_personal, self.settings.c_neighbour);
        let dimensions = self.bounds.dimensions();
        for (particle, &neighbour) in self.neighbour_bests.iter().enumerate() {
            self.rng.fill_bytes(self.draws.as_flattened_mut());
            let row = particle * dimensions;
            let position = &mut self.positions[row..][..dimensions];
            let velocity = &mut self.velocities[row..][..dimensions];
            for d in 0..dimensions {
                let [r1, r2] = units(self.draws[d]);
                let x = position[d];
                let v = inertia * velocity[d]
                    + c_personal * r1 * (self.personal_bests[row + d] - x)
                    + c_neighbour * r2 * (self.personal_bests[neighbour * dimensions + d] - x);
                velocity[d] = clamped(v, -self.v_max[d], self.v_max[d]);
            }
            shape(velocity);
            for d in 0..dimensions {
                let to = position[d] + velocity[d];
                let inside = clamped(to, self.bounds.min()[d], self.bounds.max()[d]);
                velocity[d] = if inside == to { velocity[d] } else { 0.0 };
                position[d] = inside;
            }
        }
    }

    /// Asks the objective at every position and keeps what is better than the personal best.
    pub(super) fn evaluate(&mut self, objective: &mut impl FnMut(&[f64]) -> V) {
        let dimensions = self.bounds.dimensions();
        let rows = self.positions.chunks_exact(dimensions);
        let bests = self.personal_bests.chunks_exact_mut(dimensions).zip(&mut self.values);
        for (position, (personal_best, best)) in rows.zip(bests) {
            // Not a number is never better: it counts as infinite.
            let value = objective(position);
            if value.is_better(*best) {
                *best = value;
                personal_best.copy_from_slice(position);
            }
        }
    }

    /// The best position evaluated so far and the objective there; the worst of values, as infinity, as long
    /// as nothing was better.
    #[must_use]
    pub fn best(&self) -> (&[f64], V) {
        let dimensions = self.bounds.dimensions();
        let position = &self.personal_bests[self.swarm_best * dimensions..][..dimensions];
        (position, self.values[self.swarm_best])
    }

    /// How many iterations were done.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.iteration
    }

    /// How often the objective was asked.
    #[must_use]
    pub fn evaluations(&self) -> usize {
        self.iteration * self.values.len()
    }

    /// Where the particles are.
    pub fn positions(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.positions.chunks_exact(self.bounds.dimensions())
    }

    /// How each particle moved last (1/iteration).
    pub fn velocities(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.velocities.chunks_exact(self.bounds.dimensions())
    }

    /// The objective at each particle's personal best.
    #[must_use]
    pub fn values(&self) -> &[V] {
        &self.values
    }

    /// For each particle the one with the best personal best of its neighbourhood, the first of equal ones.
    #[must_use]
    pub fn neighbour_bests(&self) -> &[usize] {
        &self.neighbour_bests
    }
}

/// The best position that a swarm finds in `settings.iterations` iterations.
///
/// # Errors
/// [`SwarmError`] if a setting makes no sense.
///
/// # Example
/// ```
/// use elbowroom::swarm::{Bounds, SwarmSettings, minimise};
///
/// let bounds = Bounds::new(&[[-5.0, 5.0], [-5.0, 5.0]])?;
/// let objective = |x: &[f64]| (x[0] - 1.0).powi(2) + (x[1] + 2.0).powi(2);
/// let found = minimise(objective, &bounds, &SwarmSettings::default(), 7)?;
/// assert!(found.value < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn minimise<V: Value>(
    mut objective: impl FnMut(&[f64]) -> V,
    bounds: &Bounds,
    settings: &SwarmSettings,
    seed: u64,
) -> Result<Minimum<V>, SwarmError> {
    let mut swarm = Swarm::new(bounds, settings, seed)?;
    for _ in 0..settings.iterations {
        swarm.step(&mut objective);
    }
    let (position, value) = swarm.best();
    Ok(Minimum { position: position.to_vec(), value, evaluations: swarm.evaluations() })
}

/// `value` or the end of the range that it is at or beyond; not a number gives `min`.
#[inline]
pub(super) fn clamped(value: f64, min: f64, max: f64) -> f64 {
    let above = if value > min { value } else { min };
    if above < max { above } else { max }
}

/// Two numbers in [0, 1), multiples of 2^-32: the low half of the bytes gives the first.
#[inline]
pub(super) fn units(draw: [u8; 8]) -> [f64; 2] {
    let word = u64::from_le_bytes(draw);
    // As the upper bits of a fraction they give a number in [1, 2) without a conversion.
    let from_fraction = |upper: u64| f64::from_bits(1.0_f64.to_bits() | upper << 20) - 1.0;
    [from_fraction(word & 0xffff_ffff), from_fraction(word >> 32)]
}
