//! What the base has become at t_f, and t_f itself.

use super::breakdown::Side;
use super::term::{EndTerm, some, weighted_squares};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::problem::{CostId, Problem};
use crate::system::instant::{Needs, Pose};
use crate::system::plant::Plant;

/// ‖η(t_f)‖², one weight an angle; where η are no angles φ(t_f)², the squared rotation angle.
#[derive(Debug, Clone)]
pub(crate) enum FinalAttitudeTerm {
    Angles(Vec<f64>),
    Rotation(f64),
}

impl FinalAttitudeTerm {
    /// The term of `problem`; `None` without weights.
    pub fn new<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Option<Self> {
        let weights = some(&problem.cost.final_base_attitude)?;
        Some(match weights[..] {
            [weight] if !plant.attitude.is_angles() => Self::Rotation(weight),
            _ => Self::Angles(weights),
        })
    }
}

impl<Sp: Space> EndTerm<Sp> for FinalAttitudeTerm {
    fn id(&self) -> CostId {
        CostId::FinalBaseAttitude
    }

    fn side(&self) -> Side {
        Side::Base
    }

    fn value<S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S {
        match self {
            Self::Angles(weights) => weighted_squares(weights, at.eta),
            Self::Rotation(weight) => at.plant.attitude.squared_rotation_angle(at.eta) * *weight,
        }
    }
}

/// ‖ζ(t_f) − ζ(t₀)‖², one weight a length.
#[derive(Debug, Clone)]
pub(crate) struct FinalPositionTerm(Vec<f64>);

impl FinalPositionTerm {
    /// The term of `problem`; `None` without weights.
    pub fn new(problem: &Problem) -> Option<Self> {
        some(&problem.cost.final_base_position).map(Self)
    }
}

impl<Sp: Space> EndTerm<Sp> for FinalPositionTerm {
    fn id(&self) -> CostId {
        CostId::FinalBasePosition
    }

    fn side(&self) -> Side {
        Side::Base
    }

    fn needs(&self) -> Needs {
        Needs {
            end_pose: true,
            ..Needs::default()
        }
    }

    fn value<S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S {
        let end = at.plant.base_position(at.eta, at.t, &at.data.system_center);
        let start = at.plant.start_position.components();
        let mut sum = S::zero();
        for ((&weight, &z), &z0) in self.0.iter().zip(end.components()).zip(start) {
            sum += (z - z0).square() * weight;
        }
        sum
    }
}

/// The duration, weighted.
#[derive(Debug, Clone)]
pub(crate) struct DurationTerm(f64);

impl DurationTerm {
    /// The term of `problem`; `None` without a weight.
    pub fn new(problem: &Problem) -> Option<Self> {
        let weight = problem.cost.duration;
        (weight > 0.0).then_some(Self(weight))
    }
}

impl<Sp: Space> EndTerm<Sp> for DurationTerm {
    fn id(&self) -> CostId {
        CostId::Duration
    }

    fn side(&self) -> Side {
        Side::Both
    }

    fn value<S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S {
        at.t * self.0
    }
}
