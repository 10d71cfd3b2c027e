//! `doctor`: what this machine's Ipopt, linear solvers and versions are.

use super::failure::Failure;
use super::{Outcome, terminal};
use crate::nlp::{self, ipopt};
use crate::parallel;
use crate::report::Lines;
use crate::solution::Build;
use clap::Args;
use std::path::Path;

/// Show versions, the system's Ipopt and which of its linear solvers work
#[derive(Debug, Args)]
pub(super) struct Arguments {}

/// Looks, prints.
pub(super) fn run(_: &Arguments) -> Result<Outcome, Failure> {
    let build = Build::THIS;
    let solvers = ipopt::linear_solvers();
    let mut lines = Lines::default();
    lines.add("version", build.version);
    lines.add("git revision", build.revision);
    lines.add("target", format!("{} ({})", build.target, build.profile));
    lines.add("target features", build.target_features);
    lines.add("compiler", build.rustc);
    lines.add("Ipopt", ipopt::version());
    let working = if solvers.is_empty() {
        "none works".into()
    } else {
        let names: Vec<&str> = solvers.iter().map(|solver| solver.name()).collect();
        names.join(", ")
    };
    lines.add("linear solvers", working);
    let settings = nlp::Settings::default();
    let auto = ipopt::why_not_multifrontal(&settings)
        .unwrap_or_else(|| ipopt::linear_solver(&settings).to_string());
    lines.add("linear_solver auto", auto);
    let options = if Path::new("ipopt.opt").exists() {
        "in this folder, and ignored: options come from the problem file alone"
    } else {
        "not in this folder (it would be ignored)"
    };
    lines.add("ipopt.opt", options);
    let cores = std::thread::available_parallelism();
    lines.add(
        "cores",
        cores.map_or_else(|_| "unknown".into(), |cores| cores.to_string()),
    );
    lines.add("threads", parallel::thread_count().to_string());
    terminal::print(&lines.finish())?;
    if solvers.is_empty() {
        Err(Failure::NoLinearSolver)
    } else {
        Ok(Outcome::Done)
    }
}
