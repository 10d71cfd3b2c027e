//! ∫‖u‖² dt, one weight a joint.

use super::breakdown::Side;
use super::term::{PathTerm, some, weighted_squares};
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::{CostId, Problem};
use crate::system::instant::Instant;
use crate::system::linearization::{Linearization, Lower};

/// Weights of the squared controls.
#[derive(Debug, Clone)]
pub(crate) struct ControlTerm(Vec<f64>);

impl ControlTerm {
    /// The term of `problem`; `None` without weights.
    pub fn new(problem: &Problem) -> Option<Self> {
        some(&problem.cost.control).map(Self)
    }
}

impl<Sp: Space> PathTerm<Sp> for ControlTerm {
    fn id(&self) -> CostId {
        CostId::Control
    }

    fn side(&self) -> Side {
        Side::Joints
    }

    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        weighted_squares(&self.0, at.u)
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]) {
        for (j, weight) in self.0.iter().enumerate() {
            row[at.control(j)] += 2.0 * weight * at.point.u[j];
        }
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        for (j, own) in self.0.iter().enumerate() {
            hessian.add(at.control(j), at.control(j), 2.0 * weight * own);
        }
    }
}
