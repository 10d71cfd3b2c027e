//! Writing for people and pipes.

use super::failure::Failure;
use std::io::{ErrorKind, Write};

/// Writes to standard output. A reader that has gone away is no failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Terminal(error)),
        _ => Ok(()),
    }
}

/// Writes a line to standard error, where nothing can be done about a failure.
pub(super) fn warn(line: &str) {
    let _ = writeln!(std::io::stderr(), "{}", line.trim_end());
}
