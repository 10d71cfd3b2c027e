//! What is checked and converted before Ipopt sees it: bounds and start.

use super::IpoptError;
use crate::nlp::{Iterate, Nlp, Settings, Size};

/// What Ipopt reads as infinity is 1e19 and more.
const INFINITE: f64 = 2e19;

/// Bounds with infinities as Ipopt writes them.
pub(super) struct Bounds {
    pub(super) variables: [Vec<f64>; 2],
    pub(super) constraints: [Vec<f64>; 2],
}

impl Bounds {
    /// Bounds of `nlp`, each checked to leave some value.
    pub(super) fn of(nlp: &dyn Nlp, size: Size) -> Result<Self, IpoptError> {
        let mut variables = [vec![0.0; size.variables], vec![0.0; size.variables]];
        let mut constraints = [vec![0.0; size.constraints], vec![0.0; size.constraints]];
        let [lower, upper] = &mut variables;
        nlp.variable_bounds(lower, upper);
        convert(lower, upper, |index| nlp.variable_name(index))?;
        let [lower, upper] = &mut constraints;
        nlp.constraint_bounds(lower, upper);
        convert(lower, upper, |index| nlp.constraint_name(index))?;
        Ok(Self {
            variables,
            constraints,
        })
    }
}

fn convert(
    lower: &mut [f64],
    upper: &mut [f64],
    name: impl Fn(usize) -> String,
) -> Result<(), IpoptError> {
    for (index, (lower, upper)) in lower.iter_mut().zip(upper).enumerate() {
        let possible = *lower <= *upper && *lower < f64::INFINITY && *upper > f64::NEG_INFINITY;
        if !possible {
            return Err(IpoptError::Bounds {
                name: name(index),
                lower: *lower,
                upper: *upper,
            });
        }
        *lower = lower.max(-INFINITE);
        *upper = upper.min(INFINITE);
    }
    Ok(())
}

/// Checks lengths and finiteness of `start`, as far as this solve uses it.
pub(super) fn check_start(
    nlp: &dyn Nlp,
    size: Size,
    settings: &Settings,
    start: &Iterate,
) -> Result<(), IpoptError> {
    if start.x.len() != size.variables {
        return Err(IpoptError::StartDimension {
            what: "variables",
            expected: size.variables,
            found: start.x.len(),
        });
    }
    let variable = |index| nlp.variable_name(index);
    finite(&start.x, "the value", variable)?;
    let Some(barrier) = settings.warm_start else {
        return Ok(());
    };
    if !(barrier > 0.0 && barrier.is_finite()) {
        return Err(IpoptError::Barrier(barrier));
    }
    if !start.has_multipliers(size.constraints) {
        return Err(IpoptError::NoMultipliers);
    }
    finite(&start.multipliers, "the multiplier", |index| {
        nlp.constraint_name(index)
    })?;
    finite(
        &start.lower_multipliers,
        "the lower bound's multiplier",
        variable,
    )?;
    finite(
        &start.upper_multipliers,
        "the upper bound's multiplier",
        variable,
    )
}

fn finite(
    values: &[f64],
    what: &'static str,
    name: impl Fn(usize) -> String,
) -> Result<(), IpoptError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(IpoptError::StartNotFinite {
            what,
            name: name(index),
            value: values[index],
        }),
    }
}

/// The iterate Ipopt starts from and writes its result to: all vectors at full length.
pub(super) fn initial(start: &Iterate, size: Size, warm: bool) -> Iterate {
    if warm {
        return start.clone();
    }
    Iterate {
        x: start.x.clone(),
        multipliers: vec![0.0; size.constraints],
        lower_multipliers: vec![0.0; size.variables],
        upper_multipliers: vec![0.0; size.variables],
    }
}
