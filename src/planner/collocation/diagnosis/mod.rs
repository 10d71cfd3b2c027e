//! Why a problem is infeasible: which limits cannot hold, and the smallest that can.
//!
//! Derived in docs/algorithms.md#elastic-diagnosis.

mod candidates;
mod findings;
mod only_path;
mod search;

pub(in crate::planner) use findings::findings;
pub(super) use only_path::OnlyPath;

use crate::dynamics::space::Space;
use crate::nlp::{Control, Deadline, Statistics};
use crate::numeric::largest_or_nan;
use crate::planner::words::cannot_hold;
use crate::planner::{Diagnosis, Event, LimitFinding, PlanError, floor};
use crate::problem::Problem;
use crate::system::{self, ElasticLimit, FreeFloating};
use crate::transcription::Discretization;
use search::{Found, Search};

/// Iterations that a solve of its search may take.
pub(super) const ITERATIONS: u32 = search::ITERATIONS[0];

/// Part of a limit by which a motion exceeds it by little.
const CLOSE: f64 = 0.25;
/// Part of a proven bound by which the one that was found to work is far above it.
const GAP: f64 = 0.1;

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
/// the former leads to no motion are the latter relaxed as well, but for those that no motion keeps.
pub(super) fn diagnose<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    failed: &Discretization,
    deadline: Deadline,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> Result<Diagnosed, PlanError> {
    let limits = system.elastic_limits();
    // To relax those on the base alone is for nothing where others are known to be in the way.
    let never_kept = system::never_kept(problem, system);
    let is_first = |limit: &&ElasticLimit| {
        let limit = limit.id.limit;
        limit.is_on_base() || never_kept.contains(&limit)
    };
    let first: Vec<ElasticLimit> = limits.iter().filter(is_first).cloned().collect();
    let mut search = Search {
        problem,
        system,
        failed,
        monitor,
        deadline,
        statistics: Statistics::default(),
        tried: 0,
        work: 0,
        has_bound: false,
    };
    let found = match first
        .iter()
        .all(|limit| never_kept.contains(&limit.id.limit))
    {
        true if !first.is_empty() => search.run_briefly(first.clone())?,
        _ => None,
    };
    let found = match found {
        Some(found) if !found.is_no_motion() || found.interrupted => Some(found),
        _ => least(&mut search, first, limits)?,
    };
    let found = match found {
        Some(found) => Some(looked_closer(&mut search, found)?),
        None => None,
    };
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

/// The least excess of the limits `first` alone, and of all `limits` where that leads to no motion.
fn least<Sp: Space>(
    search: &mut Search<'_, '_, Sp>,
    first: Vec<ElasticLimit>,
    limits: Vec<ElasticLimit>,
) -> Result<Option<Found>, PlanError> {
    let are_all = first.len() == limits.len();
    let found = search.run(first)?;
    if are_all || found.as_ref().is_some_and(|found| !found.is_no_motion()) {
        return Ok(found);
    }
    let all = search.run(limits)?;
    let is_better = |all: &Found| found.is_none() || !all.is_no_motion();
    Ok(match all {
        Some(all) if is_better(&all) => Some(all),
        _ => found,
    })
}

/// What a second search finds where `found` leaves one limit in doubt: the first may have ended at a local
/// optimum beside motions within the limit.
fn looked_closer<Sp: Space>(
    search: &mut Search<'_, '_, Sp>,
    found: Found,
) -> Result<Found, PlanError> {
    let (problem, system) = (search.problem, search.system);
    let Some(trajectory) = found.trajectory.as_ref().filter(|_| found.converged) else {
        return Ok(found);
    };
    if search.deadline.has_passed() {
        return Ok(found);
    }
    let mut exceeded = findings(problem, system, &found.limits, trajectory);
    floor::add(problem, system, &mut exceeded);
    let Some(limit) = in_doubt(&exceeded, &found.limits) else {
        return Ok(found);
    };
    let Some(mut second) = search.closer(vec![limit.clone()])? else {
        return Ok(found);
    };
    second.starts.tried += found.starts.tried;
    second.starts.feasible += found.starts.feasible;
    let most =
        |exceeded: &[LimitFinding]| largest_or_nan(exceeded.iter().map(|limit| limit.excess));
    let better = second.trajectory.as_ref().is_some_and(|trajectory| {
        let left = findings(problem, system, &second.limits, trajectory);
        second.converged && most(&left) < most(&exceeded)
    });
    Ok(match better || second.interrupted {
        true => second,
        false => Found {
            starts: second.starts,
            ..found
        },
    })
}

/// The one of `limits` that `exceeded` are about, where a closer look may find less: where nothing proves
/// that it has to be exceeded, and it is by little, or where it is by far more than is proven.
fn in_doubt<'l>(exceeded: &[LimitFinding], limits: &'l [ElasticLimit]) -> Option<&'l ElasticLimit> {
    let first = exceeded.first()?;
    let limit = limits.iter().find(|limit| bounds(limit, first))?;
    if !exceeded.iter().all(|found| bounds(limit, found)) {
        return None;
    }
    let works = |found: &LimitFinding| found.smallest_bound.upper;
    // Of a limit on one side alone, as on the distance to what is kept out, its one bound.
    let size = |found: &LimitFinding| {
        let bounds = [found.bound.lower, found.bound.upper].map(f64::abs);
        largest_or_nan(bounds.into_iter().filter(|bound| bound.is_finite()))
    };
    let floors = exceeded.iter().filter_map(|found| found.floor);
    let in_doubt = match floors.reduce(f64::max) {
        Some(floor) => largest_or_nan(exceeded.iter().map(works)) > floor * (1.0 + GAP),
        None => (exceeded.iter()).all(|found| found.excess <= CLOSE * size(found)),
    };
    in_doubt.then_some(limit)
}

/// Whether `found` is about `limit`.
fn bounds(limit: &ElasticLimit, found: &LimitFinding) -> bool {
    limit.id.limit == found.limit.along_the_path() && limit.id.component == found.component
}
