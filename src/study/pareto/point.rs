//! One point of the front.

use crate::planner::{Plan, Status};

/// One point of the front.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ParetoPoint {
    /// Factor κ on the base's weights; between those of its neighbours where `bound` is what makes the
    /// point.
    pub factor: f64,
    /// Bound on B, without the factor, of a point that no factor leads to; of the others none.
    pub bound: Option<f64>,
    /// Base motion B, without the factor.
    pub base: f64,
    /// Joint effort E.
    pub joints: f64,
    /// The plan.
    pub plan: Plan,
}

impl ParetoPoint {
    /// κB + E.
    pub(super) fn scalarised(&self, factor: f64) -> f64 {
        factor * self.base + self.joints
    }

    pub(super) fn is_solved(&self) -> bool {
        self.plan.status == Status::Solved
    }
}
