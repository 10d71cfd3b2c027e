//! Limits on the joint torques τ = Hu.

use super::{BoundId, Component, PathRows, Row, of_joint};
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::{LimitId, Problem, Unit};
use crate::system::instant::{Instant, Needs};
use crate::system::linearization::{Adjoint, Linearization};

/// One row a joint.
#[derive(Debug, Clone)]
pub(crate) struct TorqueRows(Vec<Row>);

impl TorqueRows {
    /// The rows of `problem`; `None` where no torque is limited.
    pub fn new(problem: &Problem) -> Option<Self> {
        let bounds = &problem.limits.torque;
        let row = |(j, bounds)| {
            let id = BoundId::new(LimitId::Torque, Component::Joint(j));
            let joint = &problem.robot.joints()[j];
            Row::new(
                id,
                Unit::effort(joint.kind),
                of_joint("torque", joint),
                bounds,
            )
        };
        bounds
            .iter()
            .any(|bound| !bound.is_free())
            .then(|| Self(bounds.iter().copied().enumerate().map(row).collect()))
    }
}

impl<Sp: Space> PathRows<Sp> for TorqueRows {
    fn rows(&self) -> &[Row] {
        &self.0
    }

    fn needs(&self) -> Needs {
        Needs {
            torque: true,
            ..Needs::default()
        }
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        rows.copy_from_slice(at.torque);
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        let n = at.joints();
        for (j, row) in rows.chunks_exact_mut(at.width()).enumerate() {
            row[at.position(0)..at.position(n)].copy_from_slice(at.torque_by(j));
            for k in 0..n {
                row[at.control(k)] = at.mass(j, k);
            }
        }
    }

    fn weigh(&self, _at: &Linearization<'_, Sp>, weights: &[f64], adjoint: &mut Adjoint<'_>) {
        for (to, weight) in adjoint.torque.iter_mut().zip(weights) {
            *to += weight;
        }
    }
}
