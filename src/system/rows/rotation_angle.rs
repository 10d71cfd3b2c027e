//! Limits on the rotation angle of the base, where its attitude is not described by angles.

use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Spatial};
use crate::ocp::{Interval, Quantity};
use crate::problem::Problem;
use std::f64::consts::PI;

/// What a person calls the rotation angle.
pub(crate) const ROTATION: &str = "base rotation angle";

/// The limits, each a row (φ/bound)² ≤ 1: along the path, and up to two at t_f, which no path row
/// reaches.
///
/// A bound of zero is no such row, which would have no gradient where it holds, but holds the
/// parameters themselves; from half a turn on there is no limit.
#[derive(Debug, Clone, Default)]
pub(crate) struct TurnLimits {
    /// Bounds, rad; those of zero left out.
    path: Option<f64>,
    ends: Vec<f64>,
    /// Whether the base is held along the path, and at t_f; `None` where each angle has limits.
    held: Option<[bool; 2]>,
}

impl TurnLimits {
    /// The limits of `problem`; none where each angle has its own.
    pub fn new<Sp: Space>(problem: &Problem, attitude: Sp::Attitude) -> Self {
        if attitude.is_angles() {
            return Self::default();
        }
        let [along, last] = Self::bounds(problem);
        let row = |bound: &f64| *bound > 0.0 && *bound < PI;
        Self {
            path: Some(along).filter(row),
            // Never two rows of which both could be at their bound.
            ends: [(true, last), (along < last, along)]
                .into_iter()
                .filter(|(wanted, bound)| *wanted && row(bound))
                .map(|(_, bound)| bound)
                .collect(),
            held: Some([along == 0.0, last == 0.0]),
        }
    }

    /// The largest rotation angle along the path and at t_f, rad; infinite where not limited.
    pub fn bounds(problem: &Problem) -> [f64; 2] {
        let limits = &problem.limits;
        [&limits.base_attitude, &limits.final_base_attitude].map(|bounds| bounds[0].upper)
    }

    /// Bounds of the parameters along the path and at t_f; `start` are those at t₀.
    pub fn parameter_bounds(&self, problem: &Problem, start: &[f64]) -> [Vec<Interval>; 2] {
        let limits = &problem.limits;
        let Some(held) = self.held else {
            return [&limits.base_attitude, &limits.final_base_attitude].map(Vec::clone);
        };
        held.map(|held| {
            let bound = |&start: &f64| match held && start == 0.0 {
                true => Interval::fixed(0.0),
                false => Interval::FREE,
            };
            start.iter().map(bound).collect()
        })
    }

    /// Path rows.
    pub fn path(&self) -> Vec<Quantity> {
        self.path.iter().map(|_| quantity()).collect()
    }

    /// Boundary rows.
    pub fn ends(&self) -> Vec<Quantity> {
        self.ends.iter().map(|_| quantity()).collect()
    }

    /// Values of the path rows for φ².
    pub fn path_values<S: Scalar>(&self, squared_turn: impl FnOnce() -> S, rows: &mut [S]) {
        if let Some(bound) = self.path {
            rows[0] = squared_turn() * bound.powi(-2);
        }
    }

    /// Values of the boundary rows for φ².
    pub fn end_values<S: Scalar>(&self, squared_turn: impl FnOnce() -> S, rows: &mut [S]) {
        if !self.ends.is_empty() {
            let square = squared_turn();
            for (row, bound) in rows.iter_mut().zip(&self.ends) {
                *row = square * bound.powi(-2);
            }
        }
    }
}

/// Which rows the limits of `problem` make; problems with the same have the same derivatives
/// nonzero.
pub(crate) fn rows(problem: &Problem) -> [usize; 2] {
    if problem.attitude_sizes().1 == Problem::base_sizes(&problem.robot).0 {
        return [0; 2];
    }
    let limits = TurnLimits::new::<Spatial>(problem, problem.attitude);
    [limits.path.iter().len(), limits.ends.len()]
}

fn quantity() -> Quantity {
    Quantity::new(ROTATION, Interval::new(f64::NEG_INFINITY, 1.0))
}
