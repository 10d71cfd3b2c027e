//! From [`Settings`] to Ipopt's options.

use super::IpoptError;
use super::problem::Problem;
use crate::nlp::{Nlp, OptionValue, Settings};
use ipopt_sys::hsl;
use std::ffi::CString;

/// Distances from its bounds a warm start is pushed to: the barrier parameter within these limits,
/// the upper being Ipopt's own default.
const PUSH: [f64; 2] = [1e-6, 1e-3];

/// How near to its bounds a warm start may begin.
const PUSHES: [&str; 4] = [
    "warm_start_bound_push",
    "warm_start_bound_frac",
    "warm_start_slack_bound_push",
    "warm_start_slack_bound_frac",
];

/// Largest value below which no multiplier of a bound may begin.
const LARGEST_MULTIPLIER_PUSH: f64 = 1e-9;

/// The linear solver a solve with these settings uses, in lower case as Ipopt compares names.
pub(super) fn linear_solver(settings: &Settings) -> String {
    text_option(settings, "linear_solver")
        .unwrap_or(&settings.linear_solver)
        .to_ascii_lowercase()
}

/// The last text value given to an option by name.
fn text_option<'a>(settings: &'a Settings, wanted: &str) -> Option<&'a str> {
    settings
        .options
        .iter()
        .rev()
        .find_map(|(name, value)| match value {
            OptionValue::Text(text) if name.eq_ignore_ascii_case(wanted) => Some(text.as_str()),
            _ => None,
        })
}

/// Sets every option of a solve.
pub(super) fn apply<N: Nlp + ?Sized>(
    problem: &mut Problem<N>,
    settings: &Settings,
    linear_solver: &str,
) -> Result<(), IpoptError> {
    check_libraries(settings, linear_solver)?;

    let mut set = |name: &str, value: OptionValue| set_option(problem, name, &value);
    // Silence first: Ipopt complains on standard output about an option it refuses.
    set("print_level", integer(0))?;
    set("sb", text("yes"))?;
    // An empty name is the one way to read no option file that Ipopt does not announce.
    set("option_file_name", text(""))?;
    problem.initialise();

    let mut set = |name: &str, value: OptionValue| set_option(problem, name, &value);
    set("print_level", integer(settings.print_level.into()))?;
    if settings.timing {
        set("print_timing_statistics", text("yes"))?;
    }
    set("tol", OptionValue::Real(settings.tolerance))?;
    set(
        "max_iter",
        integer(i32::try_from(settings.max_iterations).unwrap_or(i32::MAX)),
    )?;
    set("linear_solver", text(linear_solver))?;
    // Ipopt relaxes bounds by 1e-8. Moving the result back inside them, the default of 3.11, would
    // leave equality constraints violated by more than the tolerance.
    set("honor_original_bounds", text("no"))?;
    if linear_solver == "mumps" {
        // With its own choice of ordering MUMPS reports wrong inertia, and Ipopt regularises.
        set("mumps_pivot_order", integer(0))?;
    }
    if let Some(barrier) = settings.warm_start {
        set("warm_start_init_point", text("yes"))?;
        set("mu_init", OptionValue::Real(barrier))?;
        // Ipopt's default would push every active bound 1e-3 inside, and every multiplier to 1e-3.
        for name in PUSHES {
            set(name, OptionValue::Real(barrier.clamp(PUSH[0], PUSH[1])))?;
        }
        let least = barrier.min(LARGEST_MULTIPLIER_PUSH);
        set("warm_start_mult_bound_push", OptionValue::Real(least))?;
    }
    settings
        .options
        .iter()
        .try_for_each(|(name, value)| set(name, value.clone()))
}

/// Refuses what would end the process: Ipopt does not survive these libraries' absence.
fn check_libraries(settings: &Settings, linear_solver: &str) -> Result<(), IpoptError> {
    let library = text_option(settings, "hsllib").and_then(|name| CString::new(name).ok());
    let missing = |routine| !hsl::available(routine, library.as_deref());
    let hsl_library = || {
        text_option(settings, "hsllib")
            .unwrap_or("the HSL library")
            .to_owned()
    };
    if linear_solver == "ma97" && missing(hsl::Routine::Ma97) {
        return Err(IpoptError::MissingLibrary {
            name: "linear_solver",
            value: linear_solver.to_owned(),
            library: hsl_library(),
            instead: "\"mumps\"",
        });
    }
    let scaling = text_option(settings, "nlp_scaling_method").unwrap_or_default();
    if scaling.eq_ignore_ascii_case("equilibration-based") && missing(hsl::Routine::Mc19) {
        return Err(IpoptError::MissingLibrary {
            name: "nlp_scaling_method",
            value: scaling.to_owned(),
            library: hsl_library(),
            instead: "\"gradient-based\"",
        });
    }
    Ok(())
}

fn set_option<N: Nlp + ?Sized>(
    problem: &mut Problem<N>,
    name: &str,
    value: &OptionValue,
) -> Result<(), IpoptError> {
    if try_set(problem, name, value) {
        return Ok(());
    }
    let value = match value {
        OptionValue::Integer(value) => value.to_string(),
        OptionValue::Real(value) => value.to_string(),
        OptionValue::Text(value) => format!("\"{value}\""),
    };
    Err(IpoptError::OptionRefused {
        name: name.to_owned(),
        value,
    })
}

fn try_set<N: Nlp + ?Sized>(problem: &mut Problem<N>, name: &str, value: &OptionValue) -> bool {
    let Ok(name) = CString::new(name) else {
        return false;
    };
    match value {
        // A whole number will do for a real option: 1 where 1.0 is meant.
        OptionValue::Integer(value) => {
            problem.integer(&name, *value) || problem.real(&name, f64::from(*value))
        }
        OptionValue::Real(value) => problem.real(&name, *value),
        OptionValue::Text(value) => {
            CString::new(value.as_str()).is_ok_and(|value| problem.text(&name, &value))
        }
    }
}

fn text(value: &str) -> OptionValue {
    OptionValue::Text(value.to_owned())
}

fn integer(value: i32) -> OptionValue {
    OptionValue::Integer(value)
}
