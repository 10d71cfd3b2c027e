//! The command line; one file a command.

mod batch;
mod check;
mod compare;
mod completions;
mod disperse;
mod doctor;
mod export;
mod failure;
mod figures;
mod fit;
mod init;
mod interrupt;
mod log_lines;
mod man;
mod pareto;
mod plan;
mod progress;
mod report;
mod reproduce;
mod robot;
mod rows;
mod sample;
mod schema;
mod search;
mod show;
mod simulate;
mod steps;
mod table2;
mod terminal;
mod verify;

pub use check::understood;

use crate::config;
use crate::parallel;
use crate::solution::Build;
use clap::{Parser, Subcommand};
use std::num::NonZero;
use std::process::ExitCode;

/// Exit status of a command that did what it was asked for.
///
/// What went wrong otherwise is told by [`failure::Failure::code`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Done = 0,
    Infeasible = 3,
    NotConverged = 4,
    Interrupted = 130,
}

/// Plans trajectories of free-floating space manipulators that disturb their base least.
///
/// Adaptive Radau pseudospectral method over the system Ipopt.
#[derive(Debug, Parser)]
#[command(name = "ffsm-ipopt", version = Build::VERSION, after_help = EXIT_STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Most threads to use, instead of one a processor; results are the same
    #[arg(long, global = true, env = "FFSM_THREADS", value_name = "N", value_parser = threads_of)]
    threads: Option<NonZero<usize>>,

    /// Let files set options of Ipopt that load libraries or read and write files
    #[arg(long, global = true)]
    trust_options: bool,
}

const EXIT_STATUS: &str = "Exit status: 0 solved, 1 internal or I/O failure, 2 bad usage or \
    input, 3 infeasible, 4 not converged, 130 interrupted";

#[derive(Debug, Subcommand)]
enum Command {
    Plan(plan::Arguments),
    Check(check::Arguments),
    Table2(table2::Arguments),
    Compare(compare::Arguments),
    Pareto(pareto::Arguments),
    Batch(batch::Arguments),
    #[command(hide = true)]
    BatchWorker(batch::worker::Arguments),
    Figures(figures::Arguments),
    Reproduce(reproduce::Arguments),
    Verify(verify::Arguments),
    Disperse(disperse::Arguments),
    Report(report::Arguments),
    Sample(sample::Arguments),
    Export(export::Arguments),
    Simulate(simulate::Arguments),
    Init(init::Arguments),
    Schema(schema::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
    Doctor(doctor::Arguments),
}

/// The number of threads of `--threads`.
fn threads_of(text: &str) -> Result<NonZero<usize>, &'static str> {
    text.parse()
        .map_err(|_| "expected a number from 1, there or in FFSM_THREADS")
}

/// Runs the command of this process's arguments.
///
/// Results go to standard output, all else to standard error. Bad usage ends the process here
/// with status 2.
pub fn run() -> ExitCode {
    let Cli {
        command,
        threads,
        trust_options,
    } = Cli::parse();
    if trust_options {
        config::trust_options();
    }
    if let Some(threads) = threads {
        parallel::set_thread_count(threads);
    }
    // A batch ends its workers itself.
    match command {
        Command::BatchWorker(_) => interrupt::leave_to_batch(),
        _ => interrupt::guard(),
    }
    let result = match command {
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Table2(arguments) => table2::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Pareto(arguments) => pareto::run(&arguments),
        Command::Batch(arguments) => batch::run(&arguments),
        Command::BatchWorker(arguments) => batch::worker::run(&arguments),
        Command::Figures(arguments) => figures::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Disperse(arguments) => disperse::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Sample(arguments) => sample::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
        Command::Doctor(arguments) => doctor::run(&arguments),
    };
    match result {
        Ok(outcome) => ExitCode::from(outcome as u8),
        Err(failure) => {
            terminal::complain(&failure.to_string());
            ExitCode::from(failure.code())
        }
    }
}
