//! The sparsity pattern of the last problem, kept for the next one.

use crate::dynamics::space::Space;
use crate::problem::{Problem, ProblemBuilder, Task};
use crate::system::FreeFloating;
use crate::transcription::Patterns;

/// The last problem's patterns.
#[derive(Debug, Default)]
pub(super) struct SparsityCache(Option<(Problem, Patterns)>);

impl SparsityCache {
    /// Those of `problem`, found anew where it is not structured as the last one.
    pub fn patterns<Sp: Space>(
        &mut self,
        problem: &Problem,
        system: &FreeFloating<Sp>,
    ) -> &Patterns {
        let last = self.0.take();
        let known = last.filter(|(last, _)| same_structure(last, problem));
        let found = known.unwrap_or_else(|| (problem.clone(), Patterns::detect(system)));
        &self.0.insert(found).1
    }
}

/// Whether two problems have the same derivatives nonzero: those that differ in where a motion
/// begins and ends, in the mesh and in the solver alone.
///
/// Every field is named, so that one to come is not forgotten.
fn same_structure(a: &Problem, b: &Problem) -> bool {
    let ProblemBuilder {
        name: _,
        robot,
        attitude,
        task,
        limits,
        cost,
        mesh: _,
        solver: _,
    } = &**a;
    let Task {
        duration,
        initial_joints: _,
        initial_rates: _,
        initial_base_attitude,
        initial_momentum,
        final_joints: _,
        free_joints: _,
        end_effector,
        way_points,
    } = task;
    *robot == b.robot
        && *attitude == b.attitude
        && *limits == b.limits
        && *cost == b.cost
        && *duration == b.task.duration
        && *initial_base_attitude == b.task.initial_base_attitude
        && *initial_momentum == b.task.initial_momentum
        && *end_effector == b.task.end_effector
        && *way_points == b.task.way_points
}
