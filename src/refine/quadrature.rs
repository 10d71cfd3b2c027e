//! A second error estimate, of the states themselves instead of their derivatives.
//!
//! Derived in docs/algorithms.md#quadrature-error.

use crate::collocation::Rule;
use crate::numeric::raise_or_nan;
use crate::ocp::DynOcp;
use crate::transcription::Discretization;
use nalgebra::DMatrix;
use std::collections::HashMap;

/// Largest relative error of any state, NaN where it has none, by integrating f along the interpolated solution on one
/// more LGR point a segment.
///
/// M. A. Patterson, W. W. Hager and A. V. Rao, "A ph mesh refinement method for optimal control",
/// doi:10.1002/oca.2114.
pub fn quadrature_error(ocp: &dyn DynOcp, trajectory: &Discretization) -> f64 {
    let n = trajectory.states;
    let mesh = &trajectory.mesh;
    let mut functions = ocp.functions();
    let mut path = vec![0.0; ocp.formulation().path.len()];
    let mut u = vec![0.0; trajectory.controls];
    let mut finer: HashMap<usize, (Rule, DMatrix<f64>)> = HashMap::new();
    let mut largest = vec![0.0_f64; n];
    for row in trajectory.x.chunks_exact(n) {
        for (peak, value) in largest.iter_mut().zip(row) {
            raise_or_nan(peak, value.abs());
        }
    }
    let mut error = 0.0_f64;
    for s in 0..mesh.segments() {
        let points = mesh.rule(s).len() + 1;
        let (rule, integration) = finer
            .entry(points)
            .or_insert_with(|| integration_matrix(points));
        let half = 0.5 * mesh.width(s) * trajectory.duration;
        let mut interpolated = DMatrix::zeros(points + 1, n);
        let mut rates = DMatrix::zeros(points, n);
        let (mut x, mut f) = (vec![0.0; n], vec![0.0; n]);
        for (j, &tau) in rule.nodes().iter().enumerate() {
            trajectory.state_in(s, tau, &mut x);
            interpolated.row_mut(j).copy_from_slice(&x);
            if j < points {
                trajectory.control_in(s, tau, &mut u);
                let point = trajectory.point(&x, &u, trajectory.time(mesh.fraction(s, tau)));
                functions.continuous(point, &mut f, &mut path);
                rates.row_mut(j).copy_from_slice(&f);
            }
        }
        let gained = &*integration * rates * half;
        for i in 0..n {
            for j in 0..points {
                let integrated = interpolated[(0, i)] + gained[(j, i)];
                let gap = (integrated - interpolated[(j + 1, i)]).abs();
                raise_or_nan(&mut error, gap / (1.0 + largest[i]));
            }
        }
    }
    error
}

/// The rule with `points` points and its integration matrix: the inverse of D without its first
/// column.
fn integration_matrix(points: usize) -> (Rule, DMatrix<f64>) {
    let rule = Rule::new(points);
    let inner = DMatrix::from_fn(points, points, |i, j| rule.differentiation(i)[j + 1]);
    let integration = inner
        .try_inverse()
        .expect("D without its first column is regular");
    (rule, integration)
}
