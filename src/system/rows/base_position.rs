//! Limits on the base's displacement from where it was at t₀: a box along the path.

use super::{BoundId, Component, EndRows, PathRows, Row};
use crate::autodiff::Scalar;
use crate::dynamics::space::{Space, Vector};
use crate::problem::{LimitId, Problem, Unit};
use crate::system::instant::{Instant, Pose};
use crate::system::linearization::{Linearization, Lower};
use crate::system::pose_function::{PoseVariables, Variable, add_curvature, add_gradient};

/// One row a component of ζ − ζ(t₀), inertial axes, m.
#[derive(Debug, Clone)]
pub(crate) struct BasePositionRows(Vec<Row>);

impl BasePositionRows {
    /// The rows of `problem`; `None` where no component is limited.
    pub fn new(problem: &Problem) -> Option<Self> {
        let bounds = &problem.limits.base_position;
        let row = |(i, bounds)| {
            let id = BoundId::new(LimitId::BasePosition, Component::Axis(i));
            let name = format!("base displacement {}", ["x", "y", "z"][i]);
            Row::new(id, Unit::Metre, name, bounds)
        };
        bounds
            .iter()
            .any(|bound| !bound.is_free())
            .then(|| Self(bounds.iter().copied().enumerate().map(row).collect()))
    }
}

impl<Sp: Space> PathRows<Sp> for BasePositionRows {
    fn rows(&self) -> &[Row] {
        &self.0
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        EndRows::values(self, &at.pose, rows);
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        let position = position(at);
        let rows = rows.chunks_exact_mut(at.width());
        for (row, component) in rows.zip(position.components()) {
            add_gradient(at, component, row);
        }
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weights: &[f64], hessian: &mut Lower<'_>) {
        let position = position(at);
        for (component, &weight) in position.components().iter().zip(weights) {
            add_curvature(at, component, weight, hessian);
        }
    }
}

impl<Sp: Space> EndRows<Sp> for BasePositionRows {
    fn rows(&self) -> &[Row] {
        &self.0
    }

    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]) {
        let position = at.plant.base_position(at.eta, at.t, &at.data.system_center);
        rows.copy_from_slice(position.components());
        for (row, &start) in rows.iter_mut().zip(at.plant.start_position.components()) {
            *row -= start;
        }
    }
}

/// ζ with its derivatives.
fn position<Sp: Space>(at: &Linearization<'_, Sp>) -> Sp::Linear<Variable> {
    let variables = PoseVariables::at(at);
    let (eta, center) = (variables.eta(), &variables.center);
    at.plant.base_position(eta, variables.t, center)
}
