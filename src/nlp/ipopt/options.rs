//! From [`Settings`] to Ipopt's options.

use super::IpoptError;
use super::choice::{Choice, library, text_option};
use super::problem::Problem;
use crate::nlp::{LinearSolver, OptionValue, Settings};
use ipopt_sys::hsl;
use ipopt_sys::ma97::Reached;
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

/// Sets every option of a solve.
pub(super) fn apply(
    problem: &mut Problem,
    settings: &Settings,
    choice: &Choice,
) -> Result<(), IpoptError> {
    check_libraries(settings)?;

    let mut set = |name: &str, value: OptionValue| set_option(problem, name, &value);
    // Silence first: Ipopt complains on standard output about an option it refuses.
    set("print_level", integer(0))?;
    set("sb", text("yes"))?;
    // An empty name is the one way to read no option file that Ipopt does not announce.
    set("option_file_name", text(""))?;
    problem.initialise();

    let mut set = |name: &str, value: OptionValue| set_option(problem, name, &value);
    set("print_level", integer(settings.print_level.into()))?;
    if settings.timing && choice.bridge.is_none() {
        set("print_timing_statistics", text("yes"))?;
    }
    set("tol", OptionValue::Real(settings.tolerance))?;
    set(
        "max_iter",
        integer(i32::try_from(settings.max_iterations).unwrap_or(i32::MAX)),
    )?;
    set("linear_solver", text(choice.ipopt_name()))?;
    // Ipopt relaxes bounds by 1e-8. Moving the result back inside them, the default of 3.11, would
    // leave equality constraints violated by more than the tolerance.
    set("honor_original_bounds", text("no"))?;
    if choice.solver == LinearSolver::Mumps {
        // With its own choice of ordering MUMPS reports wrong inertia, and Ipopt regularises.
        set("mumps_pivot_order", integer(0))?;
    }
    if choice.bridge.is_some() {
        // One analysis, of the pattern alone.
        set("ma97_order", text("amd"))?;
        set("ma97_scaling", text("none"))?;
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
    for (name, value) in &settings.options {
        // The linear solver is chosen above, and may have a name that Ipopt does not know.
        if !name.eq_ignore_ascii_case("linear_solver") {
            set(name, value.clone())?;
        }
    }
    if let Some(Reached::Library(library)) = &choice.bridge {
        // Set last: the library must be the one that holds the bridge.
        set("hsllib", text(&library.to_string_lossy()))?;
    }
    Ok(())
}

/// Refuses what would end the process: Ipopt does not survive this library's absence.
fn check_libraries(settings: &Settings) -> Result<(), IpoptError> {
    let scaling = text_option(settings, "nlp_scaling_method").unwrap_or_default();
    if scaling.eq_ignore_ascii_case("equilibration-based")
        && !hsl::available(hsl::Routine::Mc19, library(settings).as_deref())
    {
        return Err(IpoptError::MissingLibrary {
            name: "nlp_scaling_method",
            value: scaling.to_owned(),
            library: text_option(settings, "hsllib")
                .unwrap_or("the HSL library")
                .to_owned(),
            instead: "\"gradient-based\"",
        });
    }
    Ok(())
}

fn set_option(problem: &mut Problem, name: &str, value: &OptionValue) -> Result<(), IpoptError> {
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

fn try_set(problem: &mut Problem, name: &str, value: &OptionValue) -> bool {
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
