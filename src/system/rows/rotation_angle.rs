//! Limits on the rotation angle of the base, where its attitude is not described by angles.

use super::{BoundId, Component, EndRows, Measure, PathRows, Row};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::Interval;
use crate::problem::{LimitId, Problem, Unit};
use crate::system::instant::{Instant, Needs, Pose};
use crate::system::linearization::{Adjoint, Linearization};
use crate::system::plant::Plant;
use std::f64::consts::PI;
use std::slice;

/// What a person calls the rotation angle.
pub(crate) const NAME: &str = "base rotation angle";

/// A limit on the rotation angle φ as the row (φ/bound)² ≤ 1; φ itself is not smooth at zero.
///
/// A bound of zero is no such row, which would have no gradient where it holds, but holds the
/// parameters themselves ([`held`]); from half a turn on there is no limit.
#[derive(Debug, Clone)]
pub(crate) struct RotationAngleRow {
    row: Row,
    /// 1/bound².
    factor: f64,
}

impl RotationAngleRow {
    /// The limit along the path.
    pub fn path<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Option<Self> {
        let [along, _] = limits(problem, plant)?;
        Self::new(LimitId::BaseAttitude, along)
    }

    /// The limits at t_f: its own, and that along the path, which no path row holds there.
    pub fn ends<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> impl Iterator<Item = Self> {
        let limits = limits(problem, plant).into_iter();
        limits.flat_map(|[along, last]| {
            // Never two rows of which both could be at their bound.
            let along = Some(along).filter(|&along| along < last);
            let end = Self::new(LimitId::FinalBaseAttitude, last);
            let along = along.and_then(|along| Self::new(LimitId::BaseAttitude, along));
            end.into_iter().chain(along)
        })
    }

    fn new(limit: LimitId, bound: f64) -> Option<Self> {
        let id = BoundId::new(limit, Component::RotationAngle);
        let bounds = Interval::new(f64::NEG_INFINITY, 1.0);
        let row = Row {
            measure: Measure::SquaredRatio { bound },
            // Of the squares: twice the relative excess of the angle, to first order.
            ..Row::new(id, Unit::Radian, NAME, bounds).sized(2.0)
        };
        (bound > 0.0 && bound < PI).then(|| Self {
            row,
            factor: bound.powi(-2),
        })
    }
}

/// The largest rotation angle along the path and at t_f, rad, infinite where not limited; `None`
/// where each angle has its own limits.
fn limits<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Option<[f64; 2]> {
    let limits = &problem.limits;
    let bounds = [&limits.base_attitude, &limits.final_base_attitude];
    (!plant.attitude.is_angles()).then(|| bounds.map(|bounds| bounds[0].upper))
}

/// Whether a bound of zero holds the base where it was: along the path, and at t_f; `None` where
/// each angle has its own limits.
pub(crate) fn held<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Option<[bool; 2]> {
    limits(problem, plant).map(|bounds| bounds.map(|bound| bound == 0.0))
}

impl<Sp: Space> PathRows<Sp> for RotationAngleRow {
    fn rows(&self) -> &[Row] {
        slice::from_ref(&self.row)
    }

    fn needs(&self) -> Needs {
        Needs {
            rotation: true,
            ..Needs::default()
        }
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        EndRows::<Sp>::values(self, &at.pose, rows);
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        for (to, by) in rows.iter_mut().zip(at.squared_rotation_by()) {
            *to = self.factor * by;
        }
    }

    fn weigh(&self, _at: &Linearization<'_, Sp>, weights: &[f64], adjoint: &mut Adjoint<'_>) {
        adjoint.squared_rotation[0] += self.factor * weights[0];
    }
}

impl<Sp: Space> EndRows<Sp> for RotationAngleRow {
    fn rows(&self) -> &[Row] {
        slice::from_ref(&self.row)
    }

    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]) {
        rows[0] = at.plant.attitude.squared_rotation_angle(at.eta) * self.factor;
    }
}
