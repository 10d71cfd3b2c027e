//! The process that plans rows for `batch --isolate`: positions in, records out, a line each.

use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::config::BatchFile;
use crate::parallel;
use crate::study::batch::RowPlanner;
use clap::Args;
use std::io::{BufRead, Write};
use std::num::NonZero;
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
    let _ = rustix::process::set_parent_process_death_signal(Some(rustix::process::Signal::KILL));
    // Where memory runs out, the batch is to stay.
    let _ = std::fs::write("/proc/self/oom_score_adj", "1000");
    let batch = BatchFile::load(&arguments.batch, arguments.time_limit)?;
    if batch.fingerprint() != arguments.fingerprint {
        let path = arguments.batch.display();
        return Err(Failure::Usage(format!(
            "{path}: changed while the batch was planned"
        )));
    }
    let start = super::start(&batch, arguments.warm_start.as_deref())?;
    let mut planner = RowPlanner::new(start, arguments.trajectories);
    let faults = Faults::of_environment();
    let mut output = std::io::stdout().lock();
    let mut say = |line: &str| {
        writeln!(output, "{line}")
            .and_then(|()| output.flush())
            .map_err(Failure::Terminal)
    };
    parallel::with_threads(NonZero::<usize>::MIN, || {
        say("ready")?;
        for line in std::io::stdin().lock().lines().map_while(Result::ok) {
            let Ok(position) = line.parse() else { break };
            faults.commit(position);
            let record = planner.plan(&batch, position);
            let record = serde_json::to_string(&record);
            say(&record.map_err(|error| Failure::Usage(error.to_string()))?)?;
        }
        Ok(Outcome::Done)
    })
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
