//! `batch`: many problems, a data set.

mod progress;
mod show;
mod solutions;
pub(super) mod worker;

use super::failure::Failure;
use super::{Outcome, interrupt, terminal};
use crate::config::{BatchFile, trusts_options};
use crate::nlp::Control;
use crate::nlp::LinearSolver;
use crate::nlp::ipopt::interrupt as stop;
use crate::solution::dataset::{Run, RunOptions, Shard};
use crate::study::batch::{Event, Isolation, RowStatus, WorkerCommand};
use clap::{Args, Subcommand};
use progress::Progress;
use std::ffi::OsString;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Plan many problems and write a data set, a row a plan
///
/// Rows that are planned stay: after whatever end, --resume goes on with the rest.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Batch file, or JSON lines of whole problems
    #[arg(value_name = "BATCH.toml|PROBLEMS.jsonl", required = true)]
    batch: Option<PathBuf>,
    /// Folder to write the data set to
    #[arg(long, value_name = "DIR", required = true)]
    out: Option<PathBuf>,
    /// Plans at a time, each on one thread [default: one a processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=MOST_JOBS))]
    jobs: Option<u16>,
    /// Plan only every Nth row, from the Ith on; several shards may write to one folder at a time
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Go on with the rows that are not done yet
    #[arg(long)]
    resume: bool,
    /// Plan the rows again that ended so, and those that are not done yet
    #[arg(long, value_name = "STATUS", value_parser = status, value_delimiter = ',')]
    retry: Vec<RowStatus>,
    /// Limit on the time of each plan
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<Duration>,
    /// Saved solution that every plan starts from
    #[arg(long, value_name = "solution.json")]
    warm_start: Option<PathBuf>,
    /// Plan in processes of their own: what ends one of them is a row with its reason
    #[arg(long)]
    isolate: bool,
    /// Limit on the memory of each such process
    #[arg(long, value_name = "MIB", requires = "isolate", value_parser = clap::value_parser!(u64).range(16..))]
    memory: Option<u64>,
    /// Keep the planned motions, as list columns
    #[arg(long)]
    trajectories: bool,
    /// Write solution.json and page of these rows to DIR/solutions/KEY
    #[arg(long, value_name = "KEY", value_delimiter = ',')]
    solutions: Vec<String>,
    /// Print the summary as one JSON document
    #[arg(long)]
    json: bool,
    /// Print neither progress nor summary
    #[arg(long)]
    quiet: bool,
}

/// Most plans at a time.
const MOST_JOBS: i64 = 1024;

#[derive(Debug, Subcommand)]
enum Command {
    Show(show::Arguments),
}

fn seconds(text: &str) -> Result<Duration, &'static str> {
    let number = text.parse::<f64>().ok().filter(|number| *number > 0.0);
    let time = number.and_then(|number| Duration::try_from_secs_f64(number).ok());
    time.ok_or("expected a finite number above zero, s")
}

fn shard(text: &str) -> Result<Shard, &'static str> {
    let parts = text.split_once('/');
    let parts = parts.and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    let shard = parts.and_then(|(number, of)| Shard::new(number, of));
    shard.ok_or("expected I/N with I from 1 to N, and N at most 1000000")
}

fn status(text: &str) -> Result<RowStatus, String> {
    let names = RowStatus::ALL.map(RowStatus::name).join(", ");
    RowStatus::of(text).ok_or_else(|| format!("expected one of {names}"))
}

/// Plans, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(Command::Show(arguments)) = &arguments.command {
        return show::run(arguments);
    }
    let (Some(path), Some(out)) = (&arguments.batch, &arguments.out) else {
        return Err(Failure::Usage("a batch file and --out are needed".into()));
    };
    let batch = BatchFile::load(path, arguments.time_limit)?;
    let keys = solutions::positions(&batch, &arguments.solutions)?;
    let options = RunOptions {
        shard: arguments.shard.unwrap_or_default(),
        resume: arguments.resume,
        retry: arguments.retry.clone(),
        warm_start: arguments.warm_start.clone(),
        trajectories: arguments.trajectories,
    };
    let mut run = Run::open(&batch, out, &options)?;
    interrupt::listen();

    let jobs = arguments
        .jobs
        .and_then(|jobs| NonZero::new(usize::from(jobs)));
    let isolation = isolation(arguments, (path, &batch), run.serialised())?;
    let mut progress = Progress::start(run.left().count() as u64, arguments.quiet);
    let ran = run.plan(jobs, isolation, &mut |event| {
        if let Event::Record(record) = event {
            progress.row(record.status);
        }
        progress.show();
        Control::Continue
    });
    progress.finish();
    ran?;
    if stop::requested() {
        let rows = run.set().done()?.rows();
        terminal::complain(&format!(
            "{rows} rows are kept; --resume goes on from there"
        ));
        return Ok(Outcome::Interrupted);
    }
    solutions::write(&batch, (&keys, run.start()), out)?;
    if !arguments.quiet || arguments.json {
        show::print(run.set(), arguments.json)?;
    }
    Ok(Outcome::Done)
}

/// Processes where they are asked for, and where the linear solver cannot serve two threads.
fn isolation(
    arguments: &Arguments,
    (path, batch): (&Path, &BatchFile),
    alone: Option<LinearSolver>,
) -> Result<Isolation, Failure> {
    if !arguments.isolate && alone.is_none() {
        return Ok(Isolation::Threads);
    }
    if let (Some(solver), false, false) = (alone, arguments.isolate, arguments.quiet) {
        terminal::complain(&format!(
            "note: {solver} cannot serve two threads; plans are made in processes of their own"
        ));
    }
    let program = std::env::current_exe().map_err(|cause| Failure::Program { cause })?;
    let mut own: Vec<OsString> = vec!["batch-worker".into(), path.into()];
    own.push(format!("--fingerprint={}", batch.fingerprint()).into());
    if let Some(limit) = arguments.time_limit {
        own.push(format!("--time-limit={:?}", limit.as_secs_f64()).into());
    }
    if arguments.trajectories {
        own.push("--trajectories".into());
    }
    if let Some(solution) = &arguments.warm_start {
        own.extend(["--warm-start".into(), solution.into()]);
    }
    if trusts_options() {
        own.push("--trust-options".into());
    }
    let mut command = WorkerCommand::new(program, own);
    command.time_limit = arguments.time_limit;
    command.memory = arguments.memory.map(|mib| mib << 20);
    Ok(Isolation::Processes(command))
}
