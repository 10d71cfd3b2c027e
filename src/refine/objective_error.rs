//! An estimate of the error of J that the mesh leaves, from the multipliers.
//!
//! Derived in docs/algorithms.md#objective-error.

use super::mesh_solve::Solved;
use crate::collocation::Rule;
use crate::ocp::{DynOcp, Functions, Point};
use crate::transcription::Discretization;
use std::collections::HashMap;

/// By how many points the quadrature is finer than the mesh.
const MORE: usize = 3;

/// J without the error of the mesh, less the J that was found, to first order; NaN where a function is.
///
/// What the polynomials leave of the dynamics between the points, ∫ μᵀ(Ẋ − ½h f) dτ with the multipliers μ
/// of the defects a unit of τ, and what quadrature leaves of the cost and of the integrals. The optimal cost
/// changes so where rows are perturbed: Nocedal & Wright, *Numerical Optimization*, 2nd ed., section 12.8
/// (DOI 10.1007/978-0-387-40065-5).
pub(super) fn objective_error(ocp: &dyn DynOcp, solved: &Solved) -> f64 {
    let trajectory = &solved.trajectory;
    let (mesh, layout, multipliers) = (
        &trajectory.mesh,
        &solved.layout,
        &solved.iterate.multipliers,
    );
    if multipliers.len() != layout.rows() {
        return f64::NAN;
    }
    let mut functions = Along::new(ocp, trajectory);
    let prices: Vec<f64> = (0..functions.integrands.len())
        .map(|i| multipliers[layout.integral_row(i)])
        .collect();
    let mut dx = vec![0.0; trajectory.states];
    let mut finer: HashMap<usize, Rule> = HashMap::new();
    let mut error = 0.0;
    for s in 0..mesh.segments() {
        let rule = mesh.rule(s);
        let half = 0.5 * mesh.width(s) * trajectory.duration;
        // The integrand of J with the integrals at their prices.
        let mut quadrature = 0.0;
        for (tau, weight) in rule.points().iter().zip(rule.weights()) {
            quadrature += weight * half * functions.at(s, *tau, &prices);
        }
        let fine = finer
            .entry(rule.len() + MORE)
            .or_insert_with_key(|points| Rule::new(*points));
        let mut exact = 0.0;
        for (tau, weight) in fine.points().iter().zip(fine.weights()) {
            exact += weight * half * functions.at(s, *tau, &prices);
            trajectory.state_derivative_in(s, *tau, &mut dx);
            let basis = rule.control().basis(*tau);
            for (i, (dx, f)) in dx.iter().zip(&functions.rates).enumerate() {
                let row = |k: usize| layout.defect(mesh.start(s) + k, i);
                let at_points = basis.iter().zip(rule.weights()).enumerate();
                let price: f64 = at_points
                    .map(|(k, (basis, w))| basis * multipliers[row(k)] / w)
                    .sum();
                error += weight * price * (dx - half * f);
            }
        }
        error += exact - quadrature;
    }
    error
}

/// The problem's functions along a trajectory.
struct Along<'a> {
    functions: Box<dyn Functions + 'a>,
    trajectory: &'a Discretization,
    x: Vec<f64>,
    u: Vec<f64>,
    rates: Vec<f64>,
    path: Vec<f64>,
    integrands: Vec<f64>,
}

impl<'a> Along<'a> {
    fn new(ocp: &'a dyn DynOcp, trajectory: &'a Discretization) -> Self {
        let formulation = ocp.formulation();
        Self {
            functions: ocp.functions(),
            trajectory,
            x: vec![0.0; trajectory.states],
            u: vec![0.0; trajectory.controls],
            rates: vec![0.0; trajectory.states],
            path: vec![0.0; formulation.path.len()],
            integrands: vec![0.0; formulation.integrals.len()],
        }
    }

    /// Evaluates the rates; the running cost less the integrands at their prices is returned.
    fn at(&mut self, s: usize, tau: f64, prices: &[f64]) -> f64 {
        let trajectory = self.trajectory;
        trajectory.state_in(s, tau, &mut self.x);
        trajectory.control_in(s, tau, &mut self.u);
        let t = trajectory.time(trajectory.mesh.fraction(s, tau));
        let point: Point<'_, f64> = trajectory.point(&self.x, &self.u, t);
        let cost = self
            .functions
            .continuous(point, &mut self.rates, &mut self.path);
        if prices.is_empty() {
            return cost;
        }
        self.functions.integrands(point, &mut self.integrands);
        let priced = prices.iter().zip(&self.integrands);
        cost - priced.map(|(price, g)| price * g).sum::<f64>()
    }
}
