//! The choices of a particle swarm.

use thiserror::Error;

use super::MAX_COORDINATES;

/// Whose personal bests a particle knows; its own is always among them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Neighbourhood {
    /// All particles: the gbest swarm.
    Global,
    /// The particles stand in a ring: the lbest swarm.
    Ring {
        /// How many neighbours count on each side, so `2 k + 1` particles with itself; fewer than there are
        /// particles. From `2 k + 1 >= particles` on it is [`Neighbourhood::Global`].
        k: usize,
    },
}

/// How a swarm moves and for how long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SwarmSettings {
    /// How many particles there are.
    pub particles: usize,
    /// Whose personal bests a particle knows.
    pub neighbourhood: Neighbourhood,
    /// Inertia at iteration 0; it falls linearly, eq. (7).
    pub first_inertia: f64,
    /// Inertia at iteration `iterations`, and after it.
    pub last_inertia: f64,
    /// Pull towards the particle's personal best: c1 of eq. (5).
    pub c_personal: f64,
    /// Pull towards the best personal best of its neighbourhood: c2 of eq. (5).
    pub c_neighbour: f64,
    /// Greatest speed along a dimension, as a share of the box's width there (1/iteration), or none.
    pub v_max: Option<f64>,
    /// How often every particle is evaluated.
    pub iterations: usize,
}

impl Default for SwarmSettings {
    fn default() -> Self {
        Self {
            particles: 50,
            neighbourhood: Neighbourhood::Global,
            first_inertia: 0.9,
            last_inertia: 0.4,
            c_personal: 2.0,
            c_neighbour: 2.0,
            v_max: Some(0.2),
            iterations: 1000,
        }
    }
}

/// Why there is no swarm of these settings.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SwarmError {
    /// There is no particle, or more coordinates would be kept than [`MAX_COORDINATES`].
    #[error(
        "{particles} particles of {dimensions} dimensions, 1 to {MAX_COORDINATES} coordinates are allowed"
    )]
    Particles {
        /// What was asked.
        particles: usize,
        /// How many coordinates each has.
        dimensions: usize,
    },
    /// A ring has no room for so many neighbours.
    #[error("{k} neighbours on each side in a ring of {particles} particles, there must be fewer")]
    Ring {
        /// What was asked.
        k: usize,
        /// How many particles there are.
        particles: usize,
    },
    /// A coefficient is negative, infinite or not a number.
    #[error("{name} is {value}, it must be finite and not negative")]
    Coefficient {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// The maximum speed lets nothing move, or is infinite or not a number.
    #[error("v_max is {value} of the box's width, it must be finite and positive")]
    Speed {
        /// What was given.
        value: f64,
    },
    /// A position to start at has another number of coordinates than the box, or there are more than particles.
    #[error(
        "{found} positions to start at of {coordinates} coordinates, for {particles} particles of {dimensions} dimensions"
    )]
    Start {
        /// How many positions.
        found: usize,
        /// How many coordinates the first at fault has.
        coordinates: usize,
        /// How many particles there are.
        particles: usize,
        /// How many coordinates each has.
        dimensions: usize,
    },
    /// The swarm would not be evaluated at all.
    #[error("0 iterations, at least 1 is needed")]
    Iterations,
}

impl SwarmSettings {
    /// Nothing when every setting makes sense by itself; only the box says how many coordinates there are.
    ///
    /// # Errors
    /// [`SwarmError`] names the first that does not.
    pub fn check(&self) -> Result<(), SwarmError> {
        self.check_in(1)
    }

    /// [`Self::check`] in a box of so many dimensions.
    pub(super) fn check_in(&self, dimensions: usize) -> Result<(), SwarmError> {
        let particles = self.particles;
        if !(1..=MAX_COORDINATES).contains(&particles.saturating_mul(dimensions)) {
            return Err(SwarmError::Particles { particles, dimensions });
        }
        if let Neighbourhood::Ring { k } = self.neighbourhood
            && k >= particles
        {
            return Err(SwarmError::Ring { k, particles });
        }
        let named = [
            ("first_inertia", self.first_inertia),
            ("last_inertia", self.last_inertia),
            ("c_personal", self.c_personal),
            ("c_neighbour", self.c_neighbour),
        ];
        if let Some((name, value)) =
            named.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0))
        {
            return Err(SwarmError::Coefficient { name, value });
        }
        match self.v_max {
            Some(value) if !(value.is_finite() && value > 0.0) => Err(SwarmError::Speed { value }),
            _ if self.iterations == 0 => Err(SwarmError::Iterations),
            _ => Ok(()),
        }
    }

    /// Inertia at an iteration: eq. (7).
    pub(super) fn inertia(&self, iteration: usize) -> f64 {
        let share = iteration.min(self.iterations) as f64 / self.iterations as f64;
        self.first_inertia - (self.first_inertia - self.last_inertia) * share
    }
}
