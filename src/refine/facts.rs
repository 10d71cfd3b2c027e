//! What a law may ask of the problem beside the trajectory.

use crate::ocp::{DynOcp, Formulation};
use crate::transcription::{Discretization, Patterns};
use std::fmt;

/// Bounds, dependences and rates of one problem.
pub struct Facts<'a> {
    /// Quantities and bounds.
    pub formulation: &'a Formulation,
    /// Of each state, the controls that its rate depends on.
    pub drivers: Vec<Vec<usize>>,
    /// Whether each control has a second derivative by itself: then it has no layers.
    pub curved: Vec<bool>,
    /// Whether nothing depends on time.
    pub autonomous: bool,
    /// Whether each path row depends on a control.
    pub jumping_rows: Vec<bool>,
    rates: Box<Rates<'a>>,
}

/// Rates of all states and values of all path rows from a trajectory's parameters, states, controls and the time.
type Rates<'a> = dyn Fn(&Discretization, &[f64], &[f64], f64) -> (Vec<f64>, Vec<f64>) + 'a;

impl fmt::Debug for Facts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Facts")
            .field("drivers", &self.drivers)
            .field("autonomous", &self.autonomous)
            .finish_non_exhaustive()
    }
}

impl<'a> Facts<'a> {
    /// Those of `ocp`.
    pub fn of(ocp: &'a dyn DynOcp, formulation: &'a Formulation, patterns: &Patterns) -> Self {
        let (n, paths) = (formulation.states.len(), formulation.path.len());
        let rates = move |trajectory: &Discretization, x: &[f64], u: &[f64], t: f64| {
            let (mut rates, mut path) = (vec![0.0; n], vec![0.0; paths]);
            let point = trajectory.point(x, u, t);
            ocp.functions().continuous(point, &mut rates, &mut path);
            (rates, path)
        };
        Self {
            formulation,
            jumping_rows: (0..paths)
                .map(|p| !patterns.path_is_continuous(formulation, p))
                .collect(),
            drivers: patterns.drivers(formulation),
            curved: patterns.curved_controls(formulation),
            autonomous: !Patterns::depends_on_time(ocp),
            rates: Box::new(rates),
        }
    }

    /// Rates of all states and values of all path rows at `x`, `u` and `t`, parameters being those of `trajectory`.
    pub fn rates(
        &self,
        trajectory: &Discretization,
        x: &[f64],
        u: &[f64],
        t: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        (self.rates)(trajectory, x, u, t)
    }
}
