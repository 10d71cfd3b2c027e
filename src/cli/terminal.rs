//! Writing for people and pipes.

use super::failure::Failure;
use crate::nlp::ipopt::interrupt::requested;
use crate::text::printable::{one_line, printable};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

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
    print(&format!("{text}\n{}", written(files)))
}

/// Most files that are listed a line each.
const MOST_LINES: usize = 6;

/// Where files are: a line each, or, of many, a line a folder.
fn written(files: &[PathBuf]) -> String {
    if files.len() <= MOST_LINES {
        let line = |file: &PathBuf| format!("written {}\n", file.display());
        return files.iter().map(line).collect();
    }
    let mut folders: Vec<(&Path, Vec<String>)> = Vec::new();
    for file in files {
        let folder = file.parent().unwrap_or(Path::new("."));
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        match folders.iter_mut().find(|(path, _)| *path == folder) {
            Some((_, names)) => names.push(name.into_owned()),
            None => folders.push((folder, vec![name.into_owned()])),
        }
    }
    // Those of the folder itself stand at the end, where they are seen.
    folders.sort_by_key(|(path, _)| std::cmp::Reverse(path.components().count()));
    let line = |(path, names): &(&Path, Vec<String>)| {
        format!("written {}/: {}\n", path.display(), names.join(", "))
    };
    folders.iter().map(line).collect()
}

/// Writes a message of one line to standard error, whatever names it quotes.
pub(super) fn complain(message: &str) {
    warn(&one_line(message, LONGEST));
}

/// Writes lines to standard error, where nothing can be done about a failure.
pub(super) fn warn(lines: &str) {
    let _ = writeln!(std::io::stderr(), "{}", printable(lines.trim_end()));
}
