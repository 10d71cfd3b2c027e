//! Files and text of results that come in rows.

use super::failure::Failure;
use super::terminal;
use crate::plot::Figure;
use crate::report::{OutputFolder, Rows};
use serde::Serialize;
use std::path::PathBuf;

/// Writes `rows` as NAME.md, with `text`, NAME.csv, NAME.json and a figure, prints the text and the
/// paths, `files` first; or the JSON document alone, with the text on standard error.
pub(super) fn write<R: Serialize>(
    (name, folder): (&str, &OutputFolder),
    rows: &Rows<'_, R>,
    text: &str,
    figure: &Figure,
    mut files: Vec<PathBuf>,
    as_json: bool,
) -> Result<(), Failure> {
    let failure = |message: String| Failure::Format {
        path: name.into(),
        message,
    };
    let json = rows.json().map_err(|error| failure(error.to_string()))?;
    let csv = rows.csv().map_err(|error| failure(error.to_string()))?;
    for (ending, contents) in [("md", text), ("csv", &csv), ("json", &json)] {
        files.push(folder.write(&format!("{name}.{ending}"), contents)?);
    }
    files.extend(folder.write_figure(name, figure)?);
    terminal::results(text, &files, as_json.then_some(&json))
}
