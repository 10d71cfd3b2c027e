//! What is said while a batch is planned: a live line on a terminal, elsewhere a line now and then.

use crate::cli::terminal;
use crate::report::seconds;
use crate::study::batch::RowStatus;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Time before the first line where there is no terminal, and the longest between two.
const FIRST: Duration = Duration::from_secs(5);
const LONGEST: Duration = Duration::from_secs(60);

/// How far a batch is.
pub(super) struct Progress {
    bar: ProgressBar,
    quiet: bool,
    began: Instant,
    /// Rows that this run is to plan, and those it has.
    rows: u64,
    done: u64,
    ended: BTreeMap<RowStatus, u64>,
    due: Instant,
    pause: Duration,
}

impl Progress {
    /// Begins with so many rows to plan.
    pub(super) fn start(rows: u64, quiet: bool) -> Self {
        let target = match quiet {
            true => ProgressDrawTarget::hidden(),
            false => ProgressDrawTarget::stderr(),
        };
        let bar = ProgressBar::with_draw_target(Some(rows), target);
        if let Ok(style) = ProgressStyle::with_template("{elapsed:>3} {bar:20} {wide_msg}") {
            bar.set_style(style);
        }
        let began = Instant::now();
        Self {
            bar,
            quiet: quiet || std::io::stderr().is_terminal(),
            began,
            rows,
            done: 0,
            ended: BTreeMap::new(),
            due: began + FIRST,
            pause: FIRST,
        }
    }

    /// A row has ended.
    pub(super) fn row(&mut self, status: RowStatus) {
        self.done += 1;
        *self.ended.entry(status).or_default() += 1;
    }

    /// Says it where it is time.
    pub(super) fn show(&mut self) {
        if !self.bar.is_hidden() {
            self.bar.set_position(self.done);
            self.bar.set_message(self.message());
        } else if !self.quiet && Instant::now() >= self.due {
            terminal::complain(&self.message());
            self.pause = (2 * self.pause).min(LONGEST);
            self.due = Instant::now() + self.pause;
        }
    }

    fn message(&self) -> String {
        let spent = self.began.elapsed();
        let rate = self.done as f64 / spent.as_secs_f64();
        let left = self.rows.saturating_sub(self.done) as f64 / rate;
        let left = Duration::try_from_secs_f64(left).map(seconds);
        let left = left.unwrap_or_else(|_| "unknown".into());
        let failed = self
            .ended
            .iter()
            .filter(|(status, _)| **status != RowStatus::Solved);
        let failed: String = failed
            .map(|(status, count)| format!(", {count} {}", status.name()))
            .collect();
        format!(
            "{} of {} rows, {rate:.1} a second, {left} left{failed}",
            self.done, self.rows
        )
    }

    /// Takes the live line away.
    pub(super) fn finish(self) {
        self.bar.finish_and_clear();
    }
}
