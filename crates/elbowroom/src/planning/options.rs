//! The values that options of planners have.

use std::fmt;
use std::ops::RangeInclusive;

/// The value of an option.
#[derive(Debug, Clone, PartialEq)]
pub enum OptionValue {
    /// A whole number.
    Count(usize),
    /// One of a few words.
    Word(String),
}

impl OptionValue {
    /// A word.
    pub fn word(word: &str) -> Self {
        Self::Word(word.to_owned())
    }

    /// The whole number, if it is one within `range`.
    ///
    /// # Errors
    /// What it may be, in words.
    pub fn count_in(&self, range: RangeInclusive<usize>) -> Result<usize, String> {
        match self {
            Self::Count(count) if range.contains(count) => Ok(*count),
            _ => Err(format!("a whole number from {} to {}", range.start(), range.end())),
        }
    }

    /// What the word stands for, if it is one of `words`.
    ///
    /// # Errors
    /// What it may be, in words.
    pub fn one_of<T: Copy>(&self, words: &[(&str, T)]) -> Result<T, String> {
        let found = words.iter().find(|(known, _)| matches!(self, Self::Word(word) if word == known));
        found
            .map(|(_, value)| *value)
            .ok_or_else(|| words.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(" or "))
    }
}

impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => write!(f, "{count}"),
            Self::Word(word) => write!(f, "'{word}'"),
        }
    }
}
