//! ∫‖τ‖² dt, one weight a joint.

use super::breakdown::Side;
use super::term::{PathTerm, some, weighted_squares};
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::{CostId, Problem};
use crate::system::instant::{Instant, Needs};
use crate::system::linearization::{Adjoint, Linearization, Lower};

/// Weights of the squared torques.
#[derive(Debug, Clone)]
pub(crate) struct TorqueTerm(Vec<f64>);

impl TorqueTerm {
    /// The term of `problem`; `None` without weights.
    pub fn new(problem: &Problem) -> Option<Self> {
        some(&problem.cost.torque).map(Self)
    }
}

impl<Sp: Space> PathTerm<Sp> for TorqueTerm {
    fn id(&self) -> CostId {
        CostId::Torque
    }

    fn side(&self) -> Side {
        Side::Joints
    }

    fn needs(&self) -> Needs {
        Needs {
            torque: true,
            ..Needs::default()
        }
    }

    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        weighted_squares(&self.0, at.torque)
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]) {
        for (j, weight) in self.0.iter().enumerate() {
            let slope = 2.0 * weight * at.torque[j];
            for (k, by) in at.torque_by(j).iter().enumerate() {
                row[at.position(k)] += slope * by;
                row[at.control(k)] += slope * at.mass(j, k);
            }
        }
    }

    fn weigh(&self, at: &Linearization<'_, Sp>, weight: f64, adjoint: &mut Adjoint<'_>) {
        let torques = self.0.iter().zip(at.torque);
        for (to, (own, torque)) in adjoint.torque.iter_mut().zip(torques) {
            *to += 2.0 * weight * own * torque;
        }
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        let n = at.joints();
        for k in 0..n {
            for l in 0..n {
                let [mut positions, mut mixed, mut controls] = [0.0; 3];
                for (j, own) in self.0.iter().enumerate() {
                    let square = 2.0 * weight * own;
                    let (by_k, by_l) = (at.torque_by(j)[k], at.torque_by(j)[l]);
                    positions += square * by_k * by_l;
                    mixed += square * at.mass(j, k) * by_l;
                    controls += square * at.mass(j, k) * at.mass(j, l);
                }
                if l <= k {
                    hessian.add(at.position(k), at.position(l), positions);
                    hessian.add(at.control(k), at.control(l), controls);
                }
                hessian.add(at.control(k), at.position(l), mixed);
            }
        }
    }
}
