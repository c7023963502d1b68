//! Planners and their options by name, as the command line and Python ask for them: the one list of them.

use std::fmt;
use std::ops::RangeInclusive;

use thiserror::Error;

use super::planner::Planner;
use super::{CbpsoSettings, IkPsoSettings, Initialisation, NscPsoSettings, PsoSettings};
use crate::swarm::{GuidedSwarmSettings, Neighbourhood};

/// The most candidates that a planner may be told to judge.
const MOST_EVALUATIONS: usize = 1_000_000_000;

/// The value of an option.
#[derive(Debug, Clone, PartialEq)]
pub enum OptionValue {
    /// A whole number.
    Count(usize),
    /// One of a few words.
    Word(String),
}

impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => write!(f, "{count}"),
            Self::Word(word) => write!(f, "'{word}'"),
        }
    }
}

/// Why a planner's name and options name none.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NameError {
    /// There is no such planner.
    #[error("no planner is called '{}'; known: {}", name.escape_debug(), known.join(", "))]
    Planner {
        /// What was asked for.
        name: String,
        /// Those there are.
        known: Vec<&'static str>,
    },
    /// It has no such option.
    #[error("planner {planner} has no option '{}'; known: {}", option.escape_debug(), listed(known))]
    Option {
        /// Which planner.
        planner: &'static str,
        /// What was asked for.
        option: String,
        /// Those it has.
        known: Vec<&'static str>,
    },
    /// The option has no such value.
    #[error("option {option} of planner {planner} is {value}, it must be {allowed}")]
    Value {
        /// Which planner.
        planner: &'static str,
        /// Which option.
        option: &'static str,
        /// What was given.
        value: OptionValue,
        /// What it may be.
        allowed: &'static str,
    },
}

fn listed(known: &[&'static str]) -> String {
    if known.is_empty() { "it has none".to_owned() } else { known.join(", ") }
}

impl Planner {
    /// Every planner with its default options.
    pub fn all() -> Vec<Self> {
        vec![
            Self::DstarPso(GuidedSwarmSettings::default()),
            Self::Dstar,
            Self::Optimal,
            Self::Pso(PsoSettings::default()),
            Self::Cbpso(CbpsoSettings::default()),
            Self::NscPso(NscPsoSettings::default()),
            Self::IkPso(IkPsoSettings::default()),
        ]
    }

    /// The planner called `name`, with these options in place of its defaults.
    ///
    /// # Errors
    /// [`NameError`] for a name or option that is not known, which lists those that are, or a value that makes no sense.
    pub fn by_name(name: &str, options: &[(String, OptionValue)]) -> Result<Self, NameError> {
        let all = Self::all();
        let known = all.iter().map(Self::name).collect();
        let unknown = || NameError::Planner { name: name.to_owned(), known };
        let mut planner = all.into_iter().find(|planner| planner.name() == name).ok_or_else(unknown)?;
        for (option, value) in options {
            planner.set(option, value)?;
        }
        Ok(planner)
    }

    /// Its options and their values.
    pub fn options(&self) -> Vec<(&'static str, OptionValue)> {
        let count = |count: usize| OptionValue::Count(count);
        let word = |word: &str| OptionValue::Word(word.to_owned());
        match self {
            Self::Dstar | Self::Optimal => Vec::new(),
            Self::DstarPso(own) => vec![("candidates", count(own.candidates))],
            Self::Pso(own) => vec![
                ("vias", count(own.vias)),
                (
                    "neighbourhood",
                    word(match own.neighbourhood {
                        Neighbourhood::Global => "global",
                        Neighbourhood::Ring { .. } => "ring",
                    }),
                ),
                ("evaluations", count(own.evaluations)),
            ],
            Self::Cbpso(own) => vec![("vias", count(own.vias)), ("evaluations", count(own.evaluations))],
            Self::NscPso(own) => vec![
                ("waypoints", count(own.waypoints)),
                (
                    "initialisation",
                    word(match own.initialisation {
                        Initialisation::StepCost => "step-cost",
                        Initialisation::Uniform => "uniform",
                    }),
                ),
                ("evaluations", count(own.evaluations)),
            ],
            Self::IkPso(own) => vec![("evaluations", count(own.evaluations))],
        }
    }

    /// The option that limits how many candidates it judges, if it counts them.
    pub fn budget(&self) -> Option<&'static str> {
        match self {
            Self::Dstar | Self::Optimal => None,
            Self::DstarPso(_) => Some("candidates"),
            Self::IkPso(_) | Self::Pso(_) | Self::Cbpso(_) | Self::NscPso(_) => Some("evaluations"),
        }
    }

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), NameError> {
        let planner = self.name();
        let known: Vec<&'static str> = self.options().into_iter().map(|(name, _)| name).collect();
        let Some(option) = known.iter().copied().find(|name| *name == option) else {
            return Err(NameError::Option { planner, option: option.to_owned(), known });
        };
        let refused =
            |allowed: &'static str| NameError::Value { planner, option, value: value.clone(), allowed };
        let count = |range: RangeInclusive<usize>, allowed: &'static str| match value {
            OptionValue::Count(count) if range.contains(count) => Ok(*count),
            _ => Err(refused(allowed)),
        };
        let word = |words: [&str; 2], allowed: &'static str| match value {
            OptionValue::Word(found) if found == words[0] => Ok(true),
            OptionValue::Word(found) if found == words[1] => Ok(false),
            _ => Err(refused(allowed)),
        };
        let evaluations = || count(1..=MOST_EVALUATIONS, "a whole number from 1 to 1000000000");
        let few = || count(1..=64, "a whole number from 1 to 64");
        match (self, option) {
            (Self::DstarPso(own), _) => own.candidates = count(0..=usize::MAX, "a whole number")?,
            (Self::IkPso(own), _) => own.evaluations = evaluations()?,
            (Self::Pso(own), "vias") => own.vias = few()?,
            (Self::Pso(own), "neighbourhood") => {
                own.neighbourhood = match word(["global", "ring"], "global or ring")? {
                    true => Neighbourhood::Global,
                    false => Neighbourhood::Ring { k: 2 },
                };
            }
            (Self::Pso(own), _) => own.evaluations = evaluations()?,
            (Self::Cbpso(own), "vias") => own.vias = few()?,
            (Self::Cbpso(own), _) => own.evaluations = evaluations()?,
            (Self::NscPso(own), "waypoints") => own.waypoints = few()?,
            (Self::NscPso(own), "initialisation") => {
                own.initialisation = match word(["step-cost", "uniform"], "step-cost or uniform")? {
                    true => Initialisation::StepCost,
                    false => Initialisation::Uniform,
                };
            }
            (Self::NscPso(own), _) => own.evaluations = evaluations()?,
            (Self::Dstar | Self::Optimal, _) => {}
        }
        Ok(())
    }
}
