//! The error estimate (28): defect of the dynamics between collocation points.
//!
//! Derived in docs/algorithms.md#midpoint-error.

use crate::largest::{largest, raise};
use crate::ocp::Ocp;
use crate::transcription::Discretization;

/// Largest error (28) of every state in every segment; NaN where the rates are NaN at one of the
/// midpoints.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// Segments × states.
    pub by_segment: Vec<Vec<f64>>,
}

impl Errors {
    /// The largest of all; NaN where one is NaN.
    pub fn max(&self) -> f64 {
        largest(self.by_segment.iter().flatten().copied())
    }

    /// The same in units of `scales`, one a state.
    pub fn in_units_of(mut self, scales: &[f64]) -> Self {
        for row in &mut self.by_segment {
            for (error, scale) in row.iter_mut().zip(scales) {
                *error /= scale;
            }
        }
        self
    }

    /// The state with the largest error in segment `s`, and that error; one that is NaN counts as
    /// the largest.
    pub fn worst(&self, s: usize) -> (usize, f64) {
        let row = &self.by_segment[s];
        let state = (0..row.len())
            .max_by(|&a, &b| row[a].total_cmp(&row[b]))
            .unwrap_or(0);
        (state, row.get(state).copied().unwrap_or(0.0))
    }
}

/// e = |Ẋ(τ̂) − (t_s − t_{s−1})/2 · f(X(τ̂), U(τ̂))| at the midpoints τ̂ between the N + 1
/// consecutive state nodes of each segment, so that K = N of them.
///
/// The control is interpolated through the N LGR points, which extrapolates it to the last
/// midpoint.
pub fn midpoint_errors<O: Ocp>(ocp: &O, trajectory: &Discretization) -> Errors {
    let n = trajectory.states;
    let mut scratch = ocp.scratch::<f64>();
    let (mut x, mut dx, mut f) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut u = vec![0.0; trajectory.controls];
    let mut path = vec![0.0; ocp.formulation().path.len()];
    let mesh = &trajectory.mesh;
    let by_segment = (0..mesh.segments())
        .map(|s| {
            let half = 0.5 * mesh.width(s) * trajectory.duration;
            let mut worst = vec![0.0_f64; n];
            for pair in mesh.rule(s).nodes().windows(2) {
                let tau = 0.5 * (pair[0] + pair[1]);
                trajectory.state_in(s, tau, &mut x);
                trajectory.state_derivative_in(s, tau, &mut dx);
                trajectory.control_in(s, tau, &mut u);
                let point = trajectory.point(&x, &u, trajectory.time(mesh.fraction(s, tau)));
                ocp.continuous(point, &mut scratch, &mut f, &mut path);
                for i in 0..n {
                    raise(&mut worst[i], (dx[i] - half * f[i]).abs());
                }
            }
            worst
        })
        .collect();
    Errors { by_segment }
}
