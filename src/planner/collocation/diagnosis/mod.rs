//! Why a problem is infeasible: which limits cannot hold, and the smallest that can.
//!
//! Derived in docs/algorithms.md#elastic-diagnosis.

mod findings;
mod search;

pub(in crate::planner) use findings::findings;

use crate::dynamics::space::Space;
use crate::nlp::{Control, Deadline, Statistics};
use crate::planner::words::cannot_hold;
use crate::planner::{Diagnosis, Event, PlanError, floor};
use crate::problem::Problem;
use crate::system::{ElasticLimit, FreeFloating};
use crate::transcription::Discretization;
use search::{Found, Search};

/// Iterations that a solve of its search may take.
pub(super) const ITERATIONS: u32 = search::ITERATIONS[0];

/// What the diagnosis found.
pub(super) struct Diagnosed {
    /// The limits that cannot hold; `None` where all can, or where nothing was found.
    pub diagnosis: Option<Diagnosis>,
    /// Whether a trajectory within all limits was found after all; it may be one of a mesh that is
    /// too coarse.
    pub feasible: bool,
    /// Whether the monitor stopped it.
    pub interrupted: bool,
    /// The trajectory of least excess, without the amounts of excess.
    pub trajectory: Discretization,
    pub statistics: Statistics,
}

/// Solves `problem` with elastic limits from many starts.
///
/// Limits on the base are requirements, limits on the joints are hardware: only where relaxing
/// the former leads to no motion are the latter relaxed as well.
pub(super) fn diagnose<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    failed: &Discretization,
    deadline: Deadline,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> Result<Diagnosed, PlanError> {
    let limits = system.elastic_limits();
    let on_base = |limit: &&ElasticLimit| limit.id.limit.is_on_base();
    let base: Vec<ElasticLimit> = limits.iter().filter(on_base).cloned().collect();
    let mut search = Search {
        problem,
        system,
        failed,
        monitor,
        deadline,
        statistics: Statistics::default(),
    };
    let mut found = None;
    if !base.is_empty() {
        found = search.run(base)?;
    }
    if found.as_ref().is_none_or(Found::is_no_motion) {
        let all = search.run(limits)?;
        let is_better = |all: &Found| found.is_none() || !all.is_no_motion();
        found = match all {
            Some(all) if is_better(&all) => Some(all),
            _ => found,
        };
    }
    let statistics = search.statistics;
    let none = |interrupted| Diagnosed {
        diagnosis: None,
        feasible: false,
        interrupted,
        trajectory: failed.clone(),
        statistics,
    };
    let Some(found) = found else {
        return Ok(none(false));
    };
    let Some(trajectory) = found.trajectory else {
        return Ok(none(found.interrupted));
    };
    if found.interrupted {
        return Ok(none(true));
    }
    let mut limits = findings(problem, system, &found.limits, &trajectory);
    floor::add(problem, system, &mut limits);
    if limits.is_empty() {
        return Ok(Diagnosed {
            feasible: true,
            trajectory,
            ..none(false)
        });
    }
    let summary = cannot_hold(&limits, found.converged);
    let diagnosis = Some(Diagnosis {
        limits,
        starts: found.starts,
        converged: found.converged,
        summary,
    });
    Ok(Diagnosed {
        diagnosis,
        trajectory,
        ..none(false)
    })
}
