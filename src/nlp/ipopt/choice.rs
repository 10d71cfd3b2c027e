//! Which linear solver a solve uses: what was asked for, and what can be had.

use super::{IpoptError, ours};
use crate::nlp::{OptionValue, Settings};
use ipopt_sys::ma97::{self, Reached, Routines};
use std::ffi::{CStr, CString};

/// The names that mean our own linear solver: where it can be had, or MUMPS.
const OURS: [&str; 2] = ["auto", "ours"];

/// What stands in where ours cannot serve.
pub(super) const FALLBACK: &str = "mumps";

/// A linear solver that can be used.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    /// Its name, in lower case as Ipopt compares names: "ours", or Ipopt's.
    pub name: String,
    /// How Ipopt reaches ours; `None` for any other.
    pub ours: Option<Reached>,
    /// Routines of the real HSL_MA97, where that is asked for and ours is in its place.
    pub real: Option<Routines>,
}

impl Choice {
    /// What Ipopt calls it.
    pub fn ipopt_name(&self) -> &str {
        if self.ours.is_some() {
            ours::STANDS_FOR
        } else {
            &self.name
        }
    }

    /// The stand-in for ours.
    pub fn fallback() -> Self {
        Self {
            name: FALLBACK.into(),
            ours: None,
            real: None,
        }
    }

    /// What `settings` ask for.
    ///
    /// # Errors
    /// Where HSL_MA97 is asked for and not installed: Ipopt would not survive that.
    pub fn of(settings: &Settings) -> Result<Self, IpoptError> {
        let name = asked(settings);
        if OURS.contains(&name.as_str()) {
            return Ok(match ours::register() {
                Ok(reached) => Self {
                    name: "ours".into(),
                    ours: Some(reached),
                    real: None,
                },
                Err(_) => Self::fallback(),
            });
        }
        let mut choice = Self {
            name,
            ours: None,
            real: None,
        };
        if choice.name == ours::STANDS_FOR {
            let library = library(settings);
            choice.real = Some(installed(library.as_deref())?);
        }
        Ok(choice)
    }
}

/// What a user should know where ours was asked for and cannot be had at all, in words.
pub fn why_not_ours(settings: &Settings) -> Option<String> {
    let why = ours::register().err()?;
    let asked = asked(settings);
    OURS.contains(&asked.as_str()).then(|| {
        format!(
            "linear_solver = \"{asked}\": Ipopt {} cannot be given our linear solver ({why}); \
             MUMPS is used in its place",
            super::version()
        )
    })
}

/// The linear solver that `settings` come to: "ours", or Ipopt's name of another.
pub fn linear_solver(settings: &Settings) -> String {
    Choice::of(settings).map_or_else(|_| asked(settings), |choice| choice.name)
}

fn asked(settings: &Settings) -> String {
    text_option(settings, "linear_solver")
        .unwrap_or(&settings.linear_solver)
        .to_ascii_lowercase()
}

/// The value of Ipopt's option `hsllib`, where it is given.
pub(super) fn library(settings: &Settings) -> Option<CString> {
    text_option(settings, "hsllib").and_then(|name| CString::new(name).ok())
}

fn installed(library: Option<&CStr>) -> Result<Routines, IpoptError> {
    ma97::installed(library).ok_or_else(|| IpoptError::MissingLibrary {
        name: "linear_solver",
        value: ours::STANDS_FOR.into(),
        library: library.map_or_else(
            || "the HSL library".into(),
            |name| name.to_string_lossy().into_owned(),
        ),
        instead: "\"auto\" or \"mumps\"",
    })
}

/// The last text value given to an option by name.
pub(super) fn text_option<'a>(settings: &'a Settings, wanted: &str) -> Option<&'a str> {
    settings
        .options
        .iter()
        .rev()
        .find_map(|(name, value)| match value {
            OptionValue::Text(text) if name.eq_ignore_ascii_case(wanted) => Some(text.as_str()),
            _ => None,
        })
}
