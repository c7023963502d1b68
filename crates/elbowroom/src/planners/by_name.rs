//! Planners and their options by name, as the command line and Python ask for them: the one list of them.

use std::fmt;

use thiserror::Error;

use super::IkPsoSettings;
use super::settings::Planner;
use crate::swarm::GuidedSwarmSettings;

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
        match self {
            Self::Dstar | Self::Optimal => Vec::new(),
            Self::DstarPso(swarm) => vec![("candidates", OptionValue::Count(swarm.candidates))],
            Self::IkPso(settings) => vec![("evaluations", OptionValue::Count(settings.evaluations))],
        }
    }

    /// The option that limits how many candidates it judges, if it counts them.
    pub fn budget(&self) -> Option<&'static str> {
        match self {
            Self::Dstar | Self::Optimal => None,
            Self::DstarPso(_) => Some("candidates"),
            Self::IkPso(_) => Some("evaluations"),
        }
    }

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), NameError> {
        let planner = self.name();
        let known: Vec<&'static str> = self.options().into_iter().map(|(name, _)| name).collect();
        match (self, option, value) {
            (Self::DstarPso(swarm), "candidates", OptionValue::Count(count)) => swarm.candidates = *count,
            (Self::IkPso(settings), "evaluations", OptionValue::Count(count)) => {
                settings.evaluations = *count
            }
            (_, option, value) => {
                let Some(option) = known.iter().find(|name| **name == option) else {
                    return Err(NameError::Option { planner, option: option.to_owned(), known });
                };
                let allowed = "a whole number";
                return Err(NameError::Value { planner, option, value: value.clone(), allowed });
            }
        }
        Ok(())
    }
}
