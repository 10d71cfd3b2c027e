//! The live line over many plans in a row.

use super::interrupt;
use super::progress::Progress;
use crate::nlp::Control;
use crate::nlp::ipopt::interrupt as stop;
use crate::reproduction::Step;

/// A line for each thing that is being done; Ctrl-C ends it all.
pub(super) struct Steps {
    line: Option<Progress>,
}

impl Steps {
    /// No line yet; from now on Ctrl-C stops what runs.
    pub(super) fn listen() -> Self {
        interrupt::listen();
        Self { line: None }
    }

    /// Shows a step.
    pub(super) fn show(&mut self, step: Step<'_>) -> Control {
        match step {
            Step::Begin(title) => {
                if let Some(line) = self.line.take() {
                    line.finish();
                }
                self.line = Some(Progress::start(title, false));
            }
            Step::Event(event) => {
                if let Some(line) = &mut self.line {
                    line.show_search(event);
                }
            }
        }
        if stop::requested() {
            Control::Stop
        } else {
            Control::Continue
        }
    }

    /// Takes the line away.
    pub(super) fn finish(self) {
        if let Some(line) = self.line {
            line.finish();
        }
    }
}
