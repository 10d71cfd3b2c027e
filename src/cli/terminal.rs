//! Writing for people and pipes.

use super::failure::Failure;
use crate::nlp::ipopt::interrupt::requested;
use crate::printable::{one_line, printable};
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

/// Longest line of a message, characters.
const LONGEST: usize = 4_000;

/// Writes to standard output. A reader that has gone away is no failure, as a terminal that was
/// closed is none.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let text = printable(text);
    let mut stdout = std::io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != ErrorKind::BrokenPipe && !requested() => {
            Err(Failure::Terminal(error))
        }
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

/// Writes a message of one line to standard error, whatever names it quotes.
pub(super) fn complain(message: &str) {
    warn(&one_line(message, LONGEST));
}

/// Writes lines to standard error, where nothing can be done about a failure.
pub(super) fn warn(lines: &str) {
    let _ = writeln!(std::io::stderr(), "{}", printable(lines.trim_end()));
}
