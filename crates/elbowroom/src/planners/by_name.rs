//! Planners and their options by name, as the command line and Python ask for them.

use thiserror::Error;

use crate::planning::{OptionValue, Planner};

/// The one of `planners` called `name`, with these options in place of its defaults.
pub(super) fn named(
    planners: Vec<Box<dyn Planner>>,
    name: &str,
    options: &[(String, OptionValue)],
) -> Result<Box<dyn Planner>, NameError> {
    let mut known = Vec::new();
    for mut planner in planners {
        if planner.name() != name {
            known.push(planner.name().to_owned());
            continue;
        }
        for (option, value) in options {
            set(&mut *planner, option, value)?;
        }
        return Ok(planner);
    }
    Err(NameError::Planner { name: name.to_owned(), known })
}

fn set(planner: &mut dyn Planner, option: &str, value: &OptionValue) -> Result<(), NameError> {
    let known: Vec<&'static str> = planner.options().into_iter().map(|(name, _)| name).collect();
    let name = planner.name().to_owned();
    let Some(option) = known.iter().copied().find(|known| *known == option) else {
        return Err(NameError::Option { planner: name, option: option.to_owned(), known });
    };
    let refused = |allowed| NameError::Value { planner: name, option, value: value.clone(), allowed };
    planner.set(option, value).map_err(refused)
}

/// Why a planner's name and options name none.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NameError {
    /// There is no such planner.
    #[error("no planner is called '{}'; known: {}", name.escape_debug(), known.join(", "))]
    Planner {
        /// What was asked for.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// It has no such option.
    #[error("planner {planner} has no option '{}'; known: {}", option.escape_debug(), listed(known))]
    Option {
        /// Which planner.
        planner: String,
        /// What was asked for.
        option: String,
        /// Those it has.
        known: Vec<&'static str>,
    },
    /// The option has no such value.
    #[error("option {option} of planner {planner} is {value}, it must be {allowed}")]
    Value {
        /// Which planner.
        planner: String,
        /// Which option.
        option: &'static str,
        /// What was given.
        value: OptionValue,
        /// What it may be.
        allowed: String,
    },
}

fn listed(known: &[&'static str]) -> String {
    if known.is_empty() { "it has none".to_owned() } else { known.join(", ") }
}
