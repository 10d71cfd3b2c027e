//! What asks Python, while Rust works without the lock of the interpreter, whether to go on.

use crate::error::Failure;
use ffsm_ipopt::nlp::Control;
use pyo3::prelude::*;

/// Asks for signals, and tells a callback.
///
/// What was raised once stays: Python tells of a signal a single time, and planning asks again before
/// it ends.
#[derive(Debug)]
pub struct Monitor {
    callback: Option<Py<PyAny>>,
    raised: Option<PyErr>,
}

impl Monitor {
    pub fn new(callback: Option<Py<PyAny>>) -> Self {
        Self {
            callback,
            raised: None,
        }
    }

    /// Asks for signals.
    pub fn ask(&mut self) -> Control {
        self.tell(|_, _| Ok(()))
    }

    /// Asks for signals, and has `say` call the callback where there is one.
    pub fn tell(
        &mut self,
        say: impl FnOnce(Python<'_>, &Bound<'_, PyAny>) -> PyResult<()>,
    ) -> Control {
        if self.raised.is_none() {
            let asked = Python::attach(|py| {
                py.check_signals()?;
                match &self.callback {
                    Some(callback) => say(py, callback.bind(py)),
                    None => Ok(()),
                }
            });
            self.raised = asked.err();
        }
        match self.raised {
            Some(_) => Control::Stop,
            None => Control::Continue,
        }
    }

    /// What was raised goes before whatever became of the work.
    pub fn finish<R>(self, result: Result<R, Failure>) -> Result<R, Failure> {
        match self.raised {
            Some(raised) => Err(Failure::Raised(raised)),
            None => result,
        }
    }
}
