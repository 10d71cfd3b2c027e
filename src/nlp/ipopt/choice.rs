//! Which linear solver a solve uses: what was asked for, and what can be had.

use super::{IpoptError, ma97_bridge};
use crate::nlp::{LinearSolver, OptionValue, Settings};
use ipopt_sys::hsl;
use ipopt_sys::ma97::{self, Reached, Routines};
use std::ffi::{CStr, CString};

/// A linear solver that can be used.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    /// Which one; never [`LinearSolver::Auto`].
    pub solver: LinearSolver,
    /// How Ipopt reaches the multifrontal solver; `None` with any other.
    pub bridge: Option<Reached>,
    /// The routines of the real HSL_MA97 where that is asked for: the bridge, which Ipopt finds in
    /// its place, passes all calls on to them.
    pub hsl: Option<Routines>,
}

impl Choice {
    /// What Ipopt calls it.
    pub fn ipopt_name(&self) -> &str {
        if self.bridge.is_some() {
            LinearSolver::Ma97.name()
        } else {
            self.solver.name()
        }
    }

    /// What stands in where the multifrontal solver cannot be had or fails.
    pub fn fallback() -> Self {
        Self::by_ipopt(LinearSolver::Mumps)
    }

    /// A linear solver that Ipopt brings or loads by itself.
    fn by_ipopt(solver: LinearSolver) -> Self {
        Self {
            solver,
            bridge: None,
            hsl: None,
        }
    }

    /// What `settings` ask for.
    ///
    /// # Errors
    /// Where HSL_MA97 is asked for and not installed: Ipopt would not survive that.
    pub fn of(settings: &Settings) -> Result<Self, IpoptError> {
        Ok(match asked(settings) {
            LinearSolver::Auto | LinearSolver::Multifrontal => match ma97_bridge::register() {
                Ok(reached) => Self {
                    solver: LinearSolver::Multifrontal,
                    bridge: Some(reached),
                    hsl: None,
                },
                Err(_) => Self::fallback(),
            },
            LinearSolver::Ma97 => Self {
                hsl: Some(installed(library(settings).as_deref())?),
                ..Self::by_ipopt(LinearSolver::Ma97)
            },
            other => {
                whole(&other, library(settings).as_deref())?;
                Self::by_ipopt(other)
            }
        })
    }
}

/// Refuses a linear solver that the HSL library lacks: Ipopt would not survive that.
fn whole(solver: &LinearSolver, library: Option<&CStr>) -> Result<(), IpoptError> {
    let routine = match solver {
        LinearSolver::Ma27 => hsl::Routine::Ma27,
        LinearSolver::Ma57 => hsl::Routine::Ma57,
        LinearSolver::Ma77 => hsl::Routine::Ma77,
        LinearSolver::Ma86 => hsl::Routine::Ma86,
        _ => return Ok(()),
    };
    match hsl::incomplete(routine, library) {
        true => Err(missing(solver, library)),
        false => Ok(()),
    }
}

/// Why the multifrontal solver cannot be had although `settings` ask for it, in words; `None` where
/// it can, or another is asked for.
pub fn why_not_multifrontal(settings: &Settings) -> Option<String> {
    let asked = asked(settings);
    if !matches!(asked, LinearSolver::Auto | LinearSolver::Multifrontal) {
        return None;
    }
    let why = ma97_bridge::register().err()?;
    Some(format!(
        "linear_solver = \"{asked}\": Ipopt {} cannot be given the multifrontal linear solver \
         ({why}); MUMPS is used in its place",
        super::version()
    ))
}

/// The linear solver that a solve with `settings` uses. Not [`LinearSolver::Auto`], but what that
/// comes to on this machine.
pub fn linear_solver(settings: &Settings) -> LinearSolver {
    Choice::of(settings).map_or_else(|_| asked(settings), |choice| choice.solver)
}

/// What the settings ask for; an option by name counts more than the field.
///
/// A name is read again, so that `Other("ma97")` is HSL_MA97 too.
fn asked(settings: &Settings) -> LinearSolver {
    let name = text_option(settings, "linear_solver");
    LinearSolver::from(name.unwrap_or(settings.linear_solver.name()))
}

/// The value of Ipopt's option `hsllib`, where it is given.
pub(super) fn library(settings: &Settings) -> Option<CString> {
    text_option(settings, "hsllib").and_then(|name| CString::new(name).ok())
}

fn installed(library: Option<&CStr>) -> Result<Routines, IpoptError> {
    ma97::installed(library).ok_or_else(|| missing(&LinearSolver::Ma97, library))
}

fn missing(solver: &LinearSolver, library: Option<&CStr>) -> IpoptError {
    IpoptError::MissingLibrary {
        name: "linear_solver",
        value: solver.to_string(),
        library: library.map_or_else(
            || "the HSL library".into(),
            |name| name.to_string_lossy().into_owned(),
        ),
        instead: "\"auto\" or \"mumps\"",
    }
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
