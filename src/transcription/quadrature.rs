//! Quadrature by the LGR weights of a mesh.

use super::Discretization;
use crate::collocation::Mesh;
use crate::ocp::{DynOcp, Formulation};

/// Quadrature weight of each point, fraction of the duration; sum 1.
pub(super) fn quadrature(mesh: &Mesh) -> Vec<f64> {
    (0..mesh.segments())
        .flat_map(|s| {
            mesh.rule(s)
                .weights()
                .iter()
                .map(move |w| 0.5 * mesh.width(s) * w)
        })
        .collect()
}

/// Value of each integral of `ocp` on `trajectory`, by the quadrature of its mesh.
pub fn integrals(
    ocp: &dyn DynOcp,
    formulation: &Formulation,
    trajectory: &Discretization,
) -> Vec<f64> {
    let mut sums = vec![0.0; formulation.integrals.len()];
    if sums.is_empty() {
        return sums;
    }
    let mut functions = ocp.functions();
    let mut rates = vec![0.0; formulation.states.len()];
    let mut path = vec![0.0; formulation.path.len()];
    let mut integrands = vec![0.0; sums.len()];
    let times = trajectory.times();
    for (k, weight) in quadrature(&trajectory.mesh).into_iter().enumerate() {
        let point = trajectory.point(trajectory.state(k), trajectory.control(k), times[k]);
        functions.continuous(point, &mut rates, &mut path);
        functions.integrands(point, &mut integrands);
        for (sum, value) in sums.iter_mut().zip(&integrands) {
            *sum += trajectory.duration * weight * value;
        }
    }
    sums
}
