//! ∫‖ζ − ζ(t₀)‖² dt, one weight a length.

use super::breakdown::Side;
use super::term::{PathTerm, some};
use crate::autodiff::Scalar;
use crate::dynamics::space::{Space, Vector};
use crate::problem::{CostId, Problem};
use crate::system::instant::Instant;
use crate::system::linearization::{Linearization, Lower};
use crate::system::plant::Plant;
use crate::system::pose_function::{PoseVariables, Variable, add_curvature, add_gradient};

/// Weights of the squared displacement of the base.
#[derive(Debug, Clone)]
pub(crate) struct BasePositionTerm(Vec<f64>);

impl BasePositionTerm {
    /// The term of `problem`; `None` without weights.
    pub fn new(problem: &Problem) -> Option<Self> {
        some(&problem.cost.base_position).map(Self)
    }

    fn of<Sp: Space, S: Scalar>(
        &self,
        plant: &Plant<Sp>,
        eta: &[S],
        t: S,
        center: &Sp::Linear<S>,
    ) -> S {
        let moved = plant.base_displacement(eta, t, center);
        let mut sum = S::zero();
        for (&weight, z) in self.0.iter().zip(moved.components()) {
            sum += z.square() * weight;
        }
        sum
    }

    fn with_derivatives<Sp: Space>(&self, at: &Linearization<'_, Sp>) -> Variable {
        let variables = PoseVariables::at(at);
        self.of(at.plant, variables.eta(), variables.t, &variables.center)
    }
}

impl<Sp: Space> PathTerm<Sp> for BasePositionTerm {
    fn id(&self) -> CostId {
        CostId::BasePosition
    }

    fn side(&self) -> Side {
        Side::Base
    }

    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        let pose = &at.pose;
        self.of(pose.plant, pose.eta, pose.t, &pose.data.system_center)
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]) {
        add_gradient(at, &self.with_derivatives(at), row);
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        add_curvature(at, &self.with_derivatives(at), weight, hessian);
    }
}
