//! The compiled part of the Python package `ffsm_ipopt`: what it needs of the library, as plain values.
//!
//! Names, units and shapes for its users are in the Python files beside this folder.

mod arrays;
mod batch;
mod error;
mod many;
mod monitor;
mod plan;
mod problem;
mod progress;
mod solution;
mod watched;

use pyo3::prelude::*;

/// The compiled part of ffsm_ipopt.
#[pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use crate::batch::{batch_rows, begin_batch, ended, rows_done, run_batch, serve_rows};
    #[pymodule_export]
    use crate::many::plan_many;
    #[pymodule_export]
    use crate::plan::plan;
    #[pymodule_export]
    use crate::problem::Problem;
    #[pymodule_export]
    use crate::solution::Solution;
    use pyo3::prelude::*;

    /// Version of the library and of Ipopt, and the names of the methods.
    #[pyfunction]
    fn build() -> (&'static str, String, Vec<&'static str>) {
        let methods = ffsm_ipopt::planner::Method::ALL;
        (
            ffsm_ipopt::solution::Build::VERSION,
            ffsm_ipopt::nlp::ipopt::version().into(),
            methods.map(ffsm_ipopt::planner::Method::name).to_vec(),
        )
    }

    /// Sets how many threads the process uses.
    #[pyfunction]
    fn set_thread_count(threads: std::num::NonZero<usize>) {
        ffsm_ipopt::parallel::set_thread_count(threads);
    }
}
