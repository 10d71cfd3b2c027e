//! A batch planned into a folder.

use super::buffer::Buffer;
use super::folder::{DataSet, Done, Writer};
use super::lock::Shard;
use super::manifest::Manifest;
use super::run_error::RunError;
use super::start::start;
use crate::config::BatchFile;
use crate::nlp::Control;
use crate::nlp::LinearSolver;
use crate::nlp::ipopt::{linear_solver, serialised};
use crate::planner::Start;
use crate::study::batch::{Engine, Event, Isolation, RowStatus};
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// Which rows of a batch are planned, and from what.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct RunOptions {
    /// The rows to plan.
    pub shard: Shard,
    /// Whether it goes on where rows are done already, instead of refusing the folder.
    pub resume: bool,
    /// Rows that ended so are planned again; of all rows, not of a shard. It resumes then.
    pub retry: Vec<RowStatus>,
    /// The `solution.json` that every plan starts from.
    pub warm_start: Option<PathBuf>,
    /// Whether rows have the planned motions.
    pub trajectories: bool,
}

/// A run of a batch, which keeps other runs from its rows for as long as it lives.
#[derive(Debug)]
pub struct Run<'a> {
    batch: &'a BatchFile,
    shard: Shard,
    start: Option<Start>,
    trajectories: bool,
    writer: Writer,
    done: Done,
}

impl<'a> Run<'a> {
    /// Begins a data set in `folder`, or goes on with one. Nothing is planned yet.
    ///
    /// # Errors
    /// [`RunError`], of [`Writer::open`] and of [`start`].
    pub fn open(
        batch: &'a BatchFile,
        folder: &Path,
        options: &RunOptions,
    ) -> Result<Self, RunError> {
        let RunOptions {
            shard,
            trajectories,
            ..
        } = *options;
        let retries = !options.retry.is_empty();
        if retries && shard != Shard::WHOLE {
            return Err(RunError::RetryOfShard);
        }
        let warm_start = options.warm_start.as_deref();
        let start = warm_start.map(|path| start(batch, path)).transpose()?;
        let manifest = Manifest::of(batch, warm_start, trajectories)?;
        let resumes = options.resume || retries;
        let (mut writer, mut done) = Writer::open(folder, manifest, shard, resumes)?;
        if retries && writer.retract(&options.retry)? > 0 {
            done = writer.set().done()?;
        }
        Ok(Self {
            batch,
            shard,
            start,
            trajectories,
            writer,
            done,
        })
    }

    /// Positions of the rows that it is to plan.
    pub fn left(&self) -> impl Iterator<Item = u64> + Send + '_ {
        let rows = self.shard.positions(self.batch.count());
        rows.filter(|row| !self.done.has(*row))
    }

    /// What every plan starts from, where that is given.
    pub fn start(&self) -> Option<&Start> {
        self.start.as_ref()
    }

    /// The linear solver, where it cannot serve two threads of a process: several jobs then need
    /// [`Isolation::Processes`].
    pub fn serialised(&self) -> Option<LinearSolver> {
        let first = self.batch.row(0).ok()?;
        let solver = linear_solver(&first.file.problem.into_builder().solver);
        serialised(&solver).then_some(solver)
    }

    /// Plans the rows that are left, `jobs` at a time, one a processor unless given. `told` is asked with
    /// every row and several times a second whether to go on; rows that have ended are written whatever
    /// ends the run.
    ///
    /// # Errors
    /// [`RunError::DataSet`] where a part cannot be written, [`RunError::Engine`] where planning cannot
    /// go on. Parts before are kept.
    pub fn plan(
        &mut self,
        jobs: Option<NonZero<usize>>,
        isolation: Isolation,
        told: &mut dyn FnMut(&Event) -> Control,
    ) -> Result<(), RunError> {
        let mut engine = Engine::default();
        engine.jobs = jobs.unwrap_or(engine.jobs);
        engine.start = self.start.clone();
        engine.motions = self.trajectories;
        engine.isolation = isolation;
        let (batch, done, writer) = (self.batch, &self.done, &mut self.writer);
        let left = self.shard.positions(batch.count());
        let left = left.filter(|row| !done.has(*row));
        let mut buffer = Buffer::new();
        let mut broken = None;
        let ran = engine.run(batch, left, &mut |event| {
            let control = told(&event);
            if let Event::Record(record) = event {
                buffer.push(*record);
            }
            match buffer.is_due().then(|| buffer.write(writer)) {
                Some(Err(error)) => {
                    broken = Some(error);
                    Control::Stop
                }
                _ => control,
            }
        });
        if let Some(error) = broken {
            return Err(error.into());
        }
        buffer.write(writer)?;
        Ok(ran?)
    }

    /// The data set, to read from.
    pub fn set(&self) -> &DataSet {
        self.writer.set()
    }
}
