//! ∫‖η‖² dt, one weight an angle; where η are no angles ∫φ² dt of the rotation angle.

use super::breakdown::Side;
use super::term::{PathTerm, some, weighted_squares};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::problem::{CostId, Problem};
use crate::system::instant::{Instant, Needs};
use crate::system::linearization::{Adjoint, Linearization, Lower};
use crate::system::plant::Plant;

/// Weights of the squared angles, or of the squared rotation angle.
#[derive(Debug, Clone)]
pub(crate) enum BaseAttitudeTerm {
    Angles(Vec<f64>),
    Rotation(f64),
}

impl BaseAttitudeTerm {
    /// The term of `problem`; `None` without weights.
    pub fn new<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Option<Self> {
        let weights = some(&problem.cost.base_attitude)?;
        Some(match weights[..] {
            [weight] if !plant.attitude.is_angles() => Self::Rotation(weight),
            _ => Self::Angles(weights),
        })
    }
}

impl<Sp: Space> PathTerm<Sp> for BaseAttitudeTerm {
    fn id(&self) -> CostId {
        CostId::BaseAttitude
    }

    fn side(&self) -> Side {
        Side::Base
    }

    fn needs(&self) -> Needs {
        Needs {
            rotation: matches!(self, Self::Rotation(_)),
            ..Needs::default()
        }
    }

    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        let pose = &at.pose;
        match self {
            Self::Angles(weights) => weighted_squares(weights, pose.eta),
            Self::Rotation(weight) => {
                pose.plant.attitude.squared_rotation_angle(pose.eta) * *weight
            }
        }
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]) {
        match self {
            Self::Angles(weights) => {
                for ((to, weight), angle) in row.iter_mut().zip(weights).zip(at.point.x) {
                    *to += 2.0 * weight * angle;
                }
            }
            Self::Rotation(weight) => {
                for (to, by) in row.iter_mut().zip(at.squared_rotation_by()) {
                    *to += weight * by;
                }
            }
        }
    }

    fn weigh(&self, _at: &Linearization<'_, Sp>, weight: f64, adjoint: &mut Adjoint<'_>) {
        if let Self::Rotation(own) = self {
            adjoint.squared_rotation[0] += weight * own;
        }
    }

    fn curvature(&self, _at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        if let Self::Angles(weights) = self {
            for (i, own) in weights.iter().enumerate() {
                hessian.add(i, i, 2.0 * weight * own);
            }
        }
    }
}
