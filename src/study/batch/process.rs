//! A worker in a process of its own: rows to its standard input, records from its standard output, a
//! line each.

use super::{EngineError, Record, RowStatus};
use std::ffi::OsString;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// How often a worker at work is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// Times that a row whose worker was killed from outside is planned again: it need not be the row's
/// fault.
const KILLED: usize = 2;
/// The signal that nothing can resist.
const SIGKILL: i32 = 9;

/// How to begin a worker: a program that says a line once it is ready, then reads positions of rows,
/// a line each, and answers every one with its [`Record`] as a line of JSON.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct WorkerCommand {
    /// The program.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
    /// Time a row may take. A worker that says nothing for this time and half of it again is ended.
    pub time_limit: Option<Duration>,
    /// Memory that a worker may take, bytes.
    pub memory: Option<u64>,
}

impl WorkerCommand {
    /// A worker without limits.
    pub fn new(program: PathBuf, arguments: Vec<OsString>) -> Self {
        Self {
            program,
            arguments,
            time_limit: None,
            memory: None,
        }
    }
}

/// The worker of one thread, begun when it is needed.
#[derive(Debug)]
pub(super) struct Process<'a> {
    command: &'a WorkerCommand,
    worker: Option<Worker>,
}

#[derive(Debug)]
struct Worker {
    child: Child,
    rows: ChildStdin,
    replies: Receiver<String>,
}

/// Why there is no reply.
enum Silence {
    /// The worker is gone.
    Ended(ExitStatus),
    TooLong,
    TooLarge(u64),
    /// Nobody waits for it any more.
    Stopped,
}

impl<'a> Process<'a> {
    /// No worker yet.
    pub(super) fn of(command: &'a WorkerCommand) -> Self {
        let worker = None;
        Self { command, worker }
    }

    /// Plans a row, which ends as interrupted where it is `stopped`.
    pub(super) fn plan(
        &mut self,
        (position, key): (u64, String),
        stopped: &dyn Fn() -> bool,
    ) -> Result<Record, EngineError> {
        let mut kills = 0;
        loop {
            let began = Instant::now();
            let lost = |status, reason: String| {
                Record::lost((position, key.clone()), status, reason, began.elapsed())
            };
            let mut worker = match self.worker.take() {
                Some(worker) => worker,
                None => match self.begin(stopped)? {
                    Some(worker) => worker,
                    None => return Ok(lost(RowStatus::Interrupted, String::new())),
                },
            };
            // One that is gone is found out below.
            let _ = writeln!(worker.rows, "{position}").and_then(|()| worker.rows.flush());
            let limit = self.command.time_limit;
            let limit = limit.map(|limit| began + limit + limit.div_f64(2.0));
            let silence = match worker.reply(limit, self.command.memory, stopped) {
                Ok(line) => match serde_json::from_str(&line) {
                    Ok(record) => {
                        self.worker = Some(worker);
                        return Ok(record);
                    }
                    Err(error) => {
                        let reason = format!("its process said what is no record: {error}");
                        return Ok(lost(RowStatus::Crashed, reason));
                    }
                },
                Err(silence) => silence,
            };
            return Ok(match silence {
                Silence::Ended(status) => match (status.signal(), status.code()) {
                    (Some(SIGKILL), _) if kills < KILLED => {
                        kills += 1;
                        continue;
                    }
                    (Some(SIGKILL), _) => lost(
                        RowStatus::OutOfMemory,
                        "its process was killed again and again, as the system does where memory \
                         runs out"
                            .into(),
                    ),
                    (Some(signal), _) => lost(
                        RowStatus::Crashed,
                        format!("its process died of signal {signal}"),
                    ),
                    (None, code) => {
                        let code = code.unwrap_or_default();
                        let reason = format!("its process ended with status {code}");
                        lost(RowStatus::Crashed, reason)
                    }
                },
                Silence::TooLong => lost(
                    RowStatus::TimedOut,
                    "it went on past the time limit and its process was ended".into(),
                ),
                Silence::TooLarge(bytes) => lost(
                    RowStatus::OutOfMemory,
                    format!("its process took {} MiB and was ended", bytes >> 20),
                ),
                Silence::Stopped => lost(RowStatus::Interrupted, String::new()),
            });
        }
    }

    /// Begins a worker and waits until it is ready; `None` where it is stopped before.
    fn begin(&self, stopped: &dyn Fn() -> bool) -> Result<Option<Worker>, EngineError> {
        let program = || self.command.program.clone();
        // A group of its own: Ctrl-C is for the batch, which ends its workers.
        let child = Command::new(&self.command.program)
            .args(&self.command.arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .process_group(0)
            .spawn();
        let mut child = child.map_err(|cause| EngineError::Start {
            program: program(),
            cause,
        })?;
        let rows = child.stdin.take().expect("piped");
        let output = BufReader::new(child.stdout.take().expect("piped"));
        let (sender, replies) = channel();
        let read = move || {
            for line in output.lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        };
        let reader = std::thread::Builder::new().name("batch-reader".into());
        reader.spawn(read).map_err(EngineError::Thread)?;
        let mut worker = Worker {
            child,
            rows,
            replies,
        };
        match worker.reply(None, None, stopped) {
            Ok(_) => Ok(Some(worker)),
            Err(Silence::Ended(status)) if status.signal() != Some(SIGKILL) => {
                let program = program();
                Err(EngineError::Worker { program, status })
            }
            // Killed before it had begun: another, where the batch goes on.
            Err(Silence::Ended(_)) if !stopped() => {
                std::thread::sleep(LOOK);
                self.begin(stopped)
            }
            Err(_) => Ok(None),
        }
    }
}

impl Worker {
    /// The next line that it says, until `limit`.
    fn reply(
        &mut self,
        limit: Option<Instant>,
        memory: Option<u64>,
        stopped: &dyn Fn() -> bool,
    ) -> Result<String, Silence> {
        loop {
            let said = self.replies.recv_timeout(LOOK);
            let taken = memory.and_then(|most| peak(self.child.id()).filter(|n| *n > most));
            match said {
                // However quick the row was, so that the same rows fit every time.
                Ok(line) => return taken.map_or(Ok(line), |bytes| Err(Silence::TooLarge(bytes))),
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(match self.child.wait() {
                        Ok(status) => Silence::Ended(status),
                        Err(_) => Silence::Stopped,
                    });
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            if let Some(bytes) = taken {
                return Err(Silence::TooLarge(bytes));
            }
            if stopped() {
                return Err(Silence::Stopped);
            }
            if limit.is_some_and(|limit| Instant::now() > limit) {
                return Err(Silence::TooLong);
            }
        }
    }
}

impl Drop for Worker {
    /// Nothing of a worker is left behind, whatever it is at.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The most memory that a process has had, bytes.
fn peak(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().trim_end_matches("kB").trim_end().parse().ok()?;
    Some(kibibytes << 10)
}
