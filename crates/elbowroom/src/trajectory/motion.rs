use thiserror::Error;

use super::{Piece, State};

/// Polynomial pieces one after the other. Nobody has judged yet whether an arm may run it.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    pieces: Vec<Piece>,
}

/// Why pieces make no motion.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum MotionError {
    /// There is none.
    #[error("a motion needs at least one piece")]
    Empty,
    /// A piece moves another number of joints than the first.
    #[error("piece {piece} moves {found} joints, the first one {joints}")]
    Joints {
        /// Its place, from 0.
        piece: usize,
        /// How many joints it moves.
        found: usize,
        /// How many the first one moves.
        joints: usize,
    },
    /// A coefficient or a time is infinite or not a number.
    #[error("piece {piece} has a number that is not finite")]
    NotFinite {
        /// Its place, from 0.
        piece: usize,
    },
    /// A piece lasts no time, or less.
    #[error("piece {piece} lasts {duration} s, it must last longer than 0 s")]
    Duration {
        /// Its place, from 0.
        piece: usize,
        /// What was given (s).
        duration: f64,
    },
    /// A piece does not begin where the one before it ends.
    #[error("piece {piece} begins at {start} s, the one before it ends at {end} s")]
    Gap {
        /// Its place, from 0.
        piece: usize,
        /// When it begins (s).
        start: f64,
        /// When its predecessor ends (s).
        end: f64,
    },
}

impl Motion {
    /// The motion through `pieces`, each beginning when the one before it ends. A single piece may last
    /// 0 s: an arm that is already there.
    ///
    /// # Errors
    /// [`MotionError`] for no piece, pieces of different joints, numbers that are not finite, or times that do not join.
    pub fn new(pieces: Vec<Piece>) -> Result<Self, MotionError> {
        if pieces.is_empty() {
            return Err(MotionError::Empty);
        }
        let joints = pieces[0].coefficients.len();
        for (i, piece) in pieces.iter().enumerate() {
            if piece.coefficients.len() != joints {
                return Err(MotionError::Joints { piece: i, found: piece.coefficients.len(), joints });
            }
            let finite = piece.start.is_finite()
                && piece.duration.is_finite()
                && piece.coefficients.iter().flatten().all(|c| c.is_finite());
            if !finite {
                return Err(MotionError::NotFinite { piece: i });
            }
            let standing = pieces.len() == 1 && piece.duration == 0.0;
            if piece.duration <= 0.0 && !standing {
                return Err(MotionError::Duration { piece: i, duration: piece.duration });
            }
            if i > 0 {
                let end = pieces[i - 1].start + pieces[i - 1].duration;
                if (piece.start - end).abs() > 1e-9 * end.abs().max(1.0) {
                    return Err(MotionError::Gap { piece: i, start: piece.start, end });
                }
            }
        }
        Ok(Self { pieces })
    }

    /// One piece alone, whose numbers are known to be sound.
    pub(crate) fn of(piece: Piece) -> Self {
        Self { pieces: vec![piece] }
    }

    /// The pieces in order of time.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// How many joints it moves.
    pub fn joints(&self) -> usize {
        self.pieces[0].coefficients.len()
    }

    /// When it begins (s).
    pub fn start(&self) -> f64 {
        self.pieces[0].start
    }

    /// When it ends (s).
    pub fn end(&self) -> f64 {
        let last = &self.pieces[self.pieces.len() - 1];
        last.start + last.duration
    }

    /// How long it lasts (s).
    pub fn duration(&self) -> f64 {
        self.end() - self.start()
    }

    /// How often the arm comes to rest where two pieces meet.
    pub fn stops(&self) -> usize {
        let begins_at_rest = |piece: &&Piece| piece.coefficients.iter().all(|terms| terms[1] == 0.0);
        self.pieces.iter().skip(1).filter(begins_at_rest).count()
    }

    /// Positions (rad) at the start and at `count` even instants of each piece, its end the last.
    pub(crate) fn instants(&self, count: usize) -> Vec<Vec<f64>> {
        let first = self.at(self.start()).position;
        let rest = self.pieces.iter().flat_map(|piece| {
            (1..=count).map(|i| piece.at(piece.duration * i as f64 / count as f64).position)
        });
        std::iter::once(first).chain(rest).collect()
    }

    /// What is left of the motion from time `t` (s) on; `None` if that is its end or later.
    #[must_use]
    pub fn after(&self, t: f64) -> Option<Self> {
        let index = self.pieces.partition_point(|piece| piece.start + piece.duration <= t);
        let first = self.pieces.get(index)?;
        let mut pieces = vec![first.after((t - first.start).max(0.0))];
        pieces.extend(self.pieces[index + 1..].iter().cloned());
        Some(Self { pieces })
    }

    /// The motion up to time `t` (s); `None` if that is its start or earlier.
    #[must_use]
    pub fn before(&self, t: f64) -> Option<Self> {
        let mut pieces: Vec<Piece> = self.pieces.iter().filter(|piece| piece.start < t).cloned().collect();
        let last = pieces.last_mut()?;
        last.duration = last.duration.min(t - last.start);
        Some(Self { pieces })
    }

    /// The same motion in so many `seconds`, evenly slower or faster.
    ///
    /// # Errors
    /// [`MotionError`] where numbers overflow.
    pub fn lasting(&self, seconds: f64) -> Result<Self, MotionError> {
        let factor = seconds / self.duration();
        let slowed = |piece: &Piece| {
            let mut power = 1.0;
            let mut of = piece.clone();
            of.start = self.start() + (piece.start - self.start()) * factor;
            of.duration *= factor;
            for order in 1..6 {
                power /= factor;
                of.coefficients.iter_mut().for_each(|terms| terms[order] *= power);
            }
            of
        };
        Self::new(self.pieces.iter().map(slowed).collect())
    }

    /// This motion and then `next`, which begins where and when it ends.
    ///
    /// # Errors
    /// [`MotionError`] where times or joints do not join.
    pub fn then(mut self, next: Self) -> Result<Self, MotionError> {
        self.pieces.extend(next.pieces);
        Self::new(self.pieces)
    }

    /// The joints at time `t` (s); before the start and after the end, those of the nearer end.
    pub fn at(&self, t: f64) -> State {
        let index = self.pieces.partition_point(|piece| piece.start <= t).saturating_sub(1);
        let piece = &self.pieces[index];
        piece.at((t - piece.start).clamp(0.0, piece.duration))
    }
}
