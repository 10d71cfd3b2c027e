//! A trajectory on a mesh: node values with the polynomials through them.

use crate::collocation::Mesh;
use crate::ocp::{Ends, Point};

/// States at all nodes and controls at all collocation points of a mesh, eq. (22).
#[derive(Debug, Clone, PartialEq)]
pub struct Discretization {
    /// The mesh.
    pub mesh: Mesh,
    /// t₀, s.
    pub initial_time: f64,
    /// Duration t_f − t₀, s.
    pub duration: f64,
    /// Static parameters.
    pub parameters: Vec<f64>,
    /// Values of the integrals, of a solution; empty where they are not known yet.
    pub integrals: Vec<f64>,
    /// Number of states.
    pub states: usize,
    /// Number of controls.
    pub controls: usize,
    /// States by nodes, (points + 1) × states.
    pub x: Vec<f64>,
    /// Controls by points, points × controls.
    pub u: Vec<f64>,
}

impl Discretization {
    /// Samples `trajectory` on `mesh`: it is given the fraction of the duration and writes states
    /// and controls. t₀ is 0, and there are no static parameters.
    pub fn sample(
        mesh: Mesh,
        duration: f64,
        states: usize,
        controls: usize,
        mut trajectory: impl FnMut(f64, &mut [f64], &mut [f64]),
    ) -> Self {
        let points = mesh.points();
        let mut x = vec![0.0; (points + 1) * states];
        let mut u = vec![0.0; (points + 1) * controls];
        for (k, fraction) in mesh.node_fractions().into_iter().enumerate() {
            trajectory(
                fraction,
                &mut x[k * states..(k + 1) * states],
                &mut u[k * controls..(k + 1) * controls],
            );
        }
        u.truncate(points * controls);
        Self {
            mesh,
            initial_time: 0.0,
            duration,
            parameters: Vec::new(),
            integrals: Vec::new(),
            states,
            controls,
            x,
            u,
        }
    }

    /// The same from `initial_time` on, with these static parameters.
    pub fn with(self, initial_time: f64, parameters: Vec<f64>) -> Self {
        Self {
            initial_time,
            parameters,
            ..self
        }
    }

    /// The same trajectory on another mesh.
    pub fn resample(&self, mesh: Mesh) -> Self {
        let sampled = Self::sample(
            mesh,
            self.duration,
            self.states,
            self.controls,
            |fraction, x, u| {
                self.at_fraction(fraction, x, u);
            },
        );
        Self {
            integrals: self.integrals.clone(),
            ..sampled.with(self.initial_time, self.parameters.clone())
        }
    }

    /// The same with the states in units of `scales`, one a state.
    pub fn in_units_of(&self, scales: &[f64]) -> Self {
        let mut scaled = self.clone();
        for row in scaled.x.chunks_exact_mut(scales.len().max(1)) {
            for (value, scale) in row.iter_mut().zip(scales) {
                *value /= scale;
            }
        }
        scaled
    }

    /// States at node `k`; node `points` is t_f.
    pub fn state(&self, k: usize) -> &[f64] {
        &self.x[k * self.states..(k + 1) * self.states]
    }

    /// Controls at point `k`.
    pub fn control(&self, k: usize) -> &[f64] {
        &self.u[k * self.controls..(k + 1) * self.controls]
    }

    /// States and controls at a fraction of the duration.
    pub fn at_fraction(&self, fraction: f64, x: &mut [f64], u: &mut [f64]) {
        let (s, tau) = self.mesh.locate(fraction);
        self.state_in(s, tau, x);
        self.control_in(s, tau, u);
    }

    /// State polynomial of segment `s` at τ.
    pub fn state_in(&self, s: usize, tau: f64, x: &mut [f64]) {
        combine(
            &self.mesh.rule(s).state().basis(tau),
            &self.x,
            self.mesh.start(s),
            x,
        );
    }

    /// Derivative dX/dτ of the state polynomial of segment `s` at τ, eq. (23).
    pub fn state_derivative_in(&self, s: usize, tau: f64, dx: &mut [f64]) {
        combine(
            &self.mesh.rule(s).state().derivative(tau),
            &self.x,
            self.mesh.start(s),
            dx,
        );
    }

    /// Control polynomial of segment `s` at τ, through its LGR points only.
    pub fn control_in(&self, s: usize, tau: f64, u: &mut [f64]) {
        combine(
            &self.mesh.rule(s).control().basis(tau),
            &self.u,
            self.mesh.start(s),
            u,
        );
    }

    /// Times of all nodes, s; length points + 1, the last is t_f.
    pub fn times(&self) -> Vec<f64> {
        self.mesh
            .node_fractions()
            .into_iter()
            .map(|fraction| self.time(fraction))
            .collect()
    }

    /// Time at a fraction of the duration, s.
    pub fn time(&self, fraction: f64) -> f64 {
        self.initial_time + fraction * self.duration
    }

    /// The instant `t` on this trajectory, with the states `x` and the controls `u` there.
    pub fn point<'a>(&'a self, x: &'a [f64], u: &'a [f64], t: f64) -> Point<'a, f64> {
        Point {
            x,
            u,
            parameters: &self.parameters,
            t,
        }
    }

    /// Both ends.
    pub fn ends(&self) -> Ends<'_, f64> {
        Ends {
            initial: self.state(0),
            terminal: self.state(self.mesh.points()),
            parameters: &self.parameters,
            integrals: &self.integrals,
            initial_time: self.initial_time,
            duration: self.duration,
        }
    }
}

/// Σ basis_j · values[start + j], values stored by rows as wide as `out`.
fn combine(basis: &[f64], values: &[f64], start: usize, out: &mut [f64]) {
    let width = out.len();
    out.fill(0.0);
    if width == 0 {
        return;
    }
    for (l, row) in basis
        .iter()
        .zip(values[start * width..].chunks_exact(width))
    {
        for (sum, value) in out.iter_mut().zip(row) {
            *sum += l * value;
        }
    }
}
