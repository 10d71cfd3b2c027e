//! Patterns held against all derivatives at a few points, should operations have been missed.

use super::Discretization;
use super::functions::{Boundary, Node, WayPoint};
use super::node_derivatives::NodeDerivatives;
use super::patterns::{Patterns, end_times, path_times, used};
use crate::autodiff::{Function, SparseDerivatives, Sparsity};
use crate::ocp::{Formulation, Ocp};

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
    pub fn widened<O: Ocp>(
        &self,
        ocp: &O,
        formulation: &Formulation,
        trajectory: &Discretization,
    ) -> Option<Self> {
        let mut wide = self.clone();
        let last = trajectory.mesh.points();
        let states = |k| trajectory.state(k);
        let times = [trajectory.initial_time, trajectory.duration];
        let (parameters, integrals) = (&trajectory.parameters[..], &trajectory.integrals[..]);
        let ends = Boundary::new(ocp, formulation);
        let in_ends = Check::new(&ends, &end_times(formulation));
        let at = [states(0), states(last), parameters, integrals, &times].concat();
        if in_ends.denies(&self.ends, &at) {
            wide.ends = in_ends.dense;
        }
        for (w, point) in formulation.way_points.iter().enumerate() {
            let function = WayPoint::new(ocp, formulation, w);
            let check = Check::new(&function, &end_times(formulation));
            let node = trajectory.mesh.node_at(point.fraction);
            let at = node.map(|k| [states(k), parameters, &times].concat());
            if at.is_some_and(|at| check.denies(&self.way_points[w], &at)) {
                wide.way_points[w] = check.dense;
            }
        }
        let node = Node::new(ocp, formulation);
        let time = path_times(formulation);
        if let Some(dense) = denied_on_path(&node, &self.node, trajectory, &time) {
            wide.node = dense;
        }
        (wide != *self).then_some(wide)
    }
}

/// All derivatives of a point's functions where `pattern` does not have all that are nonzero.
fn denied_on_path<O: Ocp>(
    node: &Node<'_, O>,
    pattern: &Sparsity,
    trajectory: &Discretization,
    time: &[bool],
) -> Option<Sparsity> {
    let rounding = match node.ocp.derivatives() {
        Some(_) => ROUNDING,
        None if !pattern.may_branch => return None,
        None => 0.0,
    };
    let dense = all(node, time);
    if *pattern == dense {
        return None;
    }
    let mut derivatives = NodeDerivatives::new(node, dense.clone());
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
        derivatives.jacobian(node, &at, &mut first);
        let missed = first_missed(&dense, pattern, &first, rounding);
        missed || {
            let weights = weights(node.outputs(), |_| true);
            derivatives.hessian(node, &at, &weights, &mut second);
            second_missed(&dense, pattern, &second, rounding) || {
                let size = largest(&second);
                let straight = |r: usize| !pattern.curved.contains(&r);
                let weights = self::weights(node.outputs(), straight);
                derivatives.hessian(node, &at, &weights, &mut second);
                largest(&second) > rounding * size
            }
        }
    });
    denied.then_some(dense)
}

/// A function with all of its derivatives.
struct Check<'f, F: Function> {
    function: &'f F,
    dense: Sparsity,
}

impl<'f, F: Function> Check<'f, F> {
    fn new(function: &'f F, times: &[bool]) -> Self {
        Self {
            function,
            dense: all(function, times),
        }
    }

    /// Whether a derivative at `at` is nonzero that `pattern` does not have.
    fn denies(&self, pattern: &Sparsity, at: &[f64]) -> bool {
        let (f, dense) = (self.function, &self.dense);
        if !pattern.may_branch {
            return false;
        }
        let mut derivatives = SparseDerivatives::new(f, dense.clone());
        let mut first = vec![0.0; derivatives.jacobian_nonzeros()];
        derivatives.jacobian(f, at, &mut first);
        let mut second = vec![0.0; dense.hessian.len()];
        derivatives.hessian(f, at, &weights(f.outputs(), |_| true), &mut second);
        if first_missed(dense, pattern, &first, 0.0) || second_missed(dense, pattern, &second, 0.0)
        {
            return true;
        }
        let straight = |r: usize| !pattern.curved.contains(&r);
        derivatives.hessian(f, at, &weights(f.outputs(), straight), &mut second);
        largest(&second) > 0.0
    }
}

/// Every derivative of `f`, whose last inputs are times.
fn all<F: Function>(f: &F, times: &[bool]) -> Sparsity {
    Sparsity::dense(f.outputs(), &used(f, times))
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
