//! The error estimate (28): defect of the dynamics between collocation points.
//!
//! Derived in docs/algorithms.md#midpoint-error.

use crate::numeric::{largest_or_nan, raise_or_nan};
use crate::ocp::DynOcp;
use crate::transcription::Discretization;

/// Largest error (28) in every segment; NaN where the rates are NaN at one of the midpoints.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// Of every state: segments × states.
    pub by_segment: Vec<Vec<f64>>,
    /// Of every integral, as of a state whose rate is the integrand: segments × integrals.
    pub integrals: Vec<Vec<f64>>,
}

/// What has the largest error in a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Erring {
    /// A state.
    State(usize),
    /// An integral.
    Integral(usize),
}

impl Errors {
    /// The largest of all; NaN where one is NaN.
    pub fn max(&self) -> f64 {
        let rows = self.by_segment.iter().chain(&self.integrals);
        largest_or_nan(rows.flatten().copied())
    }

    /// The same in units of `states` and `integrals`, one for each.
    pub fn in_units_of(mut self, states: &[f64], integrals: &[f64]) -> Self {
        let divide = |rows: &mut [Vec<f64>], scales: &[f64]| {
            for (error, scale) in rows.iter_mut().flat_map(|row| row.iter_mut().zip(scales)) {
                *error /= scale;
            }
        };
        divide(&mut self.by_segment, states);
        divide(&mut self.integrals, integrals);
        self
    }

    /// What has the largest error in segment `s`, and that error; one that is NaN counts as the
    /// largest.
    pub fn worst(&self, s: usize) -> (Erring, f64) {
        let largest = |row: &[f64]| {
            let indexed = row.iter().copied().enumerate();
            indexed.max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let state = largest(&self.by_segment[s]).unwrap_or((0, 0.0));
        match largest(&self.integrals[s]) {
            Some((i, error)) if error.total_cmp(&state.1).is_gt() => (Erring::Integral(i), error),
            _ => (Erring::State(state.0), state.1),
        }
    }
}

/// e = |Ẋ(τ̂) − (t_s − t_{s−1})/2 · f(X(τ̂), U(τ̂))| at the midpoints τ̂ between the N + 1
/// consecutive state nodes of each segment, so that K = N of them.
///
/// An integral counts as a state whose rate is its integrand: its polynomial has the integrand at the
/// points as derivative.
///
/// The control is interpolated through the N LGR points, which extrapolates it to the last
/// midpoint.
pub fn midpoint_errors(ocp: &dyn DynOcp, trajectory: &Discretization) -> Errors {
    let n = trajectory.states;
    let formulation = ocp.formulation();
    let mut functions = ocp.functions();
    let (mut x, mut dx, mut f) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut u = vec![0.0; trajectory.controls];
    let mut path = vec![0.0; formulation.path.len()];
    let count = formulation.integrals.len();
    let mut g = vec![0.0; count];
    let mesh = &trajectory.mesh;
    let mut errors = Errors {
        by_segment: Vec::new(),
        integrals: Vec::new(),
    };
    for s in 0..mesh.segments() {
        let half = 0.5 * mesh.width(s) * trajectory.duration;
        let rule = mesh.rule(s);
        let mut at = |tau: f64, x: &mut [f64], f: &mut [f64], g: &mut [f64]| {
            trajectory.state_in(s, tau, x);
            trajectory.control_in(s, tau, &mut u);
            let point = trajectory.point(x, &u, trajectory.time(mesh.fraction(s, tau)));
            functions.continuous(point, f, &mut path);
            if count > 0 {
                functions.integrands(point, g);
            }
        };
        let integrated = match count {
            0 => Vec::new(),
            _ => rule.nodes()[..rule.len()]
                .iter()
                .flat_map(|&tau| {
                    at(tau, &mut x, &mut f, &mut g);
                    g.clone()
                })
                .collect(),
        };
        let mut worst = vec![0.0_f64; n];
        let mut worst_integrals = vec![0.0_f64; count];
        for pair in rule.nodes().windows(2) {
            let tau = 0.5 * (pair[0] + pair[1]);
            at(tau, &mut x, &mut f, &mut g);
            trajectory.state_derivative_in(s, tau, &mut dx);
            for i in 0..n {
                raise_or_nan(&mut worst[i], (dx[i] - half * f[i]).abs());
            }
            if count == 0 {
                continue;
            }
            let basis = rule.control().basis(tau);
            for (i, worst) in worst_integrals.iter_mut().enumerate() {
                let known = basis.iter().zip(integrated.chunks_exact(count));
                let between: f64 = known.map(|(l, g)| l * g[i]).sum();
                raise_or_nan(worst, half * (between - g[i]).abs());
            }
        }
        errors.by_segment.push(worst);
        errors.integrals.push(worst_integrals);
    }
    errors
}
