//! What no motion can do, found before any solve: too little time, a goal beyond reach, places that
//! a limit or the system's mass centre forbids.
//!
//! Every answer follows from bounds that hold whatever the path, so that nothing is refused that
//! could be planned. What needs a search for its proof is left to the planner's diagnosis.
//!
//! Derived in docs/algorithms.md#least-time, docs/algorithms.md#reach and
//! docs/algorithms.md#displacement.

mod displacement;
mod least_time;
mod places;
mod ramp;
mod reach;

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use crate::dynamics::space::Space;
use crate::problem::{Impossible, LimitId, Problem};

/// Every reason found why no motion can carry out the task of `problem`; empty where there is none.
///
/// It takes milliseconds and solves nothing.
pub fn impossible(problem: &Problem) -> Vec<Impossible> {
    with_system!(&System::new(problem), system => {
        let mut found = least_time::reasons(problem, &system.plant);
        found.extend(reach::reasons(problem, &system.plant));
        found.extend(places::reasons(problem, system));
        found.extend(displacement::reasons(problem, &system.plant));
        found
    })
}

/// The limits on the joints that no motion of the task keeps, whatever its duration: those of zero. One
/// may be named twice.
pub(crate) fn never_kept<Sp: Space>(problem: &Problem, system: &FreeFloating<Sp>) -> Vec<LimitId> {
    least_time::endless(problem, &system.plant)
}
