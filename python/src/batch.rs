//! A batch, or a shard of one, into a folder.

use crate::error::Failure;
use crate::monitor::Monitor;
use ffsm_ipopt::config::BatchFile;
use ffsm_ipopt::solution::dataset::{Column, Data, DataSet, Run, RunOptions, Shard, start};
use ffsm_ipopt::study::batch::{
    Event, Isolation, RowPlanner, RowStatus, WorkerCommand, depend_on_batch, serve,
};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::num::NonZero;
use std::path::PathBuf;
use std::time::Duration;

/// The `BatchJob` of Python: which rows, and how they are planned.
#[derive(Debug, FromPyObject)]
pub struct Job {
    batch: PathBuf,
    out: PathBuf,
    /// Which shard, counted from 1, of how many.
    shard: (u64, u64),
    resume: bool,
    retry: Vec<String>,
    jobs: Option<NonZero<usize>>,
    /// s.
    time_limit: Option<f64>,
    warm_start: Option<PathBuf>,
    trajectories: bool,
    isolate: bool,
    /// MiB.
    memory: Option<u64>,
}

impl Job {
    fn load(&self) -> Result<BatchFile, Failure> {
        Ok(BatchFile::load(&self.batch, self.time_limit()?)?)
    }

    fn time_limit(&self) -> Result<Option<Duration>, Failure> {
        let duration = |limit: f64| {
            let time = Duration::try_from_secs_f64(limit).ok();
            time.filter(|time| !time.is_zero()).ok_or_else(|| {
                let expected = "expected a finite number above zero, s";
                Failure::Argument(format!("time_limit: {limit}; {expected}"))
            })
        };
        self.time_limit.map(duration).transpose()
    }

    fn open<'a>(&self, batch: &'a BatchFile) -> Result<Run<'a>, Failure> {
        let (number, of) = self.shard;
        let shard = Shard::new(number, of).ok_or_else(|| {
            let (most, expected) = (
                Shard::MOST,
                "expected a number from 1 to the number of shards",
            );
            Failure::Argument(format!(
                "shard: ({number}, {of}); {expected}, of which there are at most {most}"
            ))
        })?;
        let status = |name: &String| {
            RowStatus::of(name).ok_or_else(|| {
                let names = RowStatus::ALL.map(RowStatus::name).join(", ");
                Failure::Argument(format!("retry: {name:?}; expected one of {names}"))
            })
        };
        let mut options = RunOptions::default();
        options.shard = shard;
        options.resume = self.resume;
        options.retry = self.retry.iter().map(status).collect::<Result<_, _>>()?;
        options.warm_start = self.warm_start.clone();
        options.trajectories = self.trajectories;
        Ok(Run::open(batch, &self.out, &options)?)
    }

    /// As the command: processes where they are asked for, and where the linear solver cannot serve two
    /// threads. `worker` is what begins one.
    fn isolation(
        &self,
        batch: &BatchFile,
        run: &Run<'_>,
        mut worker: Vec<OsString>,
    ) -> Result<Isolation, Failure> {
        if worker.is_empty() || !self.isolate && run.serialised().is_none() {
            return Ok(Isolation::Threads);
        }
        let program = worker.remove(0).into();
        let limit = self.time_limit()?;
        let seconds = limit.map(|limit| format!("{:?}", limit.as_secs_f64()));
        worker.extend([
            self.batch.clone().into(),
            batch.fingerprint().into(),
            seconds.unwrap_or_default().into(),
            self.warm_start.clone().unwrap_or_default().into(),
            if self.trajectories { "1" } else { "" }.into(),
        ]);
        let mut command = WorkerCommand::new(program, worker);
        command.time_limit = limit;
        command.memory = self.memory.map(|mib| mib << 20);
        Ok(Isolation::Processes(command))
    }
}

/// How many rows a batch has.
#[pyfunction]
pub fn batch_rows(py: Python<'_>, job: Job) -> PyResult<u64> {
    py.detach(|| job.load().map(|batch| batch.count()))
        .map_err(PyErr::from)
}

/// Begins a data set, or goes on with one, and plans nothing.
#[pyfunction]
pub fn begin_batch(py: Python<'_>, job: Job) -> PyResult<()> {
    py.detach(|| job.open(&job.load()?).map(drop))
        .map_err(PyErr::from)
}

/// Plans rows into a folder. `told` is called with the status of every row as it ends, and several times
/// a second with `None`; what it raises ends the run. `worker` is the command that begins a process to
/// plan in.
#[pyfunction]
pub fn run_batch(py: Python<'_>, job: Job, worker: Vec<OsString>, told: Py<PyAny>) -> PyResult<()> {
    let mut monitor = Monitor::new(Some(told));
    py.detach(|| {
        let batch = job.load()?;
        let mut run = job.open(&batch)?;
        let isolation = job.isolation(&batch, &run, worker)?;
        let ran = run.plan(job.jobs, isolation, &mut |event| {
            let status = match event {
                Event::Record(record) => Some(record.status.name()),
                _ => None,
            };
            monitor.tell(|_, callback| callback.call1((status,)).map(drop))
        });
        monitor.finish(ran.map_err(Failure::from))
    })
    .map_err(PyErr::from)
}

/// How many rows the batch of a data set has, and how many of those that are done ended how.
#[pyfunction]
pub fn ended(py: Python<'_>, out: PathBuf) -> PyResult<(u64, BTreeMap<String, u64>)> {
    py.detach(|| {
        let set = DataSet::open(&out)?;
        let mut ended = BTreeMap::new();
        set.read(&["status"], &mut |columns| {
            if let [
                Column {
                    data: Data::Text(names),
                    ..
                },
                ..,
            ] = &columns[..]
            {
                for name in names.iter().flatten() {
                    *ended.entry(name.clone()).or_default() += 1;
                }
            }
        })?;
        Ok::<_, Failure>((set.manifest().rows, ended))
    })
    .map_err(PyErr::from)
}

/// How many rows of a shard are done.
#[pyfunction]
pub fn rows_done(py: Python<'_>, out: PathBuf, shard: (u64, u64)) -> PyResult<u64> {
    py.detach(|| {
        let set = DataSet::open(&out)?;
        let done = set.done()?;
        let shard = Shard::new(shard.0, shard.1).unwrap_or_default();
        let rows = shard.positions(set.manifest().rows);
        Ok::<_, Failure>(rows.filter(|row| done.has(*row)).count() as u64)
    })
    .map_err(PyErr::from)
}

/// Plans the rows whose positions standard input has, and writes their records to standard output: what
/// a process of `isolate` does.
#[pyfunction]
pub fn serve_rows(
    py: Python<'_>,
    batch: PathBuf,
    fingerprint: &str,
    time_limit: Option<f64>,
    warm_start: Option<PathBuf>,
    trajectories: bool,
) -> PyResult<()> {
    py.detach(|| {
        depend_on_batch();
        let limit = time_limit.and_then(|limit| Duration::try_from_secs_f64(limit).ok());
        let tasks = BatchFile::load(&batch, limit)?;
        if tasks.fingerprint() != fingerprint {
            let path = batch.display();
            let message = format!("{path}: changed while the batch was planned");
            return Err(Failure::Argument(message));
        }
        let start = warm_start.map(|path| start(&tasks, &path)).transpose()?;
        let mut planner = RowPlanner::new(start, trajectories);
        let (input, output) = (std::io::stdin().lock(), std::io::stdout().lock());
        serve((&tasks, &mut planner), input, output, &|_| {}).map_err(Failure::Pipe)
    })
    .map_err(PyErr::from)
}
