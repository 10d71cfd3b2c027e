//! What callers may rely on of the public types: they move between threads and can be shared.

use ffsm_ipopt::dynamics::space::{Planar, Spatial};
use ffsm_ipopt::dynamics::{Model, Tree};
use ffsm_ipopt::planner::{Diagnosis, Method, Plan, PlanError, Planner, Status};
use ffsm_ipopt::problem::{LimitId, Problem, ProblemBuilder, ProblemError, Unit};
use ffsm_ipopt::solution::Solution;
use ffsm_ipopt::study::{Comparison, pareto::ParetoPoint};
use ffsm_ipopt::system::{CostTerms, FreeFloating, System, Trajectory};
use ffsm_ipopt::transcription::Discretization;
use ffsm_ipopt::verify::{Verification, VerifyError};
use std::fmt::Debug;

fn shared<T: Send + Sync + Debug>() {}

#[test]
fn public_types_move_between_threads_and_can_be_shared() {
    shared::<(Model, Tree<Planar>, Tree<Spatial>)>();
    shared::<(Problem, ProblemBuilder, ProblemError)>();
    shared::<(LimitId, Unit, Method, Status)>();
    shared::<(System, FreeFloating<Planar>, FreeFloating<Spatial>)>();
    shared::<(Planner, Plan, Diagnosis)>();
    shared::<PlanError>();
    shared::<(Trajectory, Discretization, CostTerms)>();
    shared::<(Comparison, ParetoPoint)>();
    shared::<(Verification, VerifyError)>();
    shared::<Solution>();
}

/// A chain of errors says each thing once.
#[test]
fn errors_do_not_repeat_their_sources() {
    let error = PlanError::from(ProblemError {
        key: "task.duration".into(),
        found: "0 s".into(),
        expected: "a time".into(),
    });
    let mut said = error.to_string();
    let mut source = std::error::Error::source(&error);
    while let Some(inner) = source {
        assert!(!said.contains(&inner.to_string()), "{said}: {inner}");
        said = inner.to_string();
        source = inner.source();
    }
}
