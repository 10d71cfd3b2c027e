//! Sparsity of a problem's functions, found once and used on every mesh.

use crate::autodiff::Sparsity;
use crate::ocp::{DynOcp, Formulation, Interval, Part, PointShape, Quantity};

/// Which derivatives of (f, C, ℒ, g), of (E, Φ) and of each way-point's rows may be nonzero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Patterns {
    pub(super) node: Sparsity,
    pub(super) ends: Sparsity,
    pub(super) way_points: Vec<Sparsity>,
}

impl Patterns {
    /// Follows the operations of each function from its variables to its values.
    ///
    /// Bounds play no part, so that the patterns hold however they are changed.
    pub fn detect(ocp: &dyn DynOcp) -> Self {
        let formulation = ocp.formulation();
        let inside = |quantities: &[Quantity]| -> Vec<f64> {
            let bounds = quantities.iter().map(|quantity| &quantity.bounds);
            bounds.map(inner_value).collect()
        };
        let states = inside(&formulation.states);
        let controls = inside(&formulation.controls);
        let parameters = inside(&formulation.parameters);
        let integrals = inside(&formulation.integrals);
        let times = [&formulation.initial_time, &formulation.duration].map(inner_value);
        let time = times.iter().sum();
        let points = 0..formulation.way_points.len();
        Self {
            node: find(
                ocp,
                Part::Point,
                &formulation,
                &path_times(&formulation),
                &[&states[..], &controls, &parameters, &[time]].concat(),
            ),
            ends: find(
                ocp,
                Part::Ends,
                &formulation,
                &end_times(&formulation),
                &[&states[..], &states, &parameters, &integrals, &times].concat(),
            ),
            way_points: points
                .map(|index| {
                    find(
                        ocp,
                        Part::WayPoint(index),
                        &formulation,
                        &end_times(&formulation),
                        &[&states[..], &parameters, &times].concat(),
                    )
                })
                .collect(),
        }
    }

    /// Whether path row `p` is a function of the states and the time alone. What depends on the
    /// controls as well jumps where they switch.
    pub fn path_is_continuous(&self, formulation: &Formulation, p: usize) -> bool {
        let (states, controls) = formulation.widths();
        let inputs = &self.node.jacobian[states + p];
        !inputs
            .iter()
            .any(|input| (states..states + controls).contains(input))
    }

    /// Of each state, the controls that its rate depends on.
    pub fn drivers(&self, formulation: &Formulation) -> Vec<Vec<usize>> {
        let (states, controls) = formulation.widths();
        let own = states..states + controls;
        let of = |inputs: &Vec<usize>| {
            let inputs = inputs.iter().filter(|input| own.contains(input));
            inputs.map(|input| input - states).collect()
        };
        self.node.jacobian[..states].iter().map(of).collect()
    }

    /// Whether each control has a second derivative by itself, as where the cost weighs its square.
    pub fn curved_controls(&self, formulation: &Formulation) -> Vec<bool> {
        let (states, controls) = formulation.widths();
        (states..states + controls)
            .map(|input| self.node.hessian.contains(&(input, input)))
            .collect()
    }

    /// Whether rates, path rows, cost or integrands depend on the time, free or not.
    pub fn depends_on_time(ocp: &dyn DynOcp) -> bool {
        let formulation = ocp.formulation();
        let quantities = [
            &formulation.states,
            &formulation.controls,
            &formulation.parameters,
        ];
        let bounds = quantities.into_iter().flatten().map(|q| &q.bounds);
        let times = [&formulation.initial_time, &formulation.duration].map(inner_value);
        let at: Vec<f64> = bounds
            .map(inner_value)
            .chain([times.iter().sum()])
            .collect();
        ocp.has_branches()
            || find(ocp, Part::Point, &formulation, &[true], &at)
                .columns()
                .contains(&PointShape::of(&formulation).time())
    }
}

/// Whether t, the last input of a point, is an unknown.
pub(super) fn path_times(formulation: &Formulation) -> [bool; 1] {
    [formulation.has_free_time()]
}

/// Whether t₀ and T, the last inputs of ends and way-points, are unknowns.
pub(super) fn end_times(formulation: &Formulation) -> [bool; 2] {
    [&formulation.initial_time, &formulation.duration].map(|time| !time.is_fixed())
}

/// Which inputs of `part` are unknowns, the last ones being times.
pub(super) fn used(part: Part, formulation: &Formulation, times: &[bool]) -> Vec<bool> {
    let inputs = part.inputs(formulation);
    let mut used = vec![true; inputs];
    used[inputs - times.len()..].copy_from_slice(times);
    used
}

/// The pattern of `part`, evaluated at `at`.
fn find(
    ocp: &dyn DynOcp,
    part: Part,
    formulation: &Formulation,
    times: &[bool],
    at: &[f64],
) -> Sparsity {
    let used = used(part, formulation, times);
    if ocp.has_branches() {
        Sparsity::dense(part.outputs(formulation), &used)
    } else {
        ocp.trace(part, formulation, &used, at)
    }
}

/// A value within bounds and, where they leave room, not on them.
fn inner_value(bounds: &Interval) -> f64 {
    match (bounds.lower.is_finite(), bounds.upper.is_finite()) {
        (true, true) => bounds.lower + 0.4 * (bounds.upper - bounds.lower),
        (true, false) => bounds.lower + 0.4,
        (false, true) => bounds.upper - 0.4,
        (false, false) => 0.4,
    }
}
