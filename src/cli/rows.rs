//! Files and text of results that come in rows.

use super::failure::Failure;
use super::terminal;
use crate::plot::Figure;
use crate::report::{FileSet, OutputFolder, Rows};
use serde::Serialize;

/// Writes `rows` as NAME.md, with `text`, NAME.csv, NAME.json and a figure, prints the text and the
/// paths, those of `set` first; or the JSON document alone, with the text on standard error.
pub(super) fn write<R: Serialize>(
    (name, folder): (&str, &OutputFolder),
    rows: &Rows<'_, R>,
    text: &str,
    figure: &Figure,
    mut set: FileSet,
    as_json: bool,
) -> Result<(), Failure> {
    let failure = |message: String| Failure::Format {
        path: name.into(),
        message,
    };
    let json = rows.json().map_err(|error| failure(error.to_string()))?;
    let csv = rows.csv().map_err(|error| failure(error.to_string()))?;
    for (ending, contents) in [("md", text), ("csv", &csv), ("json", &json)] {
        set.add(folder, &format!("{name}.{ending}"), contents);
    }
    set.add_figure(folder, name, figure)?;
    let files = set.write()?;
    terminal::results(text, &files, as_json.then_some(&json))
}
