//! Rows to threads, records back.

use super::process::{Process, WorkerCommand};
use super::{EngineError, Record, RowPlanner, RowStatus, Tasks};
use crate::nlp::Control;
use crate::nlp::ipopt::interrupt;
use crate::parallel;
use crate::planner::Start;
use std::num::NonZero;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Stack of a thread that plans, bytes: that of a main thread.
const STACK: usize = 8 << 20;
/// Records that wait to be told.
const WAITING: usize = 64;
/// How often something is told where no row ends.
const TICK: Duration = Duration::from_millis(200);

/// Where rows are planned.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub enum Isolation {
    /// In threads of this process, for linear solvers that can do that. A row that takes the process
    /// down takes the others with it.
    #[default]
    Threads,
    /// Each thread has a process that plans for it, and begins another where that dies.
    Processes(WorkerCommand),
}

/// What plans the rows of a batch.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Engine {
    /// Rows at a time, each on one thread.
    pub jobs: NonZero<usize>,
    /// What every plan begins with: one start for all, so that no row depends on another.
    pub start: Option<Start>,
    /// Whether records have the planned motions.
    pub motions: bool,
    /// Where rows are planned.
    pub isolation: Isolation,
}

/// What is told while a batch is planned.
#[derive(Debug)]
#[non_exhaustive]
pub enum Event {
    /// A row has ended.
    Record(Box<Record>),
    /// Some time has gone by.
    Tick,
}

impl Default for Engine {
    /// A row a processor, in threads, without motions.
    fn default() -> Self {
        Self {
            jobs: NonZero::new(parallel::thread_count()).unwrap_or(NonZero::<usize>::MIN),
            start: None,
            motions: false,
            isolation: Isolation::Threads,
        }
    }
}

impl Engine {
    /// Plans the rows at `positions` and tells of each as it ends, in no order. It ends early where it
    /// is told to stop, or where a signal interrupts; rows in the making are then left out.
    ///
    /// Memory does not grow with the number of rows.
    ///
    /// # Errors
    /// [`EngineError`]; rows that fail are records.
    pub fn run<T: Tasks + ?Sized>(
        &self,
        tasks: &T,
        positions: impl Iterator<Item = u64> + Send,
        told: &mut dyn FnMut(Event) -> Control,
    ) -> Result<(), EngineError> {
        let positions = Mutex::new(positions);
        let next = || {
            positions
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .next()
        };
        let stop = AtomicBool::new(false);
        let (sender, records) = sync_channel(WAITING);
        std::thread::scope(|scope| {
            // Its own from here on: once it is gone, no thread waits for its record to be taken.
            let records = records;
            let mut started = Ok(());
            for job in 0..self.jobs.get() {
                let (sender, stop, next) = (sender.clone(), &stop, &next);
                let work = move || {
                    parallel::with_threads(NonZero::<usize>::MIN, || {
                        self.serve(tasks, next, stop, &sender);
                    });
                };
                let thread = std::thread::Builder::new()
                    .name(format!("batch-{job}"))
                    .stack_size(STACK)
                    .spawn_scoped(scope, work);
                if let Err(error) = thread {
                    started = Err(EngineError::Thread(error));
                    stop.store(true, Ordering::Relaxed);
                    break;
                }
            }
            drop(sender);
            started?;
            loop {
                let event = match records.recv_timeout(TICK) {
                    Ok(Ok(record)) => Event::Record(Box::new(record)),
                    Ok(Err(error)) => {
                        stop.store(true, Ordering::Relaxed);
                        return Err(error);
                    }
                    Err(RecvTimeoutError::Timeout) => Event::Tick,
                    Err(RecvTimeoutError::Disconnected) => return Ok(()),
                };
                if told(event) == Control::Stop {
                    // Rows in the making end after their iteration; with the receiver gone, none is told.
                    stop.store(true, Ordering::Relaxed);
                    return Ok(());
                }
            }
        })
    }

    /// One row after another, on one thread.
    fn serve<T: Tasks + ?Sized>(
        &self,
        tasks: &T,
        next: &dyn Fn() -> Option<u64>,
        stop: &AtomicBool,
        sender: &SyncSender<Result<Record, EngineError>>,
    ) {
        let told_to_stop = || stop.load(Ordering::Relaxed);
        let stopped = || told_to_stop() || interrupt::requested();
        let mut here = RowPlanner::new(self.start.clone(), self.motions);
        let mut elsewhere = match &self.isolation {
            Isolation::Threads => None,
            Isolation::Processes(command) => Some(Process::of(command)),
        };
        while !stopped() {
            let Some(position) = next() else { return };
            let record = match &mut elsewhere {
                None => Ok(here.plan_until(tasks, position, &told_to_stop)),
                Some(process) => process.plan((position, tasks.key(position)), &stopped),
            };
            let interrupted =
                matches!(&record, Ok(record) if record.status == RowStatus::Interrupted);
            if interrupted || sender.send(record).is_err() {
                return;
            }
        }
    }
}
