//! A first trajectory where a start breaks limits on the base by far: that of the problem in which
//! these limits are elastic. From the start itself the solver would look for any trajectory within
//! them first, whatever it costs.

use super::diagnosis::findings;
use super::elastic_trajectory::{extend, strip};
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Statistics};
use crate::ocp::{Elastic, LimitGroup};
use crate::planner::{Event, PlanError};
use crate::problem::Problem;
use crate::refine::{Method, Refinement, Settings, Start};
use crate::system::{ElasticLimit, FreeFloating};
use crate::transcription::{Discretization, Patterns};

/// Part of a limit's size by which a start exceeds it at least to be far outside.
const FAR: f64 = 0.2;
/// What the start's own cost weighs against a limit that is exceeded by its size: so little that it
/// does not pay to exceed one that can be held.
const COST_WEIGHT: f64 = 0.004;
/// Tolerance of the solver, rough since the result is but a start.
const TOLERANCE: f64 = 1e-4;
/// Iterations at most.
const ITERATIONS: u32 = 150;

/// A start, with what it took to lead it there.
pub(crate) struct Led {
    pub start: Start,
    pub statistics: Statistics,
}

/// `start` led within the limits on the base, as far as it can be; as it is where it has multipliers,
/// or exceeds none by far, or where that leads to nothing.
pub(crate) fn led_within<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    start: Start,
    solver: &nlp::Settings,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> Result<Led, PlanError> {
    let mut led = Led {
        start,
        statistics: Statistics::default(),
    };
    let limits = on_base(system);
    let trajectory = &led.start.trajectory;
    let as_it_is =
        led.start.iterate.is_some() || !far_outside(problem, system, &limits, trajectory);
    if as_it_is || monitor(&Event::LeadingWithin) == Control::Stop {
        return Ok(led);
    }
    let cost = system.cost_terms(trajectory).total();
    if !(cost.is_finite() && cost > 0.0) {
        return Ok(led);
    }
    let groups: Vec<LimitGroup> = limits.into_iter().map(|limit| limit.group).collect();
    let elastic = Elastic::new(system, groups, COST_WEIGHT / cost);
    let refinement = Refinement {
        ocp: &elastic,
        patterns: &Patterns::detect(&elastic),
        settings: &Settings {
            method: Method::Adaptive,
            max_iterations: Some(1),
            ..problem.mesh.clone()
        },
        solver: &nlp::Settings {
            tolerance: solver.tolerance.max(TOLERANCE),
            max_iterations: solver.max_iterations.min(ITERATIONS),
            ..solver.clone()
        },
    };
    let from = Start {
        trajectory: extend(trajectory.clone(), &elastic),
        iterate: None,
    };
    let outcome = refinement.run(&from, &mut |event| monitor(&Event::Refinement(event)))?;
    led.statistics = outcome.statistics;
    if outcome.status.is_solved() {
        led.start.trajectory = strip(&outcome.trajectory, &elastic);
    }
    Ok(led)
}

/// The limits on the base.
fn on_base<Sp: Space>(system: &FreeFloating<Sp>) -> Vec<ElasticLimit> {
    let limits = system.elastic_limits().into_iter();
    limits.filter(|limit| limit.id.limit.is_on_base()).collect()
}

/// Whether `trajectory` exceeds one of `limits` by a large part of its size.
fn far_outside<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    limits: &[ElasticLimit],
    trajectory: &Discretization,
) -> bool {
    let size = |id| {
        let mut of = limits.iter().filter(|limit| limit.id.limit == id);
        of.next().map_or(f64::INFINITY, |limit| limit.group.scale)
    };
    findings(problem, system, limits, trajectory)
        .iter()
        .any(|found| found.excess > FAR * size(found.limit.along_the_path()))
}
