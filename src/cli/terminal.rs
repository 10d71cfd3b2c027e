//! Writing for people and pipes.

use super::failure::Failure;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

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

/// Writes `text` and where the files are; where `json` is given, that instead, and the text to
/// standard error.
pub(super) fn results(text: &str, files: &[PathBuf], json: Option<&String>) -> Result<(), Failure> {
    if let Some(json) = json {
        print(json)?;
        warn(text);
        return Ok(());
    }
    let written = files
        .iter()
        .map(|file| format!("written {}\n", file.display()));
    print(&format!("{text}\n{}", written.collect::<String>()))
}

/// Writes a line to standard error, where nothing can be done about a failure.
pub(super) fn warn(line: &str) {
    let _ = writeln!(std::io::stderr(), "{}", line.trim_end());
}
