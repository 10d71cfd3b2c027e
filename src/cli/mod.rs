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
mod out_file;
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
use crate::planner::Status;
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

impl From<Status> for Outcome {
    fn from(status: Status) -> Self {
        match status {
            Status::Solved => Self::Done,
            Status::Infeasible => Self::Infeasible,
            Status::NotConverged => Self::NotConverged,
            Status::Interrupted => Self::Interrupted,
        }
    }
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

#[cfg(test)]
mod tests {
    use super::Cli;
    use clap::CommandFactory;
    use clap::error::ErrorKind;
    use std::path::Path;

    /// Words of a command line: between apostrophes or quotation marks nothing is taken apart, and a
    /// comment ends it.
    fn words(line: &str) -> Vec<String> {
        let mut words = vec![String::new()];
        let mut quote = None;
        for c in line.chars() {
            match (quote, c) {
                (Some(end), c) if c == end => quote = None,
                (None, '\'' | '"') => quote = Some(c),
                (None, '#') if words.last().is_some_and(String::is_empty) => break,
                (None, ' ') => words.push(String::new()),
                (_, c) => {
                    if let Some(last) = words.last_mut() {
                        last.push(c);
                    }
                }
            }
        }
        words.retain(|word| !word.is_empty());
        words
    }

    /// Lines of code blocks that call the program; blocks in a language other than the shell's are none.
    fn commands(text: &str) -> Vec<&str> {
        let mut language = None;
        let mut found = Vec::new();
        for line in text.lines() {
            if let Some(named) = line.strip_prefix("```") {
                language = match language {
                    None => Some(named),
                    Some(_) => None,
                };
            }
            let inside = matches!(language, Some("" | "sh" | "console" | "text"));
            let line = line.strip_prefix("$ ").unwrap_or(line);
            let call = line.strip_prefix("ffsm-ipopt ");
            // With a number behind it, it is a version in what was printed.
            if inside && call.is_some_and(|call| !call.starts_with(|c: char| c.is_ascii_digit())) {
                found.push(line);
            }
        }
        found
    }

    #[test]
    fn commands_in_the_documents_are_understood() {
        let top = Path::new(env!("CARGO_MANIFEST_DIR"));
        let documents = std::fs::read_dir(top.join("docs")).unwrap();
        let documents = documents.map(|entry| entry.unwrap().path());
        let documents = documents.filter(|path| path.extension().is_some_and(|ends| ends == "md"));
        let mut count = 0;
        for path in documents.chain([top.join("README.md")]) {
            let text = std::fs::read_to_string(&path).unwrap();
            for line in commands(&text) {
                // What is redirected is the shell's.
                let line = line.split(" > ").next().unwrap_or(line);
                let understood = Cli::command().try_get_matches_from(words(line));
                let is_fine =
                    |kind| matches!(kind, ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
                if let Err(error) = understood {
                    assert!(is_fine(error.kind()), "{}: {line}: {error}", path.display());
                }
                count += 1;
            }
        }
        assert!(count > 15, "{count} commands");
    }
}
