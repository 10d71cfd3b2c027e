//! The process that plans rows for `batch --isolate`: positions in, records out, a line each.

use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::config::BatchFile;
use crate::solution::dataset::start;
use crate::study::batch::{RowPlanner, depend_on_batch, serve};
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// Plans the rows whose positions are read (for `batch --isolate`)
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Batch file
    batch: PathBuf,
    /// What the rows have to follow from
    #[arg(long)]
    fingerprint: String,
    /// Limit on the time of a plan
    #[arg(long, value_parser = super::seconds)]
    time_limit: Option<Duration>,
    /// Saved solution that every plan starts from
    #[arg(long)]
    warm_start: Option<PathBuf>,
    /// Whether records have the planned motions
    #[arg(long)]
    trajectories: bool,
}

/// Serves until its input ends, which it does however the batch ends.
pub(in crate::cli) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    depend_on_batch();
    let batch = BatchFile::load(&arguments.batch, arguments.time_limit)?;
    if batch.fingerprint() != arguments.fingerprint {
        let path = arguments.batch.display();
        return Err(Failure::Usage(format!(
            "{path}: changed while the batch was planned"
        )));
    }
    let solution = arguments.warm_start.as_deref();
    let start = solution.map(|path| start(&batch, path)).transpose()?;
    let mut planner = RowPlanner::new(start, arguments.trajectories);
    let faults = Faults::of_environment();
    let (input, output) = (std::io::stdin().lock(), std::io::stdout().lock());
    serve((&batch, &mut planner), input, output, &|position| {
        faults.commit(position);
    })
    .map_err(Failure::Terminal)?;
    Ok(Outcome::Done)
}

/// Faults that tests ask for, in `FFSM_BATCH_FAULTS`, as `crash:3,hang:5,memory:7`: what no problem can
/// be made to do on purpose.
struct Faults(Vec<(String, u64)>);

impl Faults {
    fn of_environment() -> Self {
        let asked = std::env::var("FFSM_BATCH_FAULTS").unwrap_or_default();
        let fault = |text: &str| {
            let (kind, position) = text.split_once(':')?;
            Some((kind.to_owned(), position.parse().ok()?))
        };
        Self(asked.split(',').filter_map(fault).collect())
    }

    fn commit(&self, position: u64) {
        let fault = self.0.iter().find(|(_, at)| *at == position);
        match fault.map(|(kind, _)| kind.as_str()) {
            Some("crash") => std::process::abort(),
            Some("hang") => loop {
                std::thread::sleep(Duration::from_secs(1));
            },
            Some("memory") => {
                let mut taken = Vec::new();
                loop {
                    taken.push(vec![1_u8; 16 << 20]);
                    std::thread::sleep(Duration::from_millis(5));
                }
            }
            _ => {}
        }
    }
}
