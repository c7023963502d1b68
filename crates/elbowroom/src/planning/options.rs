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
    pub fn count_in(&self, range: RangeInclusive<usize>) -> Option<usize> {
        match self {
            Self::Count(count) if range.contains(count) => Some(*count),
            _ => None,
        }
    }

    /// What the word stands for, if it is one of `words`.
    pub fn one_of<T: Copy>(&self, words: &[(&str, T)]) -> Option<T> {
        match self {
            Self::Count(_) => None,
            Self::Word(word) => words.iter().find(|(known, _)| known == word).map(|(_, value)| *value),
        }
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
