//! A word about limits that are exceeded between the points of the mesh.

use super::diagnosis::{readable, unit};
use crate::dynamics::space::Space;
use crate::ocp::Ocp;
use crate::problem::Problem;
use crate::refine::{Bounded, Violation};
use crate::system::FreeFloating;

/// A sentence for each of `violations`: the limit, how far it is exceeded, when, and what helps.
pub(super) fn warnings<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    violations: &[Violation],
) -> Vec<String> {
    let formulation = system.formulation();
    violations
        .iter()
        .map(|violation| {
            let (key, name, joint) = match violation.what {
                Bounded::State(i) => {
                    let (key, joint) = system.state_limit(i);
                    (key, &formulation.states[i].name, joint)
                }
                Bounded::Path(p) => {
                    let (key, joint) = system.path_limit(p);
                    (key, &formulation.path[p].name, joint)
                }
            };
            let (excess, unit) = match violation.what {
                Bounded::Path(p) if key == "limits.keep_out" => {
                    (system.keep_out_depth(p, violation.value), "m")
                }
                _ => (violation.excess, unit(problem, key, name, joint)),
            };
            let helps = if key == "limits.torque" {
                "a torque that switches overshoots there on any mesh; a lower limit leaves room"
            } else {
                "more mesh.segments, or mesh.max_iterations, bring it down"
            };
            let (factor, unit) = readable(unit);
            let (excess, t) = (excess * factor, violation.t);
            format!(
                "{key} ({name}) is exceeded by {excess:.2e}{unit} between the points of the mesh, \
                 at {t:.3} s; {helps}"
            )
        })
        .collect()
}
