//! The other end of a worker: positions of rows in, records out, a line each.

use super::{RowPlanner, Tasks};
use crate::parallel;
use std::io::{self, BufRead, Write};
use std::num::NonZero;

/// From now on this process, which plans for a batch, ends with the thread that began it, and is the
/// first to end where memory runs out.
pub fn depend_on_batch() {
    let _ = rustix::process::set_parent_process_death_signal(Some(rustix::process::Signal::KILL));
    // Where memory runs out, the batch is to stay.
    let _ = std::fs::write("/proc/self/oom_score_adj", "1000");
}

/// Does what a [`WorkerCommand`](super::WorkerCommand) asks of its program: says that it is ready, and
/// answers every position with the record of its row, each planned on one thread. `begins` is told of
/// every position before. Returns once `positions` end, which they do however the batch ends.
///
/// # Errors
/// Where records cannot be written.
pub fn serve<T: Tasks + ?Sized>(
    (tasks, planner): (&T, &mut RowPlanner),
    positions: impl BufRead,
    mut records: impl Write,
    begins: &dyn Fn(u64),
) -> io::Result<()> {
    let mut say = |line: &str| writeln!(records, "{line}").and_then(|()| records.flush());
    parallel::with_threads(NonZero::<usize>::MIN, || {
        say("ready")?;
        for line in positions.lines().map_while(Result::ok) {
            let Ok(position) = line.parse() else { break };
            begins(position);
            say(&serde_json::to_string(&planner.plan(tasks, position))?)?;
        }
        Ok(())
    })
}
