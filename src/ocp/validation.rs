//! Whether a formulation can be solved at all.

use super::{Formulation, Interval, Quantity};

/// What cannot be in a [`Formulation`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FormulationError {
    /// Nothing changes in time.
    #[error("formulation.states is empty: expected one state at least")]
    NoStates,
    /// A list that belongs to the states is not as long as theirs.
    #[error("{what} has {found} intervals: expected {expected}, one for each state")]
    Length {
        /// Which list.
        what: String,
        /// Its length.
        found: usize,
        /// Number of states.
        expected: usize,
    },
    /// Not as many values to begin with as static parameters.
    #[error(
        "formulation.parameter_guess has {found} values: expected {expected}, one for each parameter"
    )]
    Guesses {
        /// Number of values.
        found: usize,
        /// Number of parameters.
        expected: usize,
    },
    /// A static parameter that begins nowhere.
    #[error("the guess of parameter {name} is {value}: expected a finite number")]
    Guess {
        /// Name of the parameter.
        name: String,
        /// What it is.
        value: f64,
    },
    /// A parameter or an integral that cannot be told from others.
    #[error("{list}[{index}] is named {name:?}: expected a name that no other has")]
    Name {
        /// Which list.
        list: &'static str,
        /// Place in it.
        index: usize,
        /// Its name.
        name: String,
    },
    /// No value satisfies bounds.
    #[error(
        "{what} allows no value, it is {lower} to {upper}: expected a lower bound not above the upper one"
    )]
    Empty {
        /// Which bounds.
        what: String,
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
    },
    /// A duration that is no time.
    #[error(
        "formulation.duration is {lower} to {upper} s: expected finite bounds from zero on, the upper one above zero, which may be infinite"
    )]
    Duration {
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
    },
    /// A final time that is not reached.
    #[error(
        "formulation.final_time is {lower} to {upper} s: expected one between {earliest} and {latest} s, which t₀ and duration allow"
    )]
    FinalTime {
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
        /// The first time that t₀ and duration allow.
        earliest: f64,
        /// The last one.
        latest: f64,
    },
    /// A way-point that is not between its neighbours.
    #[error(
        "way-point {index} is at {fraction} of the duration: expected fractions that rise from above 0 to below 1"
    )]
    WayPoint {
        /// Which one, counted from 0.
        index: usize,
        /// Where it stands.
        fraction: f64,
    },
    /// A scale or a size that measures nothing.
    #[error("the {what} of {name} is {value}: expected a finite number above zero")]
    Measure {
        /// "scale" or "size".
        what: &'static str,
        /// Name of the quantity.
        name: String,
        /// What it is.
        value: f64,
    },
}

impl Formulation {
    /// Checks lengths, bounds, guesses, times, way-points and scales.
    ///
    /// # Errors
    /// [`FormulationError`] for the first that cannot be.
    pub fn validate(&self) -> Result<(), FormulationError> {
        if self.states.is_empty() {
            return Err(FormulationError::NoStates);
        }
        self.length("formulation.initial", self.initial.len())?;
        self.length("formulation.terminal", self.terminal.len())?;
        self.validate_times()?;
        self.validate_parameters()?;
        let mut before = 0.0;
        for (index, point) in self.way_points.iter().enumerate() {
            let fraction = point.fraction;
            if !(fraction > before && fraction < 1.0) {
                return Err(FormulationError::WayPoint { index, fraction });
            }
            before = fraction;
            self.length(&format!("states of way-point {index}"), point.states.len())?;
        }
        let rows = self.way_points.iter().flat_map(|point| &point.rows);
        let lists = [
            &self.states,
            &self.controls,
            &self.path,
            &self.boundary,
            &self.parameters,
            &self.integrals,
        ];
        let quantities = lists.into_iter().flatten().chain(rows);
        quantities.into_iter().try_for_each(Quantity::validate)?;
        for (i, state) in self.states.iter().enumerate() {
            let at = |instant: String, bounds: &Interval| {
                let both = bounds.intersect(&state.bounds);
                possible(&both, || format!("{}, {instant}", state.name))
            };
            at("at the start".into(), &self.initial[i])?;
            at("at the end".into(), &self.terminal[i])?;
            for (index, point) in self.way_points.iter().enumerate() {
                at(format!("at way-point {index}"), &point.states[i])?;
            }
        }
        Ok(())
    }

    fn length(&self, what: &str, found: usize) -> Result<(), FormulationError> {
        let expected = self.states.len();
        if found == expected {
            return Ok(());
        }
        Err(FormulationError::Length {
            what: what.into(),
            found,
            expected,
        })
    }

    fn validate_times(&self) -> Result<(), FormulationError> {
        let Interval { lower, upper } = self.duration;
        let is_time = lower >= 0.0 && lower.is_finite() && upper > 0.0 && lower <= upper;
        if !is_time {
            return Err(FormulationError::Duration { lower, upper });
        }
        possible(&self.initial_time, || "formulation.initial_time".into())?;
        possible(&self.final_time, || "formulation.final_time".into())?;
        let earliest = self.initial_time.lower + lower;
        let latest = self.initial_time.upper + upper;
        let Interval { lower, upper } = self.final_time;
        if lower <= latest && upper >= earliest {
            return Ok(());
        }
        Err(FormulationError::FinalTime {
            lower,
            upper,
            earliest,
            latest,
        })
    }

    fn validate_parameters(&self) -> Result<(), FormulationError> {
        let (found, expected) = (self.parameter_guess.len(), self.parameters.len());
        if found != expected {
            return Err(FormulationError::Guesses { found, expected });
        }
        for (parameter, &value) in self.parameters.iter().zip(&self.parameter_guess) {
            if !value.is_finite() {
                let name = parameter.name.clone();
                return Err(FormulationError::Guess { name, value });
            }
        }
        distinct("formulation.parameters", &self.parameters)?;
        distinct("formulation.integrals", &self.integrals)
    }
}

impl Quantity {
    fn validate(&self) -> Result<(), FormulationError> {
        possible(&self.bounds, || self.name.clone())?;
        for (what, value) in [("scale", self.scale), ("size", self.size)] {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                return Err(FormulationError::Measure {
                    what,
                    name: self.name.clone(),
                    value,
                });
            }
        }
        Ok(())
    }
}

/// Asks for a name, and another one, in each of `quantities`.
fn distinct(list: &'static str, quantities: &[Quantity]) -> Result<(), FormulationError> {
    for (index, quantity) in quantities.iter().enumerate() {
        let name = &quantity.name;
        if name.is_empty() || quantities[..index].iter().any(|other| other.name == *name) {
            let name = name.clone();
            return Err(FormulationError::Name { list, index, name });
        }
    }
    Ok(())
}

fn possible(bounds: &Interval, what: impl FnOnce() -> String) -> Result<(), FormulationError> {
    let &Interval { lower, upper } = bounds;
    if lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY {
        return Ok(());
    }
    Err(FormulationError::Empty {
        what: what(),
        lower,
        upper,
    })
}
