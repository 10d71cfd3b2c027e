//! Where a refinement ended.

use super::{Record, Verdict, Violation};
use crate::nlp::{Iterate, Statistics, Status};
use crate::transcription::Discretization;
use std::fmt;

/// What ends a refinement from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CutShort {
    /// The monitor, or an interrupt.
    Interrupted,
    /// The time limit.
    OutOfTime,
}

/// A condition on a state that follows from the others by an invariant of the dynamics, as that on the
/// last component of a quaternion, and was left out: it would have made every system singular.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ReleasedCondition {
    /// Name of the state.
    pub state: String,
    /// The way-point where it was fixed; `None` for the end.
    pub way_point: Option<usize>,
    /// The value that was asked for.
    pub asked: f64,
    /// The value that the trajectory has there.
    pub found: f64,
}

impl fmt::Display for ReleasedCondition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            state,
            asked,
            found,
            ..
        } = self;
        let place = match self.way_point {
            Some(w) => format!("at way-point {}", w + 1),
            None => "at the end".into(),
        };
        write!(
            f,
            "the condition on {state} {place}, {asked}, follows from the others and was left out; \
             the trajectory has {found}"
        )
    }
}

/// Where the loop ended.
///
/// All but `discarded` and `statistics` belongs to one mesh iteration, that of the last of `records`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// The trajectory on the mesh that counts.
    pub trajectory: Discretization,
    /// Its primal and dual values.
    pub iterate: Iterate,
    /// How its solve ended.
    pub status: Status,
    /// Its objective.
    pub objective: f64,
    /// One record a mesh iteration; the last is that of `trajectory`.
    pub records: Vec<Record>,
    /// Records of the mesh iterations after that one, which ended without a solution to be preferred:
    /// they were tried for the sake of bounds that are exceeded between the nodes and did not
    /// converge, or they were cut short.
    pub discarded: Vec<Record>,
    /// Whether the solve succeeded, the largest error is within the tolerance, and no bound is far
    /// exceeded between the nodes. Never where an error or a bounded row is NaN. The last record's
    /// [`Verdict`] says what is missing.
    pub converged: bool,
    /// What ended the refinement before it had converged, where that was neither the law nor a failed
    /// solve.
    pub cut_short: Option<CutShort>,
    /// The worst violation of every bound that is exceeded between the nodes by more than
    /// [`Settings::bound_tolerance`](super::Settings::bound_tolerance).
    pub violations: Vec<Violation>,
    /// Conditions on states that were left out since they follow from the others.
    pub released: Vec<ReleasedCondition>,
    /// Counts and times of all solves together, those of `discarded` included; barrier parameter
    /// and infeasibilities are those of the solve that counts.
    pub statistics: Statistics,
}

impl Outcome {
    /// Largest error (28) of the trajectory; NaN where the problem's rates are NaN.
    pub fn max_error(&self) -> f64 {
        self.records
            .last()
            .map_or(f64::INFINITY, |record| record.max_error)
    }

    /// Whether its error is within the tolerance, bounds between the nodes aside.
    pub(super) fn is_accurate(&self) -> bool {
        self.records.last().is_some_and(|record| {
            record.verdict.is_converged() || record.verdict == Verdict::BoundExceeded
        })
    }

    /// Whether it is nearer to a solution than `other`, both of them solved on their meshes: by the error
    /// (28), and where both are accurate by how far bounds are exceeded.
    pub(super) fn is_nearer_than(&self, other: &Self) -> bool {
        let left = |outcome: &Self, of: fn(&Record) -> f64| {
            outcome.records.last().map_or(f64::INFINITY, of)
        };
        let of: fn(&Record) -> f64 = match (self.is_accurate(), other.is_accurate()) {
            (true, true) => |record| record.removable_violation,
            _ => |record| record.max_error,
        };
        left(self, of) < left(other, of)
    }

    /// This outcome, `later` being what came of the meshes after it.
    pub(super) fn preferred_to(self, later: Self) -> Self {
        Self {
            discarded: later.records[self.records.len()..].to_vec(),
            cut_short: later.cut_short.filter(|_| !self.converged),
            statistics: Statistics {
                barrier: self.statistics.barrier,
                primal_infeasibility: self.statistics.primal_infeasibility,
                dual_infeasibility: self.statistics.dual_infeasibility,
                ..later.statistics
            },
            ..self
        }
    }
}
