//! What callers may rely on of the public types: they move between threads and can be shared.

use ffsm_ipopt::collocation::MeshError;
use ffsm_ipopt::config::{BatchFile, BatchRow, ConfigError, Dispersion, Distribution, Place};
use ffsm_ipopt::dynamics::space::{Planar, Spatial};
use ffsm_ipopt::dynamics::{InertiaError, Model, ModelError, Tree};
use ffsm_ipopt::nlp::ipopt::IpoptError;
use ffsm_ipopt::planner::{Diagnosis, Method, Plan, PlanError, Planner, Status};
use ffsm_ipopt::problem::{LimitId, Problem, ProblemBuilder, ProblemError, Unit};
use ffsm_ipopt::report::OutputError;
use ffsm_ipopt::solution::dataset::{DataSet, DataSetError, Run, RunError, RunOptions, Writer};
use ffsm_ipopt::solution::{Solution, SolutionError};
use ffsm_ipopt::study::batch::{Engine, EngineError, Record, RowPlanner};
use ffsm_ipopt::study::dispersion::{DispersionError, Figures, Replays, Sample, Sensitivities};
use ffsm_ipopt::study::{Comparison, pareto::ParetoPoint};
use ffsm_ipopt::system::{CostTerms, FreeFloating, System, Trajectory};
use ffsm_ipopt::transcription::Discretization;
use ffsm_ipopt::verify::{Verification, VerifyError};
use std::error::Error;
use std::fmt::Debug;
use std::path::PathBuf;

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
    shared::<(BatchFile, BatchRow, Engine, EngineError, Record, RowPlanner)>();
    shared::<(DataSet, DataSetError, Writer)>();
    shared::<(Run<'_>, RunError, RunOptions)>();
    shared::<(Dispersion, Distribution, Replays, Figures, Sample)>();
    shared::<(Sensitivities, DispersionError)>();
}

/// A chain of errors says each thing once.
#[test]
fn errors_do_not_repeat_their_sources() {
    let mass = InertiaError::Mass(0.0);
    let body = ModelError::Inertia {
        body: "forearm".into(),
        cause: mass.clone(),
    };
    let place = Place {
        source: "arm.toml".into(),
        line: Some(3),
    };
    let path = || PathBuf::from("out/solution.json");
    let missing = || std::io::Error::from(std::io::ErrorKind::NotFound);
    let problem = ProblemError {
        key: "task.duration".into(),
        found: "0 s".into(),
        expected: "a time".into(),
    };
    let inertia = ConfigError::Inertia {
        place: place.clone(),
        key: "link[0].mass".into(),
        cause: mass,
    };
    let errors: [Box<dyn Error>; 11] = [
        Box::new(PlanError::from(problem)),
        Box::new(PlanError::from(MeshError::NoSegments)),
        Box::new(PlanError::from(IpoptError::NoMultipliers)),
        Box::new(SolutionError::Provenance {
            path: path(),
            cause: Box::new(inertia.clone()),
        }),
        Box::new(inertia),
        Box::new(ConfigError::Model {
            place,
            key: "link[0]".into(),
            cause: body.clone(),
        }),
        Box::new(body),
        Box::new(SolutionError::Unreadable {
            path: path(),
            reason: missing().to_string(),
        }),
        Box::new(OutputError::File {
            path: path(),
            cause: missing(),
        }),
        Box::new(EngineError::Thread(missing())),
        Box::new(DataSetError::Write {
            path: path(),
            cause: missing(),
        }),
    ];
    for error in errors {
        let mut said = error.to_string();
        let mut source = error.source();
        while let Some(inner) = source {
            assert!(!said.contains(&inner.to_string()), "{said}: {inner}");
            said = inner.to_string();
            source = inner.source();
        }
    }
}
