//! What the solution on one mesh is worth: its errors, its bounds between the nodes, its verdict.

use super::assumptions::Assumptions;
use super::mesh_solve::Solved;
use super::objective_error::objective_error;
use super::violation::{OVERSHOOT, violations};
use super::{Bounded, Errors, Settings, Verdict, Violation, midpoint_errors};
use crate::numeric::largest_or_nan;
use crate::ocp::DynOcp;

/// Part of its size by which a bound of a state or a row of the states may be exceeded between the
/// nodes of a mesh that counts.
const FAR: f64 = 0.05;
/// Part of the duration for which a control, or a row of the controls, may overshoot its bound by
/// more than [`OVERSHOOT`] in one segment.
const SHORT: f64 = 1e-3;

/// Part of the errors that the next mesh is to keep where J is not exact enough.
const FALL: f64 = 0.1;

/// What a solution is worth.
pub(super) struct Assessed {
    pub errors: Errors,
    /// See [`Record::objective_error`](super::Record::objective_error).
    pub objective_error: f64,
    /// The tolerance that the next mesh is to meet: where J is not exact enough yet, below the errors of this
    /// one.
    pub next_tolerance: f64,
    /// Bounds exceeded between the nodes, by segments.
    pub outside: Vec<Vec<Violation>>,
    /// Those of `outside` that another mesh removes or makes shorter.
    pub removable: Vec<Vec<Violation>>,
    /// See [`Record::removable_violation`](super::Record::removable_violation).
    pub left_to_remove: f64,
    pub verdict: Verdict,
}

/// Judges the solutions of one problem.
pub(super) struct Assessor<'a> {
    ocp: &'a dyn DynOcp,
    settings: &'a Settings,
    /// Whether each path row depends on a control.
    jumping_rows: &'a [bool],
}

impl<'a> Assessor<'a> {
    pub fn new(ocp: &'a dyn DynOcp, jumping_rows: &'a [bool], settings: &'a Settings) -> Self {
        Self {
            ocp,
            settings,
            jumping_rows,
        }
    }

    /// Looks at a solution between its nodes.
    pub fn assess(&self, solved: &Solved, assumptions: &Assumptions<'_>) -> Assessed {
        let errors = midpoint_errors(self.ocp, &solved.trajectory);
        let errors = assumptions.measured(errors, self.settings);
        let duration = solved.trajectory.duration;
        let outside = violations(self.ocp, &solved.trajectory, |what| self.jumps(what));
        let removable: Vec<Vec<Violation>> = outside
            .iter()
            .map(|segment| {
                let removable = |violation: &&Violation| self.is_removable(violation, duration);
                segment.iter().filter(removable).copied().collect()
            })
            .collect();
        let left_to_remove = |violation: &Violation| match violation.jumps {
            true => violation.lasts / duration,
            false => violation.relative,
        };
        let objective_error = objective_error(self.ocp, solved);
        let mut verdict = self.verdict(solved, errors.max(), &outside, &removable);
        let mut next_tolerance = self.settings.tolerance;
        let is_inexact = |part: f64| {
            objective_error.is_nan() || objective_error.abs() > part * solved.objective.abs()
        };
        if self.settings.objective_tolerance.is_some_and(is_inexact) {
            next_tolerance = next_tolerance.min(FALL * errors.max());
            if verdict.is_converged() {
                verdict = Verdict::AboveTolerance;
            }
        }
        Assessed {
            left_to_remove: largest_or_nan(removable.iter().flatten().map(left_to_remove)),
            verdict,
            objective_error,
            next_tolerance,
            errors,
            outside,
            removable,
        }
    }

    fn verdict(
        &self,
        solved: &Solved,
        max_error: f64,
        outside: &[Vec<Violation>],
        removable: &[Vec<Violation>],
    ) -> Verdict {
        let undefined = max_error.is_nan() || outside.iter().flatten().any(|v| v.value.is_nan());
        let any_far = |found: &[Vec<Violation>]| found.iter().flatten().any(|v| self.is_far(v));
        if !solved.status.is_solved() {
            Verdict::NotSolved(solved.status)
        } else if undefined {
            Verdict::Undefined
        } else if max_error > self.settings.tolerance {
            Verdict::AboveTolerance
        } else if any_far(removable) {
            Verdict::BoundExceeded
        } else if any_far(outside) {
            Verdict::Overshoots
        } else {
            Verdict::Converged
        }
    }

    fn is_far(&self, violation: &Violation) -> bool {
        let most = match violation.jumps {
            true => OVERSHOOT,
            false => FAR,
        };
        violation.relative > most.max(self.settings.bound_tolerance)
    }

    /// Where a control switches, polynomials overshoot on any mesh, for a time that falls with the
    /// segment's width.
    fn is_removable(&self, violation: &Violation, duration: f64) -> bool {
        let lasts = violation.lasts > SHORT * duration;
        !violation.jumps || lasts && self.is_far(violation)
    }

    /// Whether a bounded quantity is a control or depends on one.
    fn jumps(&self, what: Bounded) -> bool {
        match what {
            Bounded::State(_) => false,
            Bounded::Control(_) => true,
            Bounded::Path(p) => self.jumping_rows[p],
        }
    }
}
