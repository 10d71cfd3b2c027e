//! A word about limits that are exceeded between the points of the mesh.

use crate::dynamics::space::Space;
use crate::ocp::Limited;
use crate::problem::LimitId;
use crate::refine::{Bounded, Violation};
use crate::system::FreeFloating;
use crate::text::digits::digits;
use crate::transcription::Discretization;

/// A sentence for each of `violations`: the limit, how far it is exceeded, when, and what helps.
pub(super) fn warnings<Sp: Space>(
    system: &FreeFloating<Sp>,
    trajectory: &Discretization,
    violations: &[Violation],
) -> Vec<String> {
    let sentence = |violation: &Violation| {
        let row = system.bound(match violation.what {
            Bounded::State(i) => Limited::State(i),
            Bounded::Control(j) => Limited::Control(j),
            Bounded::Path(p) => Limited::Path(p),
        });
        let row = row.bounded_by(&trajectory.parameters);
        let time = digits(violation.t, 3, 2);
        if violation.value.is_nan() {
            return format!(
                "{} ({}) is not a number between the points of the mesh, at {time} s",
                row.id.limit, row.quantity.name
            );
        }
        let excess = row
            .measured_bounds()
            .violation(row.measured(violation.value));
        let helps = match row.id.limit {
            LimitId::Torque | LimitId::Control => {
                let lasts = match violation.lasts {
                    0.0 => String::new(),
                    lasts => {
                        let lasts = digits(1e3 * lasts, 0, 2);
                        format!(", by more than a tenth for {lasts} ms in all")
                    }
                };
                format!(
                    "{lasts}; what switches overshoots there on any mesh, for a shorter time on a \
                     finer one; a lower limit leaves room"
                )
            }
            _ => "; more mesh.segments, or mesh.max_iterations, bring it down".into(),
        };
        let (factor, unit) = row.unit.readable();
        format!(
            "{} ({}) is exceeded by {}{unit} between the points of the mesh, at {time} s{helps}",
            row.id.limit,
            row.quantity.name,
            digits(excess * factor, 2, 3)
        )
    };
    violations.iter().map(sentence).collect()
}
