//! What is said while a plan is made: a live line on a terminal, elsewhere a line a mesh.

use super::log_lines::LogLines;
use super::terminal;
use crate::nlp::Control;
use crate::nlp::ipopt::interrupt;
use crate::planner::Event;
use crate::refine::{self, Record};
use crate::study::search::SearchEvent;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// How long a plan may take before anything is printed where there is no terminal.
const PATIENCE: Duration = Duration::from_secs(5);

/// Lines on standard error that say what is being solved.
pub(super) struct Progress {
    bar: ProgressBar,
    /// Where there is no terminal.
    log: Option<LogLines>,
    title: String,
    mesh: String,
    /// The start of the diagnosis that the next mesh belongs to.
    start: Option<String>,
    /// How many tenths of what is counted have been said.
    tenth: u64,
}

impl Progress {
    /// Starts them, or none at all where it should be `quiet`.
    pub(super) fn start(title: &str, quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(None, target);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed:>3} {wide_msg}") {
            bar.set_style(style);
        }
        bar.set_message(title.to_string());
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(100));
        }
        let logged = !quiet && !std::io::stderr().is_terminal();
        Self {
            bar,
            log: logged.then(|| LogLines::after(PATIENCE)),
            title: title.into(),
            mesh: String::new(),
            start: None,
            tenth: 0,
        }
    }

    /// Goes on under another title.
    pub(super) fn retitle(&mut self, title: &str) {
        self.title = title.into();
    }

    /// Shows `event`.
    pub(super) fn show(&mut self, event: &Event<'_>) -> Control {
        // Ipopt polls for Ctrl-C itself.
        let stop = matches!(event, Event::Step { .. }) && interrupt::requested();
        if stop {
            return Control::Stop;
        }
        self.follow(event);
        if !self.bar.is_hidden() {
            let message = self.message(event);
            self.bar.set_message(format!("{}: {message}", self.title));
        }
        if let Some(log) = &mut self.log {
            let line = |text: &str| format!("{}: {text}", self.title);
            match event {
                Event::Diagnosing { start: 1, .. } => {
                    log.end(line("no solution found; asking which limits cannot hold"));
                }
                Event::Refinement(refine::Event::Mesh { .. }) => log.begin(line(&self.mesh)),
                Event::Refinement(refine::Event::Solved(record)) => {
                    log.end(line(&solved(&self.mesh, record)));
                }
                _ => {}
            }
            for line in log.due() {
                terminal::complain(&line);
            }
        }
        Control::Continue
    }

    /// Shows a step of a search.
    pub(super) fn show_search(&mut self, event: &SearchEvent<'_>) -> Control {
        let message = match event {
            SearchEvent::Refining { of: 1, event, .. } => return self.show(event),
            SearchEvent::Tried { tried, of, best } => {
                let best = match best.is_finite() {
                    true => format!(", J {best:.6} at best"),
                    false => String::new(),
                };
                let message = format!("start {tried} of {of}{best}");
                self.log_end(&message);
                message
            }
            SearchEvent::Refining {
                candidate,
                of,
                event,
            } => {
                self.follow(event);
                let message = format!("best {candidate} of {of}: {}", self.message(event));
                if let Event::Refinement(refine::Event::Solved(_)) = event {
                    self.log_end(&message);
                }
                message
            }
        };
        if !self.bar.is_hidden() {
            self.bar.set_message(format!("{}: {message}", self.title));
        }
        match interrupt::requested() {
            true => Control::Stop,
            false => Control::Continue,
        }
    }

    /// Shows that `done` of `all` are done; where there is no terminal, a line each tenth.
    pub(super) fn show_share(&mut self, done: u64, all: u64) -> Control {
        let tenth = (done as f64 / all as f64 * 10.0) as u64;
        if tenth > self.tenth {
            self.tenth = tenth;
            self.log_end(&format!("{done} of {all}"));
        }
        if !self.bar.is_hidden() {
            let message = format!("{}: {done} of {all}", self.title);
            self.bar.set_message(message);
        }
        match interrupt::requested() {
            true => Control::Stop,
            false => Control::Continue,
        }
    }

    /// A line where there is no terminal.
    fn log_end(&mut self, message: &str) {
        if let Some(log) = &mut self.log {
            log.end(format!("{}: {message}", self.title));
            log.due().iter().for_each(|line| terminal::complain(line));
        }
    }

    /// Takes down which mesh is solved from here on.
    fn follow(&mut self, event: &Event<'_>) {
        match event {
            Event::Refinement(refine::Event::Mesh {
                iteration,
                segments,
                points,
            }) => {
                let noun = if *segments == 1 {
                    "segment"
                } else {
                    "segments"
                };
                let start = self.start.take().unwrap_or_default();
                self.mesh = format!("{start}mesh {iteration}, {segments} {noun}, {points} points");
            }
            Event::LeadingWithin => self.start = Some("limits on the base elastic: ".into()),
            Event::Diagnosing { start, of } => {
                self.start = Some(format!("diagnosis, start {start} of {of} at most: "));
                self.mesh =
                    format!("no solution; which limits cannot hold? start {start}, {of} at most");
            }
            _ => {}
        }
    }

    /// The live line.
    fn message(&self, event: &Event<'_>) -> String {
        match event {
            Event::Refinement(refine::Event::Solver(step)) => format!(
                "{} · iteration {}, J {:.6}, infeasibility {:.0e}",
                self.mesh, step.iteration, step.objective, step.primal_infeasibility
            ),
            Event::Refinement(refine::Event::Solved(record)) => solved(&self.mesh, record),
            Event::Step { step, of } => format!("step {step} of {of}"),
            _ => self.mesh.clone(),
        }
    }

    /// Takes the live line away.
    pub(super) fn finish(self) {
        self.bar.finish_and_clear();
    }
}

/// What came of a mesh.
fn solved(mesh: &str, record: &Record) -> String {
    let status = match record.nlp_status.is_solved() {
        true => String::new(),
        false => format!("{}, ", record.nlp_status.describe()),
    };
    format!(
        "{mesh} · {status}{} iterations, J {:.6}, largest error {:.1e}",
        record.nlp_iterations, record.objective, record.max_error
    )
}
