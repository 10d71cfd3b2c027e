//! Patterns held against all derivatives at a few points, should operations have been missed.

use super::Discretization;
use super::node_derivatives::NodeDerivatives;
use super::patterns::{Patterns, end_times, path_times, used};
use crate::autodiff::Sparsity;
use crate::ocp::{DynOcp, Formulation, Part};

/// Most collocation points that are looked at.
const POINTS: usize = 8;

/// Part of the largest derivative that a problem's own code may leave where there is none.
const ROUNDING: f64 = 1e-9;

impl Patterns {
    /// These with all derivatives of every function that has a nonzero where these have none,
    /// somewhere on `trajectory`; `None` where they hold.
    ///
    /// Operations are recorded at one place. A function that takes others elsewhere, by `if` on a
    /// value, is found out here, unless it does so between the points looked at; one that never asked
    /// for a value has no others. Derivatives that a problem brings itself are looked at in any case.
    pub fn widened(
        &self,
        ocp: &dyn DynOcp,
        formulation: &Formulation,
        trajectory: &Discretization,
    ) -> Option<Self> {
        let mut wide = self.clone();
        let last = trajectory.mesh.points();
        let states = |k| trajectory.state(k);
        let times = [trajectory.initial_time, trajectory.duration];
        let (parameters, integrals) = (&trajectory.parameters[..], &trajectory.integrals[..]);
        let in_ends = Check::new(ocp, formulation, Part::Ends);
        let at = [states(0), states(last), parameters, integrals, &times].concat();
        if in_ends.denies(&self.ends, &at) {
            wide.ends = in_ends.dense;
        }
        for (w, point) in formulation.way_points.iter().enumerate() {
            let check = Check::new(ocp, formulation, Part::WayPoint(w));
            let node = trajectory.mesh.node_at(point.fraction);
            let at = node.map(|k| [states(k), parameters, &times].concat());
            if at.is_some_and(|at| check.denies(&self.way_points[w], &at)) {
                wide.way_points[w] = check.dense;
            }
        }
        if let Some(dense) = denied_on_path(ocp, formulation, &self.node, trajectory) {
            wide.node = dense;
        }
        (wide != *self).then_some(wide)
    }
}

/// All derivatives of a point's functions where `pattern` does not have all that are nonzero.
fn denied_on_path(
    ocp: &dyn DynOcp,
    formulation: &Formulation,
    pattern: &Sparsity,
    trajectory: &Discretization,
) -> Option<Sparsity> {
    let rounding = match ocp.own_derivatives() {
        Some(_) => ROUNDING,
        None if !pattern.may_branch => return None,
        None => 0.0,
    };
    let outputs = Part::Point.outputs(formulation);
    let dense = all(Part::Point, formulation, &path_times(formulation));
    if *pattern == dense {
        return None;
    }
    let mut derivatives = NodeDerivatives::new(ocp, formulation, dense.clone());
    let times = trajectory.times();
    let points = trajectory.mesh.points();
    let count = points.min(POINTS);
    // Both ends and evenly in between.
    let mut places = (0..count).map(|i| i * (points - 1) / (count - 1).max(1));
    let mut first = vec![0.0; derivatives.jacobian_nonzeros()];
    let mut second = vec![0.0; dense.hessian.len()];
    let denied = places.any(|k| {
        let own = [trajectory.state(k), trajectory.control(k)].concat();
        let at = [&own, &trajectory.parameters, &times[k..=k]].concat();
        derivatives.jacobian(&at, &mut first);
        let missed = first_missed(&dense, pattern, &first, rounding);
        missed || {
            let weights = weights(outputs, |_| true);
            derivatives.hessian(&at, &weights, &mut second);
            second_missed(&dense, pattern, &second, rounding) || {
                let size = largest(&second);
                let straight = |r: usize| !pattern.curved.contains(&r);
                let weights = self::weights(outputs, straight);
                derivatives.hessian(&at, &weights, &mut second);
                largest(&second) > rounding * size
            }
        }
    });
    denied.then_some(dense)
}

/// Ends or a way-point with all of the derivatives.
struct Check<'a> {
    ocp: &'a dyn DynOcp,
    formulation: &'a Formulation,
    part: Part,
    dense: Sparsity,
}

impl<'a> Check<'a> {
    fn new(ocp: &'a dyn DynOcp, formulation: &'a Formulation, part: Part) -> Self {
        Self {
            ocp,
            formulation,
            part,
            dense: all(part, formulation, &end_times(formulation)),
        }
    }

    /// Whether a derivative at `at` is nonzero that `pattern` does not have.
    fn denies(&self, pattern: &Sparsity, at: &[f64]) -> bool {
        let (dense, outputs) = (&self.dense, self.part.outputs(self.formulation));
        if !pattern.may_branch {
            return false;
        }
        let mut derivatives = self
            .ocp
            .differentiate(self.part, self.formulation, dense.clone());
        let mut first = vec![0.0; dense.nonzeros()];
        derivatives.jacobian(at, &mut first);
        let mut second = vec![0.0; dense.hessian.len()];
        derivatives.hessian(at, &weights(outputs, |_| true), &mut second);
        if first_missed(dense, pattern, &first, 0.0) || second_missed(dense, pattern, &second, 0.0)
        {
            return true;
        }
        let straight = |r: usize| !pattern.curved.contains(&r);
        derivatives.hessian(at, &weights(outputs, straight), &mut second);
        largest(&second) > 0.0
    }
}

/// Every derivative of `part`, whose last inputs are times.
fn all(part: Part, formulation: &Formulation, times: &[bool]) -> Sparsity {
    Sparsity::dense(part.outputs(formulation), &used(part, formulation, times))
}

/// Weights of the outputs that are `wanted`: so different that nothing cancels.
fn weights(outputs: usize, wanted: impl Fn(usize) -> bool) -> Vec<f64> {
    let weight = |r: usize| (1.0 + r as f64).sqrt();
    let weigh = |r| if wanted(r) { weight(r) } else { 0.0 };
    (0..outputs).map(weigh).collect()
}

/// Whether one of the `values` of all first derivatives is nonzero where `pattern` has none.
fn first_missed(dense: &Sparsity, pattern: &Sparsity, values: &[f64], rounding: f64) -> bool {
    let mut values = values.iter();
    dense
        .jacobian
        .iter()
        .zip(&pattern.jacobian)
        .any(|(all, known)| {
            let row: Vec<f64> = values.by_ref().take(all.len()).copied().collect();
            let least = rounding * largest(&row);
            let mut entries = all.iter().zip(&row);
            entries.any(|(input, value)| value.abs() > least && !known.contains(input))
        })
}

/// The same of all second derivatives.
fn second_missed(dense: &Sparsity, pattern: &Sparsity, values: &[f64], rounding: f64) -> bool {
    let least = rounding * largest(values);
    let mut entries = dense.hessian.iter().zip(values);
    entries.any(|(pair, value)| value.abs() > least && !pattern.hessian.contains(pair))
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}
