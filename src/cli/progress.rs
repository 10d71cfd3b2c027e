//! The live line on a terminal.

use crate::nlp::Control;
use crate::nlp::ipopt::interrupt;
use crate::planner::Event;
use crate::refine;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;

/// A line on standard error that says what is being solved; nothing where that is no terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    title: String,
    mesh: String,
}

impl Progress {
    /// Starts a line, or none at all where it should be `quiet`.
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
        Self {
            bar,
            title: title.into(),
            mesh: String::new(),
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
        if self.bar.is_hidden() || stop {
            return if stop {
                Control::Stop
            } else {
                Control::Continue
            };
        }
        let message = match event {
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
                self.mesh = format!("mesh {iteration}, {segments} {noun}, {points} points");
                self.mesh.clone()
            }
            Event::Refinement(refine::Event::Solver(step)) => format!(
                "{} · iteration {}, J {:.6}, infeasibility {:.0e}",
                self.mesh, step.iteration, step.objective, step.primal_infeasibility
            ),
            Event::Refinement(refine::Event::Solved(record)) => format!(
                "{} · J {:.6}, largest error {:.1e}",
                self.mesh, record.objective, record.max_error
            ),
            Event::Diagnosing { start, of } => {
                self.mesh =
                    format!("no solution; which limits cannot hold? start {start}, {of} at most");
                self.mesh.clone()
            }
            Event::Step { step, of } => format!("step {step} of {of}"),
        };
        self.bar.set_message(format!("{}: {message}", self.title));
        Control::Continue
    }

    /// Takes the line away.
    pub(super) fn finish(self) {
        self.bar.finish_and_clear();
    }
}
