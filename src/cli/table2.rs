//! `table2`: the paper's comparison of the global and the adaptive method.

use super::failure::Failure;
use super::progress::Progress;
use super::table2_report::{self, Row};
use super::{Outcome, interrupt, terminal};
use crate::config::ProblemFile;
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::{Plan, Planner, Status};
use crate::refine::Method;
use crate::report::OutputFolder;
use clap::Args;
use std::path::PathBuf;

/// Run the paper's Table II: global RPM against A-RPM at three tolerances
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Folder to write table2.md, table2.csv and table2.json to
    #[arg(long, value_name = "DIR", default_value = "out/table2")]
    out: PathBuf,
    /// Runs of each case; the median time is shown
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
}

/// The shipped problems that can be solved.
const CASES: [&str; 2] = ["table1-relaxed", "table1-smooth"];
const TOLERANCES: [f64; 3] = [1e-3, 1e-4, 1e-5];
/// In the paper's order.
const METHODS: [Method; 2] = [Method::Global, Method::Adaptive];

/// Runs, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let folder = OutputFolder::create(&arguments.out)?;
    interrupt::listen();
    let mut rows = Vec::new();
    for case in CASES {
        let mut file = ProblemFile::shipped(case)?;
        for tolerance in TOLERANCES {
            for method in METHODS {
                file.problem.mesh.tolerance = tolerance;
                file.problem.mesh.method = method;
                let plans = repeat(&file, arguments.repeat)?;
                if stop::requested() {
                    return Ok(Outcome::Interrupted);
                }
                rows.extend(Row::of(case, &plans));
            }
        }
    }
    let text = table2_report::markdown(&rows, arguments.repeat);
    let (json, csv) = table2_report::data(&rows, arguments.repeat)?;
    terminal::print(&text)?;
    for (name, contents) in [
        ("table2.md", &text),
        ("table2.csv", &csv),
        ("table2.json", &json),
    ] {
        terminal::print(&format!(
            "written {}\n",
            folder.write(name, contents)?.display()
        ))?;
    }
    Ok(Outcome::Done)
}

/// The same problem several times, each from nothing.
fn repeat(file: &ProblemFile, times: u16) -> Result<Vec<Plan>, Failure> {
    let mesh = &file.problem.mesh;
    let title = format!(
        "{}, {} to {:e}",
        file.problem.name,
        mesh.method.name(),
        mesh.tolerance
    );
    let mut progress = Progress::start(&title, false);
    let mut plans = Vec::new();
    for _ in 0..times {
        let plan = Planner::new()
            .plan_with(&file.problem, None, &mut |event| progress.show(event))
            .map_err(|error| Failure::planning(file, None, error))?;
        let stopped = plan.status == Status::Interrupted;
        plans.push(plan);
        if stopped {
            break;
        }
    }
    progress.finish();
    Ok(plans)
}
